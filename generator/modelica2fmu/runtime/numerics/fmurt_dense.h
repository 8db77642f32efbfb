/* fmurt_dense.h - linear solver for the integrator's Newton iteration, whose matrix is I - gamma J.
 *
 * Rows with few entries are eliminated first: the rate of a position is a speed, so a mechanism's matrix shrinks to
 * half its size, and its factorization to an eighth. */
#ifndef FMURT_DENSE_H
#define FMURT_DENSE_H

#include <sundials/sundials_linearsolver.h>

/* A direct solver for SUNDenseMatrix of `size` rows, which it leaves as they are. NULL if there is no memory. Free with
 * SUNLinSolFree. */
SUNLinearSolver fmurt_dense_create(sunindextype size, SUNContext context);

#endif
