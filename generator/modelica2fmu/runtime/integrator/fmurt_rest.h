/* fmurt_rest.h - whether nothing moves.
 *
 * At rest the error test has nothing to choose the order of steps by. Formulas of higher order extrapolate what Newton's
 * iteration leaves of the residual, and bodies at rest tremble within the tolerance: a block that friction holds by up to
 * 2e-6 m/s. So there steps are of order one, with Jacobians by difference quotients: the derivatives of friction at no
 * speed at all, which the model's own Jacobian has, hold for speeds of 1e-12 m/s alone. */
#ifndef FMURT_REST_H
#define FMURT_REST_H

#include <stddef.h>

/* All zero at first. */
typedef struct fmurt_rest {
  double *place;   /* [count] states that nothing has moved away from; owned by who owns this */
  double since;    /* time at which they were there */
  int intervals;   /* that have passed since; 0: the place is not known yet */
  int rests;       /* = 1, if there were enough of them */
} fmurt_rest;

/* Tells of the states at the end of an interval, and by which weights changes count: the inverse errors that are allowed.
 * They rest where ten intervals and a tenth of a second have not moved them by 1 in the mean square, until something
 * does. Returns 1 where `rests` is another one than before. */
int fmurt_rest_watch(fmurt_rest *rest, double time, const double *state, const double *weight, size_t count);

#endif
