/* fmurt_fmu.h - what FMI 2.0 and 3.0 have in common: the state machine, checks and messages of an FMU instance.
 *
 * The layers fmi2_functions.c and fmi3_functions.c translate types and names. Conventions: a call that the state
 * machine forbids, a null pointer, a wrong count or reference is answered with FMURT_FMU_ERROR and leaves the
 * instance as it was; a failure of the model itself ends in the error state, from which reset, restoring a state
 * and freeing lead out. Nothing here ends the process. `call` is the name of the FMI function, for messages.
 * An fmu pointer may be NULL: the answer is FMURT_FMU_ERROR. */
#ifndef FMURT_FMU_H
#define FMURT_FMU_H

#include "fmurt_fmu_check.h"

/* Makes the instance inside fmu, whose other members the caller has set. NULL, or why it could not be made. */
const char *fmurt_fmu_open(fmurt_fmu *fmu, const char *name, const char *token, int logging, fmurt_log_sink sink,
                           void *receiver);
void fmurt_fmu_close(fmurt_fmu *fmu);

fmurt_fmu_status fmurt_fmu_set_logging(fmurt_fmu *fmu, const char *call, int on, size_t count,
                                       const char *const *categories);
fmurt_fmu_status fmurt_fmu_set_experiment(fmurt_fmu *fmu, const char *call, int tolerance_defined, double tolerance,
                                          double start_time, int stop_time_defined, double stop_time);
fmurt_fmu_status fmurt_fmu_enter_initialization(fmurt_fmu *fmu, const char *call);
fmurt_fmu_status fmurt_fmu_exit_initialization(fmurt_fmu *fmu, const char *call);
fmurt_fmu_status fmurt_fmu_terminate(fmurt_fmu *fmu, const char *call);
fmurt_fmu_status fmurt_fmu_reset(fmurt_fmu *fmu, const char *call);

fmurt_fmu_status fmurt_fmu_get_real(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                    double *value);
fmurt_fmu_status fmurt_fmu_get_integer(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       int *value);
fmurt_fmu_status fmurt_fmu_get_boolean(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       int *value);
fmurt_fmu_status fmurt_fmu_get_string(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                      const char **value);
fmurt_fmu_status fmurt_fmu_set_real(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                    const double *value);
fmurt_fmu_status fmurt_fmu_set_integer(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       const int *value);
fmurt_fmu_status fmurt_fmu_set_boolean(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                       const int *value);
fmurt_fmu_status fmurt_fmu_set_string(fmurt_fmu *fmu, const char *call, const unsigned *reference, size_t count,
                                      const char *const *value);

/* *state may be a state to be overwritten or NULL; the FMI functions' void pointers are fmurt_state pointers. */
fmurt_fmu_status fmurt_fmu_get_state(fmurt_fmu *fmu, const char *call, void **state);
fmurt_fmu_status fmurt_fmu_set_state(fmurt_fmu *fmu, const char *call, const void *state);
fmurt_fmu_status fmurt_fmu_free_state(fmurt_fmu *fmu, const char *call, void **state);
fmurt_fmu_status fmurt_fmu_state_size(fmurt_fmu *fmu, const char *call, const void *state, size_t *size);
fmurt_fmu_status fmurt_fmu_write_state(fmurt_fmu *fmu, const char *call, const void *state, char *bytes, size_t size);
fmurt_fmu_status fmurt_fmu_read_state(fmurt_fmu *fmu, const char *call, const char *bytes, size_t size, void **state);

fmurt_fmu_status fmurt_fmu_directional_derivative(fmurt_fmu *fmu, const char *call, const unsigned *unknown,
                                                  size_t unknown_count, const unsigned *known, size_t known_count,
                                                  const double *seed, double *sensitivity);

typedef struct fmurt_event_report {
  int terminate, states_changed, next_time_defined;
  double next_time;
} fmurt_event_report;

fmurt_fmu_status fmurt_fmu_enter_event_mode(fmurt_fmu *fmu, const char *call);
/* Carries the whole event iteration through, so it never has to be called again for the same event. */
fmurt_fmu_status fmurt_fmu_update_discrete_states(fmurt_fmu *fmu, const char *call, fmurt_event_report *report);
fmurt_fmu_status fmurt_fmu_enter_continuous_time_mode(fmurt_fmu *fmu, const char *call);
fmurt_fmu_status fmurt_fmu_enter_step_mode(fmurt_fmu *fmu, const char *call);

/* See fmurt_accept. */
fmurt_fmu_status fmurt_fmu_completed_step(fmurt_fmu *fmu, const char *call);
fmurt_fmu_status fmurt_fmu_set_time(fmurt_fmu *fmu, const char *call, double time);
fmurt_fmu_status fmurt_fmu_set_states(fmurt_fmu *fmu, const char *call, const double *state, size_t count);
fmurt_fmu_status fmurt_fmu_get_states(fmurt_fmu *fmu, const char *call, double *state, size_t count);
fmurt_fmu_status fmurt_fmu_get_derivatives(fmurt_fmu *fmu, const char *call, double *derivative, size_t count);
fmurt_fmu_status fmurt_fmu_get_indicators(fmurt_fmu *fmu, const char *call, double *indicator, size_t count);
/* One shifted indicator as a variable's value, in any phase (0 before initialization). */
fmurt_fmu_status fmurt_fmu_get_indicator(fmurt_fmu *fmu, const char *call, size_t index, double *indicator);
fmurt_fmu_status fmurt_fmu_get_nominals(fmurt_fmu *fmu, const char *call, double *nominal, size_t count);

typedef struct fmurt_step_report {
  int event_waiting; /* the step ends at an event that event mode has to handle */
  int terminate;     /* the model ends the simulation; the step ends there */
  double time;       /* reached */
} fmurt_step_report;

/* After FMURT_FMU_DISCARD the instance is at report->time, its phase is FMURT_PHASE_STEP_FAILED. */
fmurt_fmu_status fmurt_fmu_do_step(fmurt_fmu *fmu, const char *call, double time, double step,
                                   fmurt_step_report *report);

#endif
