/* cmb_instance.h - one instance of the model: its values, its phase, its log. Independent of the FMI version.
 *
 * An instance belongs to its caller. No function keeps anything outside the instance, so different
 * instances may be used by different threads at the same time; one instance by one thread at a time.
 * Instance arguments are never NULL unless said. */
#ifndef CMB_INSTANCE_H
#define CMB_INSTANCE_H

#include <stdarg.h>
#include <stddef.h>

#include "cmb_interface.h"
#include "cmb_model.h"

/* Phases of the FMI state machines, one bit each so that a function's permitted phases are a mask. */
typedef enum cmb_phase {
  CMB_PHASE_INSTANTIATED = 1,
  CMB_PHASE_INITIALIZATION = 2,
  CMB_PHASE_EVENT = 4,       /* event mode */
  CMB_PHASE_CONTINUOUS = 8,  /* continuous-time mode */
  CMB_PHASE_STEP = 16,       /* co-simulation between two steps */
  CMB_PHASE_STEP_FAILED = 32,/* co-simulation after a discarded step */
  CMB_PHASE_TERMINATED = 64,
  CMB_PHASE_ERROR = 128
} cmb_phase;

/* What an instance is for; each has phases of its own. */
typedef enum cmb_kind {
  CMB_KIND_MODEL_EXCHANGE,
  CMB_KIND_CO_SIMULATION,            /* events inside the steps */
  CMB_KIND_CO_SIMULATION_WITH_EVENTS /* events in event mode */
} cmb_kind;

typedef enum cmb_severity { CMB_LOG_DEBUG, CMB_LOG_WARNING, CMB_LOG_DISCARD, CMB_LOG_ERROR } cmb_severity;

/* Log categories, in the order of cmb_log_category_name. */
typedef enum cmb_log_category {
  CMB_LOG_EVENTS,
  CMB_LOG_SOLVER,
  CMB_LOG_STATUS_WARNING,
  CMB_LOG_STATUS_DISCARD,
  CMB_LOG_STATUS_ERROR,
  CMB_LOG_ALL,
  CMB_LOG_CATEGORY_COUNT
} cmb_log_category;

extern const char *const cmb_log_category_name[CMB_LOG_CATEGORY_COUNT];

/* Where messages go; the FMI layer provides it. message is valid during the call only. */
typedef void (*cmb_log_sink)(void *receiver, const char *instance_name, cmb_severity severity,
                             cmb_log_category category, const char *message);

typedef struct cmb_settings {
  double start_time, stop_time; /* stop_time is HUGE_VAL if none was given */
  double tolerance;             /* of the importer; 0 if none was given */
} cmb_settings;

/* The part of an instance's state that is neither a value of the model nor of the solver. */
typedef struct cmb_situation {
  int kind;                  /* cmb_kind */
  int phase;                 /* cmb_phase */
  int parameters_stale;      /* a parameter was set since cmb_model.parameters ran */
  int initialization_stale;  /* something was set since cmb_model.initialize ran */
  int continuous_stale;      /* something was set since cmb_model.continuous ran */
  int event_pending;         /* co-simulation: an input or parameter was set, events must be looked for */
  int terminate_requested;   /* the model called terminate() */
  int initial, terminal;     /* as in cmb_values */
  double time, next_time_event;
  cmb_settings settings;
  double solver_real[CMB_SOLVER_REAL_COUNT];
  int solver_integer[CMB_SOLVER_INTEGER_COUNT];
} cmb_situation;

typedef struct cmb_solver cmb_solver;

typedef struct cmb_instance {
  char *name;
  cmb_values values;
  cmb_kind kind;
  cmb_situation situation; /* its kind, time, next_time_event, initial and terminal are filled by cmb_state.c only */

  /* Start values: what the model's tables say, overwritten by what is set before initialization ends. */
  double *start_real;
  int *start_integer, *start_boolean;
  /* Set values of slots that cmb_model.parameters may also write, and which of them are set. */
  double *set_real;
  int *set_integer, *set_boolean;
  int *real_is_set, *integer_is_set, *boolean_is_set;

  /* The two blocks in which all arrays above and those of `values` lie: one copy saves them all. */
  double *double_block;
  size_t double_block_count;
  int *int_block;
  size_t int_block_count;
  char **string;       /* [string_count] owned text behind values.string */
  char **start_string; /* [string_count] owned */

  double *indicator; /* [indicator_count] scratch */
  double *scratch;   /* [real_count] scratch for values that `parameters` must not change */
  cmb_solver *solver; /* co-simulation; NULL until the first step */

  cmb_log_sink sink;
  void *receiver;
  int logged[CMB_LOG_CATEGORY_COUNT];
  char message[1024]; /* cause of the model's last failure, empty if none */
} cmb_instance;

/* Makes an instance with start values; NULL if memory is short. name is copied. */
cmb_instance *cmb_instance_create(const char *name, cmb_kind kind, cmb_log_sink sink, void *receiver);
/* Frees an instance and all it owns; instance may be NULL. */
void cmb_instance_destroy(cmb_instance *instance);
/* Back to the state after cmb_instance_create; log settings stay. CMB_RESULT_ERROR if memory is short. */
cmb_result cmb_instance_reset(cmb_instance *instance);

/* Logs a message (printf format); debug messages only if their category is on. */
void cmb_log(cmb_instance *instance, cmb_severity severity, cmb_log_category category, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Name of the variable at a slot, or "?"; static storage. */
const char *cmb_slot_name(const cmb_slot_table *table, size_t slot);

/* Sets string slot `slot` to a copy of text. CMB_RESULT_ERROR if memory is short. */
cmb_result cmb_set_string(cmb_instance *instance, size_t slot, const char *text);

/* Declares everything that depends on set values out of date. */
void cmb_invalidate(cmb_instance *instance, int parameter_changed);

#endif
