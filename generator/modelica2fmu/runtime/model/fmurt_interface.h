/* cmb_interface.h - what the FMI runtime knows of the variables' interface.
 *
 * Written as cmb_interface.c from the same description as modelDescription.xml, so that the checks the
 * runtime makes and the promises of the XML cannot differ. */
#ifndef CMB_INTERFACE_H
#define CMB_INTERFACE_H

#include <stddef.h>

/* When a slot may be set (FMI 2.0.4, section 2.2.7 and the state machines of 3.2.3 and 4.2.4), and its kind. */
enum {
  CMB_SET_INSTANTIATED = 1,
  CMB_SET_INITIALIZATION = 2,
  CMB_SET_EVENT = 4,
  CMB_SET_CONTINUOUS = 8,
  CMB_IS_DISCRETE = 16,    /* changes at events only: its change repeats the event iteration */
  CMB_IS_PARAMETER = 32,   /* fixed or tunable: computed by cmb_model.parameters */
  CMB_IS_INDEPENDENT = 64  /* the time */
};

/* Slots of one base type; slots from count on are not variables of the FMU. */
typedef struct cmb_slot_table {
  size_t count;
  const unsigned char *access;     /* [count], may be NULL if count is 0 */
  const char *const *name;         /* [count], entries NULL where no variable shows the slot */
} cmb_slot_table;

typedef struct cmb_interface {
  cmb_slot_table real, integer, boolean, string;
  double start_time, stop_time;    /* default experiment; stop_time is HUGE_VAL if it does not say */
  double relative_tolerance;       /* of the co-simulation solver where the importer gives none */
  double absolute_tolerance;       /* times a state's nominal value; 0: see cmb_solver.c */
  double maximum_step;             /* s; 0: the communication step */
  int maximum_steps;               /* of the integrator in one communication step */
} cmb_interface;

extern const cmb_interface cmb_interface_tables;

/* Variables of the co-simulation solver, beside those of the model. */
enum { CMB_SOLVER_FIRST_REFERENCE = 0x40000000 };
enum { CMB_SOLVER_RELATIVE_TOLERANCE, CMB_SOLVER_ABSOLUTE_TOLERANCE, CMB_SOLVER_MAXIMUM_STEP, CMB_SOLVER_REAL_COUNT };
enum {
  CMB_SOLVER_STEPS,
  CMB_SOLVER_EVALUATIONS,        /* of the model's right-hand side, those for Jacobians included */
  CMB_SOLVER_JACOBIANS,
  CMB_SOLVER_ERROR_TEST_FAILURES,
  CMB_SOLVER_CONVERGENCE_FAILURES,
  CMB_SOLVER_STATE_EVENTS,
  CMB_SOLVER_TIME_EVENTS,
  CMB_SOLVER_MAXIMUM_STEPS,      /* an option, not a counter: steps allowed in one communication step */
  CMB_SOLVER_INTEGER_COUNT
};

#endif
