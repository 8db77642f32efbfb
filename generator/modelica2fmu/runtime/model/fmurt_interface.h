/* fmurt_interface.h - what the FMI runtime knows of the variables' interface.
 *
 * Written as fmurt_interface.c from the same description as modelDescription.xml, so that the checks the
 * runtime makes and the promises of the XML cannot differ. */
#ifndef FMURT_INTERFACE_H
#define FMURT_INTERFACE_H

#include <stddef.h>

/* When a slot may be set (FMI 2.0.4, section 2.2.7 and the state machines of 3.2.3 and 4.2.4), and its kind. */
enum {
  FMURT_SET_INSTANTIATED = 1,
  FMURT_SET_INITIALIZATION = 2,
  FMURT_SET_EVENT = 4,
  FMURT_SET_CONTINUOUS = 8,
  FMURT_IS_DISCRETE = 16,   /* changes at events only: its change repeats the event iteration */
  FMURT_IS_PARAMETER = 32,  /* fixed or tunable: computed by fmurt_model.parameters */
  FMURT_IS_INDEPENDENT = 64 /* the time */
};

/* Bounds of a parameter; infinite where there is none. */
typedef struct fmurt_bounds {
  unsigned slot;
  double least, largest;
} fmurt_bounds;

/* Slots of one base type; slots from count on are not variables of the FMU. */
typedef struct fmurt_slot_table {
  size_t count;
  const unsigned char *access; /* [count], may be NULL if count is 0 */
  const char *const *name;     /* [count], entries NULL where no variable shows the slot */
  size_t bounds_count;
  const fmurt_bounds *bounds; /* [bounds_count] by rising slots */
} fmurt_slot_table;

typedef struct fmurt_interface {
  fmurt_slot_table real, integer, boolean, string;
  double start_time, stop_time; /* default experiment; stop_time is HUGE_VAL if it does not say */
  double relative_tolerance;    /* of the co-simulation solver where the importer gives none */
  double absolute_tolerance;    /* times a state's nominal value; 0: see fmurt_solver.c */
  double maximum_step;          /* s; 0: the communication step */
  int maximum_steps;            /* of the integrator in one communication step */
} fmurt_interface;

extern const fmurt_interface fmurt_interface_tables;

/* Variables of the co-simulation solver, beside those of the model. */
enum { FMURT_SOLVER_FIRST_REFERENCE = 0x40000000 };
enum {
  FMURT_SOLVER_RELATIVE_TOLERANCE,
  FMURT_SOLVER_ABSOLUTE_TOLERANCE,
  FMURT_SOLVER_MAXIMUM_STEP,
  FMURT_SOLVER_REAL_COUNT
};
enum {
  FMURT_SOLVER_STEPS,
  FMURT_SOLVER_EVALUATIONS, /* of the model's right-hand side, those for Jacobians included */
  FMURT_SOLVER_JACOBIANS,
  FMURT_SOLVER_ERROR_TEST_FAILURES,
  FMURT_SOLVER_CONVERGENCE_FAILURES,
  FMURT_SOLVER_STATE_EVENTS,
  FMURT_SOLVER_TIME_EVENTS,
  FMURT_SOLVER_MAXIMUM_STEPS, /* an option, not a counter: steps allowed in one communication step */
  FMURT_SOLVER_INTEGER_COUNT
};

#endif
