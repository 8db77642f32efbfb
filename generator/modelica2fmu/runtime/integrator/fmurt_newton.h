/* fmurt_newton.h - Newton's iteration for the integrator, with a convergence test that an old matrix cannot deceive. */
#ifndef FMURT_NEWTON_H
#define FMURT_NEWTON_H

#include <sundials/sundials_nonlinearsolver.h>

/* Makes a solver for CVodeSetNonlinearSolver; NULL if memory is short. Free with SUNNonlinSolFree.
 *
 * like: a vector of the states' size, not kept.
 * quotients: how many of the next Jacobians the integrator shall compute by difference quotients of the whole right-hand
 *   side, because the model's own was found wrong; set here, counted down by the integrator's Jacobian function, and
 *   outliving the solver. NULL where there is but one way to a Jacobian. */
SUNNonlinearSolver fmurt_newton_create(N_Vector like, int *quotients, SUNContext context);

#endif
