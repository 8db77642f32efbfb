/* fmurt_instance.h - one instance of the model: its values, its phase, its log. Independent of the FMI version.
 *
 * An instance belongs to its caller. No function keeps anything outside the instance, so different
 * instances may be used by different threads at the same time; one instance by one thread at a time.
 * Instance arguments are never NULL unless said. */
#ifndef FMURT_INSTANCE_H
#define FMURT_INSTANCE_H

#include <stdarg.h>
#include <stddef.h>

#include "fmurt_interface.h"
#include "fmurt_model.h"
#include "fmurt_race.h"

/* Phases of the FMI state machines, one bit each so that a function's permitted phases are a mask. */
typedef enum fmurt_phase {
  FMURT_PHASE_INSTANTIATED = 1,
  FMURT_PHASE_INITIALIZATION = 2,
  FMURT_PHASE_EVENT = 4,        /* event mode */
  FMURT_PHASE_CONTINUOUS = 8,   /* continuous-time mode */
  FMURT_PHASE_STEP = 16,        /* co-simulation between two steps */
  FMURT_PHASE_STEP_FAILED = 32, /* co-simulation after a discarded step */
  FMURT_PHASE_TERMINATED = 64,
  FMURT_PHASE_ERROR = 128
} fmurt_phase;

/* What an instance is for; each has phases of its own. */
typedef enum fmurt_kind {
  FMURT_KIND_MODEL_EXCHANGE,
  FMURT_KIND_CO_SIMULATION,            /* events inside the steps */
  FMURT_KIND_CO_SIMULATION_WITH_EVENTS /* events in event mode */
} fmurt_kind;

typedef enum fmurt_severity { FMURT_LOG_DEBUG, FMURT_LOG_WARNING, FMURT_LOG_DISCARD, FMURT_LOG_ERROR } fmurt_severity;

/* Log categories, in the order of fmurt_log_category_name. */
typedef enum fmurt_log_category {
  FMURT_LOG_EVENTS,
  FMURT_LOG_SOLVER,
  FMURT_LOG_STATUS_WARNING,
  FMURT_LOG_STATUS_DISCARD,
  FMURT_LOG_STATUS_ERROR,
  FMURT_LOG_ALL,
  FMURT_LOG_CATEGORY_COUNT
} fmurt_log_category;

extern const char *const fmurt_log_category_name[FMURT_LOG_CATEGORY_COUNT];

/* Where messages go; the FMI layer provides it. message is valid during the call only. */
typedef void (*fmurt_log_sink)(void *receiver, const char *instance_name, fmurt_severity severity,
                               fmurt_log_category category, const char *message);

typedef struct fmurt_settings {
  double start_time, stop_time; /* stop_time is HUGE_VAL if none was given */
  double tolerance;             /* of the importer; 0 if none was given */
} fmurt_settings;

/* The part of an instance's state that is neither a value of the model nor of the solver. */
typedef struct fmurt_situation {
  int kind;                 /* fmurt_kind */
  int phase;                /* fmurt_phase */
  int parameters_stale;     /* a parameter was set since fmurt_model.parameters ran */
  int initialization_stale; /* something was set since fmurt_model.initialize ran */
  int continuous_stale;     /* something was set since fmurt_model.continuous ran */
  int remaining_stale;      /* fmurt_model.continuous ran since fmurt_model.remaining */
  int event_pending;        /* co-simulation: an input or parameter was set, events must be looked for */
  int terminate_requested;  /* the model called terminate() */
  int initial, terminal;    /* as in fmurt_values */
  int has_started;          /* CVODE has, inside a co-simulation instance */
  double time, next_time_event;
  fmurt_settings settings;
  double solver_real[FMURT_SOLVER_REAL_COUNT];
  int solver_integer[FMURT_SOLVER_INTEGER_COUNT];
  fmurt_race race; /* of the integrators inside a co-simulation instance */
} fmurt_situation;

typedef struct fmurt_solver fmurt_solver;
typedef struct fmurt_approach fmurt_approach;

/* Events of a short time, see fmurt_chatter.h. */
typedef struct fmurt_chatter {
  double begin; /* time of the first of them */
  int events;
  int changed;  /* a relation has, since the last event was counted */
  int *changes; /* [indicator_count] of the relations */
} fmurt_chatter;

typedef struct fmurt_instance {
  char *name;
  fmurt_values values;
  fmurt_kind kind;
  fmurt_situation
      situation; /* its kind, time, next_time_event, initial and terminal are filled by fmurt_state.c only */

  /* Start values: what the model's tables say, overwritten by what is set before initialization ends. */
  double *start_real;
  int *start_integer, *start_boolean;
  /* Set values of slots that fmurt_model.parameters may also write, and which of them are set. */
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

  double *indicator;    /* [indicator_count] scratch */
  double *scratch;      /* [real_count] scratch for values that `parameters` must not change */
  fmurt_chatter chatter;
  int *crossed;   /* [indicator_count] 1: the integrator inside has found the zero of this indicator, for the next event */
  int at_event;   /* 1 during an event iteration */
  double *solved; /* [fmurt_solved_size()], see fmurt_solved.h */
  double *jacobian;        /* [state_count * state_count] of the last point that was asked for, see fmurt_derivative.h */
  int jacobian_is_current; /* = 1, if the model has computed nothing else since */

  fmurt_approach *approach; /* model exchange; NULL until indicators are asked for */
  fmurt_solver *solver; /* co-simulation; NULL until the first step */
  void (*destroy_approach)(fmurt_approach *approach);
  void (*destroy_solver)(fmurt_solver *solver); /* set with it: the instance owns what a layer above has made */

  fmurt_log_sink sink;
  void *receiver;
  int logged[FMURT_LOG_CATEGORY_COUNT];
  char message[1024]; /* cause of the model's last failure, empty if none */
} fmurt_instance;

/* Of values.accepted: what is followed, and the time. */
static inline size_t fmurt_accepted_size(void) { return fmurt_model.followed_count + 1; }

/* Of the points that fmurt_solved.h remembers: followed values, time and number each, and how many there were. */
static inline size_t fmurt_solved_size(void) { return FMURT_SOLVED_POINTS * (fmurt_model.followed_count + 2) + 1; }

/* Makes an instance with start values; NULL if memory is short. name is copied. */
fmurt_instance *fmurt_instance_create(const char *name, fmurt_kind kind, fmurt_log_sink sink, void *receiver);
/* Frees an instance and all it owns; instance may be NULL. */
void fmurt_instance_destroy(fmurt_instance *instance);
/* Back to the state after fmurt_instance_create; log settings stay. FMURT_RESULT_ERROR if memory is short. */
fmurt_result fmurt_instance_reset(fmurt_instance *instance);

/* Logs a message (printf format); debug messages only if their category is on. */
void fmurt_log(fmurt_instance *instance, fmurt_severity severity, fmurt_log_category category, const char *format, ...)
    __attribute__((format(printf, 4, 5)));

/* Name of the variable at a slot, or "?"; static storage. */
const char *fmurt_slot_name(const fmurt_slot_table *table, size_t slot);

/* Sets string slot `slot` to a copy of text. FMURT_RESULT_ERROR if memory is short. */
fmurt_result fmurt_set_string(fmurt_instance *instance, size_t slot, const char *text);

/* Declares everything that depends on set values out of date. */
void fmurt_invalidate(fmurt_instance *instance, int parameter_changed);

#endif
