/* fmurt_model.h - what the FMI runtime knows of a generated model.
 *
 * The generated C file defines exactly one object with external linkage, `fmurt_model`. Every variable of
 * the model is a slot of one of four arrays (Real, Integer incl. enumerations, Boolean, String); a slot's
 * index is its FMI value reference. The generated functions read and write these arrays only, so several
 * instances run in parallel. */
#ifndef FMURT_MODEL_H
#define FMURT_MODEL_H

#include <stddef.h>

typedef enum fmurt_result {
  FMURT_RESULT_OK = 0,
  FMURT_RESULT_DISCARD = 1, /* not computable here (domain error, singular block): a smaller step may help */
  FMURT_RESULT_ERROR = 2    /* the model cannot go on; the message is in the instance */
} fmurt_result;

/* How unknowns of nonlinear systems are found. */
enum { FMURT_SOLVED_POINTS = 8 };

typedef enum fmurt_following {
  FMURT_SOLVE,           /* from the values they have: initialization */
  FMURT_FOLLOW_OR_SOLVE, /* followed from the last accepted step; solved from there where that fails: events */
  FMURT_FOLLOW           /* followed from the last accepted step, so that the solution never changes to another one */
} fmurt_following;

/* What fmurt_dead_center.h remembers of the last accepted step and the one before; determinants stand at a system's first unknown. */
typedef struct fmurt_history {
  size_t count;               /* followed unknowns; 0: nothing is remembered */
  double *before;             /* [count + 1] accepted one step before; its time */
  double *determinant;        /* [count] of the Jacobian at the accepted solution; 0: unknown */
  double *determinant_before; /* [count] */
  /* Where a step was first too long; 0: none was. */
  double *noted;     /* [count] determinant */
  double *time_left; /* [count] until it is zero */
  double *speed;     /* [count] of the unknowns, scaled */
} fmurt_history;

/* Values of one instance. Arrays belong to the runtime, which allocates them by the sizes of
 * fmurt_model_description and fills them from its start tables. */
typedef struct fmurt_values {
  double time;
  double *real;        /* [real_count] */
  int *integer;        /* [integer_count] */
  int *boolean;        /* [boolean_count], 0 or 1 */
  const char **string; /* [string_count] */
  double *pre_real;    /* values before the current event iteration: pre(v) */
  int *pre_integer;
  int *pre_boolean;
  int *relation;          /* [indicator_count]: state of every event-generating relation; frozen while
                            integrating, updated by the runtime at events from the sign of the indicator
                            (1: indicator > 0) before it calls `discrete` */
  double *work;           /* [work_count] scratch and warm starts of the solved blocks */
  int *integer_work;      /* [integer_work_count] */
  double *delay;          /* [delay_count * FMURT_DELAY_SIZE]: what delay() remembers (fmurt_delay.h) */
  double *state_nominal;  /* [state_count]: the model's, or smaller where bodies are small (fmurt_nominal.h) */
  double *accepted;       /* [followed_count + 1]: unknowns of nonlinear systems at the last accepted step; its time */
  fmurt_history history;
  const double *solved[FMURT_SOLVED_POINTS]; /* [solved_count][followed_count]: these at points solved since then */
  int solved_count;
  int may_stray; /* 1: where following fails, any solution is taken, which `strayed` then tells: importers that know no
                    discarded evaluation get values at trial points, and no such point is accepted */
  int strayed;
  int following;          /* fmurt_following */
  int initial;            /* 1 while initial() is true */
  int terminal;           /* 1 while terminal() is true */
  double next_time_event; /* set by `discrete`: next time event, or HUGE_VAL */
  int terminate;          /* set by `discrete`: terminate() was called */
  void *host;             /* the runtime's own, given back to the callbacks below */
} fmurt_values;

/* Provided by the runtime, called by generated code. */
void fmurt_report_error(fmurt_values *values, const char *message); /* cause of a FMURT_RESULT_ERROR or _DISCARD */
void fmurt_report_warning(fmurt_values *values, const char *message);
/* Rounds `value` into the Integer `target`; FMURT_RESULT_DISCARD with a message that names it by `name` where no int holds
 * the value. */
fmurt_result fmurt_round_integer(fmurt_values *values, int *target, double value, const char *name);
/* Scales and factorizes A (column-major n x n, overwritten). `scale` has n doubles, `pivot` n ints.
 * 0 on success, k+1 if column k is singular. */
