/* fmurt_weight.c - see fmurt_weight.h.
 *
 * The error test holds each step to the tolerance, and errors add up. An impact takes some fifty steps however short it
 * is, all of which err alike by the share of the speed that the bodies come back with: it was off by up to 66 tolerances.
 * In free flight, at rest and in smooth motion steps are long, limited by something else or few in number. So short steps
 * may err by less, in proportion to their length, down to a tenth. Single impacts pay for that with a tenth more
 * evaluations or less, rest with nothing, machines that walk or many bodies that collide without end with half as many more.
 *
 * Errors of 1e-5 a step keep what is promised of impacts, and more is not done than that. */
#include "fmurt_weight.h"

#include <math.h>

/* From this length on, in s, steps may err by the tolerance, from a tenth of it downwards by a tenth: impacts of soft contacts
 * last 20 ms. */
static const double long_step = 0.05;
static const double least_share = 0.1, finest_tolerance = 1e-5;

double fmurt_share_of_tolerance(double last_step, double relative) {
  const double least = fmin(1.0, fmax(least_share, finest_tolerance / relative));
  return fmin(1.0, fmax(least, fabs(last_step) / long_step));
}

int fmurt_weigh(double share, double relative, const double *absolute, const double *state, size_t count,
                double *weight) {
  for (size_t i = 0; i < count; ++i) {
    weight[i] = 1.0 / (share * (relative * fabs(state[i]) + absolute[i]));
    if (!(weight[i] > 0.0 && isfinite(weight[i]))) return -1;
  }
  return 0;
}
