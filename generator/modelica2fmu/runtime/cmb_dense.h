/* cmb_dense.h - dense linear solver for the integrator's Newton iteration.
 *
 * Does what SUNLinSol_Dense does. Debian's static SUNDIALS library is compiled without optimization, so that its own
 * dense solver takes more time than the equations of a mechanism with 50 states. */
#ifndef CMB_DENSE_H
#define CMB_DENSE_H

#include <sundials/sundials_linearsolver.h>

/* A direct solver for SUNDenseMatrix of `size` rows, which Setup overwrites with its factors. NULL if there is no
 * memory. Free with SUNLinSolFree. */
SUNLinearSolver cmb_dense_create(sunindextype size, SUNContext context);

#endif