int fmurt_factorize(int n, double *a, double *scale, int *pivot);
/* Solves A x = b with what fmurt_factorize left: b in, x out. */
void fmurt_substitute(int n, const double *a, const double *scale, const int *pivot, double *b);
/* Derivatives are computed for this many directions at once. */
enum { FMURT_LANES = 4 };
/* The same for FMURT_LANES right-hand sides: b[i * FMURT_LANES + lane]. */
void fmurt_substitute_lanes(int n, const double *a, const double *scale, const int *pivot, double *b);
/* A linear system that is evaluated from the equations it stands for: they are linear in the unknowns. Offsets are in
 * the work array; columns of several unknowns are found at once, in lanes. */
typedef struct fmurt_linear_system {
  int size;
  int matrix, scale, solution; /* column-major [size * size]; [size]; [size] */
  int pivot;                   /* [size], in the array of integers */
  int seeds;                   /* [size * FMURT_LANES] derivatives of the unknowns by the unknowns of this pass */
  int columns;                 /* [size * FMURT_LANES] derivatives of the residuals by the unknowns of this pass */
  int (*evaluate_inner)(fmurt_values *values);     /* unknowns from `solution`, and what follows from them */
  int (*evaluate_residuals)(fmurt_values *values); /* after evaluate_inner: -residuals, to `solution` */
  int (*evaluate_numbers)(fmurt_values *values);   /* what the columns have in common */
  int (*evaluate_columns)(fmurt_values *values);   /* after evaluate_numbers: `columns` from `seeds` */
  const char *singular;                            /* message */
} fmurt_linear_system;
/* Solves it: `solution` and `evaluate_inner` have been done when it ends with FMURT_RESULT_OK, and the factors are
 * there. */
fmurt_result fmurt_solve_linear(fmurt_values *values, const fmurt_linear_system *system);
/* Damped Newton with finite-difference Jacobian for small nonlinear blocks, used by generated code:
 * residual(values, context, x, r) returns a fmurt_result. x: start value in, solution out. nominal may be NULL.
 * work needs n*n + 7*n doubles, integer_work n ints. FMURT_RESULT_DISCARD when it does not converge. */
typedef int (*fmurt_residual)(fmurt_values *values, const void *context, const double *x, double *r);
int fmurt_solve_nonlinear(fmurt_values *values, const void *context, fmurt_residual residual, int n, double *x,
                          const double *nominal, double tolerance, double *work, int *integer_work);
/* The same as values->following asks for: x from its values or from values->accepted + offset. Following, each
 * correction must be small beside the one before, as it is where the equations are nearly linear over all that the
 * unknowns change by; so the solution is the one that the accepted one changes to continuously, and no other.
 * Where that is too far it is followed from one of values->solved. Where that fails too, FMURT_RESULT_DISCARD (a shorter
 * step helps), or any solution if values->may_stray. */
int fmurt_follow_nonlinear(fmurt_values *values, int offset, const void *context, fmurt_residual residual, int n,
                           double *x, const double *nominal, double tolerance, double *work, int *integer_work);
/* After one of these has failed at x: reports the equation with the largest residual, by the place where the
 * model states it (equation[n]), and the unknowns by their names (unknown[n]). r has n doubles. Gives back `result`. */
int fmurt_report_unsolved(fmurt_values *values, fmurt_residual residual, int n, const double *x, double *r,
                          const char *const *unknown, const char *const *equation, int result);

/* Motion of the bodies of a scene at a share of a step; 0 on success. */
typedef int (*fmurt_motion_at)(void *context, double share, double *motion);
/* Bodies that may touch. */
typedef struct fmurt_scene {
  int body_count;
  /* Positions [body_count][3], rotations [][9], velocities [][3] and angular velocities [][3], for the values after `continuous`. */
  int (*motion)(fmurt_values *values, double *motion);
  /* Two bodies that pass through each other in a step between these motions: 1-based, 0: none; and the share of the step where they
   * begin to touch, the thickness of the thinner one in m, and how fast they come nearer there in m/s. */
  int (*passage)(fmurt_values *values, double duration, const double *begin, const double *end, fmurt_motion_at at,
                 void *context, int *pair, double *number);
  const char *name; /* of the contact manager */
} fmurt_scene;

/* A model of many parts that act on each other through contacts alone: those that are out of each other's reach may be looked
 * at each at a time of its own. Functions work in a memory of the caller's, `m`: positions of all bodies [body_count][3],
 * rotations [][9], velocities [][3] and angular velocities [][3], then forces [][3] and torques [][3], and what the model itself
 * keeps there. Bodies are 0-based. */
typedef int (*fmurt_part_function)(fmurt_values *values, const unsigned *slot, const int *body, const double *restrict state,
                                   double *restrict m, double *restrict rate);
