// Unpredictable choices, written so that compilers make no branches of them.
#pragma once

#include <cmath>
#include <cstddef>

namespace cmb::convex {

inline double twice_positive_part(double x) { return x + std::fabs(x); }

// x, or the nearer of 0 and 1.
inline double within_unit(double x) {
  const double raised = x > 0.0 ? x : 0.0;
  return raised < 1.0 ? raised : 1.0;
}

// The greatest of `count` numbers, none of which is a NaN; minus infinity of none. In four chains, none of which waits for
// another.
inline double greatest_of(const double *values, std::size_t count) {
  double greatest[4] = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    for (std::size_t chain = 0; chain < 4; ++chain) {
      greatest[chain] = values[k + chain] > greatest[chain] ? values[k + chain] : greatest[chain];
    }
  }
  for (; k < count; ++k) greatest[0] = values[k] > greatest[0] ? values[k] : greatest[0];
  const double first = greatest[0] > greatest[1] ? greatest[0] : greatest[1];
  const double second = greatest[2] > greatest[3] ? greatest[2] : greatest[3];
  return first > second ? first : second;
}

// The least of `count` numbers, likewise; infinity of none.
inline double least_of(const double *values, std::size_t count) {
  double least[4] = {HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL};
  std::size_t k = 0;
  for (; k + 4 <= count; k += 4) {
    for (std::size_t chain = 0; chain < 4; ++chain) {
      least[chain] = values[k + chain] < least[chain] ? values[k + chain] : least[chain];
    }
  }
  for (; k < count; ++k) least[0] = values[k] < least[0] ? values[k] : least[0];
  const double first = least[0] < least[1] ? least[0] : least[1];
  const double second = least[2] < least[3] ? least[2] : least[3];
  return first < second ? first : second;
}

}  // namespace cmb::convex
