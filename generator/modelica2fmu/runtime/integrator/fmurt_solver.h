/* cmb_solver.h - the integrator inside a co-simulation instance: CVODE (BDF, dense Newton, root finding). */
#ifndef CMB_SOLVER_H
#define CMB_SOLVER_H

#include "cmb_instance.h"

typedef enum cmb_stop { CMB_STOP_TARGET, CMB_STOP_ROOT } cmb_stop;

/* Makes the integrator of an instance; NULL if memory is short. It belongs to the caller. */
cmb_solver *cmb_solver_create(cmb_instance *instance);
/* Frees an integrator; solver may be NULL. */
void cmb_solver_destroy(cmb_solver *solver);

/* Tells that the next step starts afresh from the instance's time and states: after events, after values
 * were set, and where the state of the FMU was saved or restored, so that going on from a saved state and
 * going on after restoring it give the same numbers. solver may be NULL. */
void cmb_solver_restart(cmb_solver *solver);

/* Allows so many steps of the integrator from now on, in all advances together. */
void cmb_solver_allow_steps(cmb_solver *solver, long count);

/* Integrates from the instance's time to target or to the first zero of an event indicator before it; never
 * evaluates the model after limit. Time and states of the instance are those reached, also where the result
 * is CMB_RESULT_DISCARD (the last good point) or CMB_RESULT_ERROR. */
cmb_result cmb_solver_advance(cmb_solver *solver, double target, double limit, double maximum_step, cmb_stop *stop);

#endif
