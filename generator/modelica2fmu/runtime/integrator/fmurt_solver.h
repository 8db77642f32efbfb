/* fmurt_solver.h - the integrator inside a co-simulation instance: CVODE (BDF, dense Newton, root finding). */
#ifndef FMURT_SOLVER_H
#define FMURT_SOLVER_H

#include "fmurt_instance.h"

typedef enum fmurt_stop { FMURT_STOP_TARGET, FMURT_STOP_ROOT } fmurt_stop;

/* Makes the integrator of an instance; NULL if memory is short. It belongs to the caller. */
fmurt_solver *fmurt_solver_create(fmurt_instance *instance);
/* Frees an integrator; solver may be NULL. */
void fmurt_solver_destroy(fmurt_solver *solver);

/* Tells that the next step starts afresh from the instance's time and states: after values were set, and where the state of the FMU was saved or restored, so that going on from a saved state and
 * going on after restoring it give the same numbers. solver may be NULL. */
void fmurt_solver_restart(fmurt_solver *solver);
/* The same after an event; after one that an indicator told, the first step is no longer than the last before it. */
void fmurt_solver_restart_after_event(fmurt_solver *solver);

/* Allows so many steps of the integrator from now on, in all advances together. */
void fmurt_solver_allow_steps(fmurt_solver *solver, long count);

/* Integrates from the instance's time to target or to the first zero of an event indicator before it; never
 * evaluates the model after limit. Time and states of the instance are those reached, also where the result
 * is FMURT_RESULT_DISCARD (the last good point) or FMURT_RESULT_ERROR. */
fmurt_result fmurt_solver_advance(fmurt_solver *solver, double target, double limit, double maximum_step,
                                  fmurt_stop *stop);

#endif
