// Anderson's acceleration of a fixed-point iteration: the next place to evaluate the map at is the combination of those so far
// whose residuals cancel best. D. G. Anderson, J. ACM 12 (1965); H. F. Walker and P. Ni, SIAM J. Numer. Anal. 49 (2011).
#pragma once

#include <algorithm>

#include "math/vector3.hpp"

namespace cmb::convex {

// Of `most` vectors at most. Keeps the last few evaluations.
template <int most>
class AndersonMixing {
 public:
  void restart() { columns_ = 0, started_ = false; }

  // `at` is where the map was evaluated and `mapped` its value there (`count` vectors each, as many as since the last
  // restart); `at` receives where to evaluate it next.
  void mix(Vec3 *at, const Vec3 *mapped, int count) {
    Stack value, residual;
    for (int k = 0; k < count; ++k) value.part[k] = mapped[k], residual.part[k] = mapped[k] - at[k];
    if (started_) {
      std::move_backward(by_residual_, by_residual_ + depth - 1, by_residual_ + depth);
      std::move_backward(by_value_, by_value_ + depth - 1, by_value_ + depth);
      by_residual_[0] = combination(residual, -1.0, last_residual_, count);
      by_value_[0] = combination(value, -1.0, last_value_, count);
      columns_ = std::min(columns_ + 1, depth);
    }
    last_value_ = value, last_residual_ = residual, started_ = true;
    // Least squares: the differences of residuals made orthonormal, the latest first, and what they account for taken off.
    Stack unit[depth], step[depth];
    int used = 0;
    for (int c = 0; c < columns_; ++c) {
      Stack r = by_residual_[c], v = by_value_[c];
      const double length = std::sqrt(product(r, r, count));
      for (int j = 0; j < used; ++j) {
        const double along = product(unit[j], r, count);
        r = combination(r, -along, unit[j], count);
        v = combination(v, -along, step[j], count);
      }
      const double rest = std::sqrt(product(r, r, count));
      if (!(rest > independent * length)) continue;
      unit[used] = combination({}, 1.0 / rest, r, count);
      step[used] = combination({}, 1.0 / rest, v, count);
      const double part = product(unit[used], residual, count);
      residual = combination(residual, -part, unit[used], count);
      value = combination(value, -part, step[used], count);
      ++used;
    }
    std::copy_n(value.part, count, at);
  }

 private:
  static constexpr int depth = 3;
  static constexpr double independent = 1e-6;
  struct Stack {
    Vec3 part[most];
  };

  static double product(const Stack &a, const Stack &b, int count) {
    double sum = 0.0;
    for (int k = 0; k < count; ++k) sum += dot(a.part[k], b.part[k]);
    return sum;
  }
  static Stack combination(const Stack &a, double factor, const Stack &b, int count) {
    Stack result;
    for (int k = 0; k < count; ++k) result.part[k] = a.part[k] + factor * b.part[k];
    return result;
  }

  Stack by_residual_[depth], by_value_[depth], last_residual_, last_value_;  // differences, the latest first
  int columns_ = 0;
  bool started_ = false;
};

}  // namespace cmb::convex
