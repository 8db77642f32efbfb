/* fmurt_dead_center.h - nonlinear systems that come to where two of their solutions meet and end, as at a dead centre of a mechanism.
 *
 * The true motion goes on into the other solution, while the one that is followed leads back: the unknowns would turn round
 * without a cause, and nothing else would show it. The determinant of the system's Jacobian falls to zero there. A step beyond the
 * time when it would be zero, after which the unknowns have turned back, is to be taken shorter. Where unknowns turn by themselves,
 * short steps see them become slow before; at a dead centre the time that is left becomes ever shorter instead. */
#ifndef FMURT_DEAD_CENTER_H
#define FMURT_DEAD_CENTER_H

#include "fmurt_model.h"

/* Doubles that the arrays of fmurt_history need, and where they begin. */
size_t fmurt_history_size(size_t followed_count);
fmurt_history fmurt_history_in(double *memory, size_t followed_count);

/* The point at hand is about to be accepted: what values->accepted and the history say of the present is the past then. */
void fmurt_history_shift(fmurt_values *values);

/* Nothing is known of the past, as after events. */
void fmurt_history_forget(fmurt_values *values);

/* The determinant of the Jacobian at the accepted solution of the system at `offset`. */
void fmurt_history_learn(fmurt_values *values, int offset, double determinant);

typedef enum fmurt_course {
  FMURT_GOES_ON,
  FMURT_MAY_TURN_BACK, /* it does if the determinant has the same sign as at the accepted solution */
  FMURT_TURNS_BACK     /* short steps have shown it */
} fmurt_course;

/* What becomes of the system at `offset` with the solution x[n], found from the accepted one; `scale` has the sizes of unknowns. */
fmurt_course fmurt_history_course(const fmurt_values *values, int offset, int n, const double *x, const double *scale);

/* It turned back: the step is too long. */
void fmurt_history_note(fmurt_values *values, int offset, int n, const double *scale);

#endif
