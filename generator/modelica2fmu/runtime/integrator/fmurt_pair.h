/* fmurt_pair.h - the pair of orders 3 and 2 of Bogacki and Shampine (Applied Mathematics Letters 2, 1989): a step of it, state by
 * state, and how long the next one may be. Three evaluations a step, as the last one is the first of the next step. Of pairs of
 * orders 3, 5 and 8 and of stabilised ones of order 2 it needs fewest evaluations where bodies collide. */
#ifndef FMURT_PAIR_H
#define FMURT_PAIR_H

#include <math.h>
#include <stddef.h>

/* How much longer and shorter than the last step the next one may be. */
static const double fmurt_pair_largest_growth = 5.0, fmurt_pair_largest_shrink = 0.2;
/* Smaller estimates, by the largest, tell nothing of the next one. */
static const double fmurt_pair_least_estimate = 1e-4;
/* A first step in which the states change by this part of their tolerances' scale, as their derivatives say. */
static const double fmurt_pair_first_change = 0.01;
/* A step of fewer roundings of the time leads nowhere. */
static const double fmurt_pair_least_roundings = 16.0;
/* Of the step that the error estimate permits. */
static const double fmurt_pair_safety = 0.9;

/* Where a state is, of a step that begins at `state`, when the slope of `stage` is asked for: half way, three quarters, at the end,
 * which stage 3 reaches with order 3. Slopes of later stages are not read. */
static inline double fmurt_pair_place(int stage, double step, double state, double *const *slope, size_t i) {
  if (stage == 1) return state + 0.5 * step * slope[0][i];
  if (stage == 2) return state + 0.75 * step * slope[1][i];
  return state + step / 9.0 * (2.0 * slope[0][i] + 3.0 * slope[1][i] + 4.0 * slope[2][i]);
}

/* The difference of both orders, the error of order 2. */
static inline double fmurt_pair_difference(double step, double *const *slope, size_t i) {
  return step / 72.0 * (-5.0 * slope[0][i] + 6.0 * slope[1][i] + 8.0 * slope[2][i] - 9.0 * slope[3][i]);
}

/* The step to try after one whose error, by the largest permitted, was too large or none. */
static inline double fmurt_pair_after_failure(double step, double error) {
  return step * (isfinite(error) ? fmax(fmurt_pair_largest_shrink, fmurt_pair_safety * pow(error, -1.0 / 3.0))
                                 : fmurt_pair_largest_shrink);
}

/* The step that the last estimates, by the largest, permit: `error` and the one before (Gustafsson, ACM Transactions on Mathematical
 * Software 17, 1991). Where stability limits steps, as where friction rises steeply with the sliding speed, the last one alone makes
 * them swing about the limit: every fourth is rejected, and those beyond it leave several times the error. */
static inline double fmurt_pair_permitted(double step, double growth, double error, double before) {
  const double by_last = 0.8 / 3.0, by_one_before = 0.25 / 3.0;
  return step * fmin(growth, fmurt_pair_safety * pow(error, -by_last) * pow(before, by_one_before));
}

#endif
