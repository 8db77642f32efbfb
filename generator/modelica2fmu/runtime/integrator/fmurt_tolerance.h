/* fmurt_tolerance.h - how far states and steps may err, and of which order steps are at most. */
#ifndef FMURT_TOLERANCE_H
#define FMURT_TOLERANCE_H

#include <stddef.h>

/* The absolute tolerance of a state of this nominal value (1 is taken where it is not positive), at the relative tolerance
 * `relative` > 0. `option` > 0: asked for, as a share of the nominal value; else the usual one. */
double fmurt_absolute_tolerance(double relative, double option, double nominal);

/* The share of the tolerance by which a step may err after one of `last_step` seconds; 0: there was none since the start.
 * In (0, 1]; `relative` > 0 is the relative tolerance. */
double fmurt_share_of_tolerance(double last_step, double relative);

/* The highest order of CVODE's backward differentiation formulas. Where a contact opens, the formula of order 5 keeps what
 * was before in swings that die out slowly, within the tolerance: a ball's energy rose in flight. */
int fmurt_highest_order(double relative);

/* weight[i] = 1 / (share * (relative * |state[i]| + absolute[i])) for count states. Returns 0, or -1 if one is not finite
 * and positive. */
int fmurt_weigh(double share, double relative, const double *absolute, const double *state, size_t count,
                double *weight);

#endif
