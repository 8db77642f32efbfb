/* fmurt_tolerance.c - see fmurt_tolerance.h. */
#include "fmurt_tolerance.h"

#include <math.h>

/* The absolute tolerance, divided by a state's nominal value, where the importer gives none. Positions have the nominal
 * value 1 m as a rule and penetrations of a micrometre matter, so the usual share 1 of the relative tolerance would
 * leave them undetermined; more than a tenth of a micrometre leaves the springs of static friction so. Below a nanometre
 * the rounding errors of contact geometry, multiplied by the stiffness of the contact, keep Newton from converging
 * (tried on stacks and on a box that lands on its edge). */
static double default_absolute(double relative) { return fmin(relative, fmin(fmax(1e-3 * relative, 1e-9), 1e-7)); }

/* Nominal values below 1, as of stretches of friction's springs, tell the size that matters themselves: a share of a share
 * would ask for picometres, where steps fail over kinks that nothing depends on. */
double fmurt_absolute_tolerance(double relative, double option, double nominal) {
  if (!(nominal > 0.0)) nominal = 1.0;
  if (option > 0.0) return option * nominal;
  return nominal < 1.0 ? fmin(default_absolute(relative), relative * nominal) : default_absolute(relative) * nominal;
}

/* The error test holds each step to the tolerance, and errors add up. An impact takes some fifty steps however short it
 * is, all of which err alike by the share of the speed that the bodies come back with: it was off by up to 66 tolerances.
 * In free flight, at rest and in smooth motion steps are long, limited by something else or few in number. So short steps
 * may err by less, in proportion to their length, down to a share of 0.08. Single impacts pay for that with a tenth more
 * evaluations or less, rest with nothing, machines that walk or many bodies that collide without end with half as many more.
 *
 * Errors of 8e-6 a step keep what is promised of impacts, and more is not done than that. From `long_step`
 * seconds on steps may err by the tolerance: slow impacts of soft contacts last 150 ms. */
static const double long_step = 0.2, least_share = 0.08, finest_tolerance = 8e-6;

/* From this relative tolerance down steps may be of order 5, which saves evaluations below it. At it order 4 would save some, but
 * small balls that bounce without events come out worse: off by 82 tolerances in place of 68. */
static const double fine_tolerance = 1e-6;

double fmurt_share_of_tolerance(double last_step, double relative) {
  const double least = fmin(1.0, fmax(least_share, finest_tolerance / relative));
  return fmin(1.0, fmax(least, fabs(last_step) / long_step));
}

int fmurt_highest_order(double relative) { return relative <= fine_tolerance ? 5 : 4; }

int fmurt_weigh(double share, double relative, const double *absolute, const double *state, size_t count,
                double *weight) {
  for (size_t i = 0; i < count; ++i) {
    weight[i] = 1.0 / (share * (relative * fabs(state[i]) + absolute[i]));
    if (!(weight[i] > 0.0 && isfinite(weight[i]))) return -1;
  }
  return 0;
}
