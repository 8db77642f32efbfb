/* cmb_fmu.h - what FMI 2.0 and 3.0 have in common: the state machine, checks and messages of an FMU instance.
 *
 * The layers fmi2_functions.c and fmi3_functions.c translate types and names. Conventions: a call that the state
 * machine forbids, a null pointer, a wrong count or reference is answered with CMB_FMU_ERROR and leaves the
 * instance as it was; a failure of the model itself ends in the error state, from which reset, restoring a state
 * and freeing lead out. Nothing here ends the process. `call` is the name of the FMI function, for messages.
 * An fmu pointer may be NULL: the answer is CMB_FMU_ERROR. */
#ifndef CMB_FMU_H
#define CMB_FMU_H

#include "cmb_access.h"
#include "cmb_instance.h"
#include "cmb_state.h"

/* Numerically fmi2Status and fmi3Status. */
typedef enum cmb_fmu_status { CMB_FMU_OK, CMB_FMU_WARNING, CMB_FMU_DISCARD, CMB_FMU_ERROR } cmb_fmu_status;

typedef struct cmb_fmu {
  cmb_instance *instance;
  int co_simulation;
  int event_mode_used;      /* co-simulation: the importer handles events in event mode (FMI 3.0) */
  int early_return_allowed; /* co-simulation: a step may end at an event (FMI 3.0) */
} cmb_fmu;

enum {
  CMB_BEFORE_START = CMB_PHASE_INSTANTIATED | CMB_PHASE_INITIALIZATION,
  CMB_MODEL_EXCHANGE = CMB_PHASE_EVENT | CMB_PHASE_CONTINUOUS,
  CMB_CO_SIMULATION = CMB_PHASE_STEP | CMB_PHASE_STEP_FAILED,
  CMB_AFTER_END = CMB_PHASE_TERMINATED | CMB_PHASE_ERROR,
  CMB_ANY_PHASE = CMB_BEFORE_START | CMB_MODEL_EXCHANGE | CMB_CO_SIMULATION | CMB_AFTER_END
};

/* Makes the instance inside fmu, whose other members the caller has set. NULL, or why it could not be made. */
const char *cmb_fmu_open(cmb_fmu *fmu, const char *name, const char *token, int logging, cmb_log_sink sink,
                         void *receiver);
void cmb_fmu_close(cmb_fmu *fmu);

/* 1 if the instance is in one of these phases, 0 (logged) if not. */
int cmb_fmu_permits(cmb_fmu *fmu, const char *call, int phases);
/* Logs the reason; CMB_FMU_ERROR. */
cmb_fmu_status cmb_fmu_refuse(cmb_fmu *fmu, const char *call, const char *reason);

cmb_fmu_status cmb_fmu_set_logging(cmb_fmu *fmu, const char *call, int on, size_t count,
                                   const char *const *categories);
cmb_fmu_status cmb_fmu_set_experiment(cmb_fmu *fmu, const char *call, int tolerance_defined, double tolerance,
                                      double start_time, int stop_time_defined, double stop_time);
cmb_fmu_status cmb_fmu_enter_initialization(cmb_fmu *fmu, const char *call);
cmb_fmu_status cmb_fmu_exit_initialization(cmb_fmu *fmu, const char *call);
cmb_fmu_status cmb_fmu_terminate(cmb_fmu *fmu, const char *call);
cmb_fmu_status cmb_fmu_reset(cmb_fmu *fmu, const char *call);

cmb_fmu_status cmb_fmu_get_real(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count, double *value);
cmb_fmu_status cmb_fmu_get_integer(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count, int *value);
cmb_fmu_status cmb_fmu_get_boolean(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count, int *value);
cmb_fmu_status cmb_fmu_get_string(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                  const char **value);
cmb_fmu_status cmb_fmu_set_real(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                const double *value);
cmb_fmu_status cmb_fmu_set_integer(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                   const int *value);
cmb_fmu_status cmb_fmu_set_boolean(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                   const int *value);
cmb_fmu_status cmb_fmu_set_string(cmb_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                  const char *const *value);

/* *state may be a state to be overwritten or NULL; the FMI functions' void pointers are cmb_state pointers. */
cmb_fmu_status cmb_fmu_get_state(cmb_fmu *fmu, const char *call, void **state);
cmb_fmu_status cmb_fmu_set_state(cmb_fmu *fmu, const char *call, const void *state);
cmb_fmu_status cmb_fmu_free_state(cmb_fmu *fmu, const char *call, void **state);
cmb_fmu_status cmb_fmu_state_size(cmb_fmu *fmu, const char *call, const void *state, size_t *size);
cmb_fmu_status cmb_fmu_write_state(cmb_fmu *fmu, const char *call, const void *state, char *bytes, size_t size);
cmb_fmu_status cmb_fmu_read_state(cmb_fmu *fmu, const char *call, const char *bytes, size_t size, void **state);

cmb_fmu_status cmb_fmu_directional_derivative(cmb_fmu *fmu, const char *call, const unsigned *unknown,
                                              size_t unknown_count, const unsigned *known, size_t known_count,
                                              const double *seed, double *sensitivity);

typedef struct cmb_event_report {
  int terminate, states_changed, next_time_defined;
  double next_time;
} cmb_event_report;

cmb_fmu_status cmb_fmu_enter_event_mode(cmb_fmu *fmu, const char *call);
/* Carries the whole event iteration through, so it never has to be called again for the same event. */
cmb_fmu_status cmb_fmu_update_discrete_states(cmb_fmu *fmu, const char *call, cmb_event_report *report);
cmb_fmu_status cmb_fmu_enter_continuous_time_mode(cmb_fmu *fmu, const char *call);
cmb_fmu_status cmb_fmu_enter_step_mode(cmb_fmu *fmu, const char *call);

cmb_fmu_status cmb_fmu_set_time(cmb_fmu *fmu, const char *call, double time);
cmb_fmu_status cmb_fmu_set_states(cmb_fmu *fmu, const char *call, const double *state, size_t count);
cmb_fmu_status cmb_fmu_get_states(cmb_fmu *fmu, const char *call, double *state, size_t count);
cmb_fmu_status cmb_fmu_get_derivatives(cmb_fmu *fmu, const char *call, double *derivative, size_t count);
cmb_fmu_status cmb_fmu_get_indicators(cmb_fmu *fmu, const char *call, double *indicator, size_t count);
/* One shifted indicator as a variable's value, in any phase (0 before initialization). */
cmb_fmu_status cmb_fmu_get_indicator(cmb_fmu *fmu, const char *call, size_t index, double *indicator);
cmb_fmu_status cmb_fmu_get_nominals(cmb_fmu *fmu, const char *call, double *nominal, size_t count);

typedef struct cmb_step_report {
  int event_waiting; /* the step ends at an event that event mode has to handle */
  int terminate;     /* the model ends the simulation; the step ends there */
  double time;       /* reached */
} cmb_step_report;

/* After CMB_FMU_DISCARD the instance is at report->time, its phase is CMB_PHASE_STEP_FAILED. */
cmb_fmu_status cmb_fmu_do_step(cmb_fmu *fmu, const char *call, double time, double step, cmb_step_report *report);

#endif