typedef struct fmurt_part_kind {
  int state_count, body_count;
  fmurt_part_function motion; /* of the part's bodies, from its states */
  fmurt_part_function rates;  /* its states' derivatives, from states, forces and torques */
} fmurt_part_kind;
typedef struct fmurt_part {
  const fmurt_part_kind *kind;
  const int *state; /* [state_count] numbers of its states; each state belongs to one part */
  const int *body;  /* [body_count] */
  const unsigned *slot; /* value references of the parameters that the functions read */
} fmurt_part;
typedef struct fmurt_parts {
  int part_count;
  const fmurt_part *part;
  int body_count;   /* of all parts, and the fixed ones */
  int fixed_count;
  const int *fixed; /* bodies that never move */
  size_t memory_count;
  int (*prepare)(fmurt_values *values, double *m); /* what follows from parameters, and where fixed bodies are */
  /* Forces and torques on some bodies, were there no others: 1-based, ascending. */
  int (*response)(fmurt_values *values, const int *bodies, size_t count, double *m);
  /* As that of fmurt_scene, of some bodies. */
  int (*passage)(fmurt_values *values, const int *bodies, size_t count, double duration, const double *begin,
                 const double *end, fmurt_motion_at at, void *context, int *pair, double *number);
  /* Of balls about the bodies' origins that hold them, [body_count]; infinite for half-spaces. */
  int (*radii)(fmurt_values *values, double *radius);
} fmurt_parts;

typedef struct fmurt_model_description {
  const char *name;
  const char *guid;
  size_t real_count, integer_count, boolean_count, string_count;
  size_t state_count, indicator_count, work_count, integer_work_count;
  size_t delay_count;          /* delay() operators */
  const unsigned *state;       /* [state_count] value references into real */
  const unsigned *derivative;  /* [state_count] */
  const double *state_nominal; /* [state_count] */
  const unsigned char *is_length; /* [state_count], 1: in metres, and the model says no nominal value; NULL if none is */
  size_t thickness_count;
  const unsigned *thickness; /* [thickness_count] value references into real: parameters, of what may touch */
  const double *real_start;    /* start tables, defaults before parameters are computed */
  const int *integer_start;
  const int *boolean_start;
  const char *const *string_start;

  /* Computes dependent parameters and bound start values from independent parameters (after a set). */
  fmurt_result (*parameters)(fmurt_values *values);
  /* Solves the initialization problem: states, algebraics, discrete start values. values->initial is 1. */
  fmurt_result (*initialize)(fmurt_values *values);
  /* From time, states, inputs, parameters, discrete values and frozen relations: all derivatives and
   * continuous algebraics but those of `remaining`. */
  fmurt_result (*continuous)(fmurt_values *values);
  /* The indicators, [indicator_count], for the values after `continuous`. */
  fmurt_result (*indicators)(fmurt_values *values, double *indicator);
  /* One event iteration: discrete equations and when-clauses with pre() from pre_*; may reinit states
   * (*states_changed = 1). Sets next_time_event. The runtime repeats (indicators -> relation, copy to pre,
   * discrete) until neither discrete values nor relations change. */
  fmurt_result (*discrete)(fmurt_values *values, int *states_changed);

  /* Optional members; NULL where left out. */

  const double *indicator_nominal;   /* [indicator_count] sizes for the hysteresis; 1 where left out */
  const char *const *indicator_text; /* [indicator_count] the relations as the modeller wrote them, for messages */
  /* d(derivative)/d(state) at the values after `continuous` and `remaining`, relations and discrete variables held:
   * jacobian[i + j * state_count] is the derivative of derivative i by state j. */
  fmurt_result (*jacobian)(fmurt_values *values, double *jacobian);
  /* The equations of `discrete`, without its actions: reinitializations, assertions, terminations, next_time_event. The
   * runtime repeats it with the same pre() values until the relations agree with what it solves. */
  fmurt_result (*settle)(fmurt_values *values);
  size_t followed_count;    /* unknowns of nonlinear systems */
  const unsigned *followed; /* [followed_count] value references into real */
  /* Assertions at level warning that hold all the time, for the values after `continuous`: reports each that is violated,
   * once. Called where a step is accepted and after events, not at trial points. */
  fmurt_result (*warnings)(fmurt_values *values);
  /* After `continuous`: the algebraics that neither derivatives nor indicators, assertions or discrete equations need. An
   * integrator does without; `jacobian` does not. */
  fmurt_result (*remaining)(fmurt_values *values);
  /* What the model is made of where that is many parts, as free bodies, that act on each other through contacts alone. */
  const fmurt_parts *parts;
  size_t scene_count; /* of the contacts that the engine finds */
  const fmurt_scene *scene;
} fmurt_model_description;

extern const fmurt_model_description fmurt_model;

#endif
