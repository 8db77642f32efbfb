/* fmurt_weight.h - how large an error of a step is beside the tolerance. */
#ifndef FMURT_WEIGHT_H
#define FMURT_WEIGHT_H

#include <stddef.h>

/* The share of the tolerance by which a step may err after one of `last_step` seconds; 0: there was none since the start.
 * In (0, 1]; `relative` > 0 is the relative tolerance. */
double fmurt_share_of_tolerance(double last_step, double relative);

/* weight[i] = 1 / (share * (relative * |state[i]| + absolute[i])) for count states. Returns 0, or -1 if one is not finite
 * and positive. */
int fmurt_weigh(double share, double relative, const double *absolute, const double *state, size_t count,
                double *weight);

#endif
