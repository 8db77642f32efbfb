// What the corners of tessellated bodies store together.
#pragma once

#include <cmath>

namespace cmb {

// Few corners, or shallow ones, are springs: each stores its weight times half the square of its depth. A finely tessellated body
// would push with ever more of them the deeper it goes; its smooth body would push with one point as deep as the deepest place. Both
// are the energy E = L^2 / 2 of one depth L, the mean of the corners' depths d with their weights w that
//
//   psi(L / h) = sum of w psi(d / h),   psi(x) = x^2 / 2 up to 1, exp(x - 1) - 1/2 beyond,
//
// is: the root of their sum of squares where they lie less deep than h, the greatest of them where they lie much deeper. h is a few of
// the tessellation's steps. A face that rests flat is as deep as its corners. E grows with each depth, so no corner pulls; its
// derivatives are continuous, and the corners' forces are its exact gradient.
class TessellationEnergy {
 public:
  // `greatest`: of the corners' depths (m, > 0); `fineness`: how many corners are met for each metre of depth (1/m, >= 0).
  TessellationEnergy(double greatest, double fineness)
      : greatest_(greatest * fineness / steps), per_height_(fineness / steps), unit_(are_springs() ? 1.0 : std::exp(1.0 - greatest_)) {}

  // Whether no corner lies deeper than h: E is the sum of w d^2 / 2.
  bool are_springs() const { return greatest_ <= 1.0; }
  // Corners that are less deep (m) count by rounding alone.
  double level() const {
    constexpr double farthest = 25.0;  // exp(-25) of the deepest one's
    return greatest_ > farthest ? (greatest_ - farthest) / per_height_ : 0.0;
  }

  // psi and its derivative at the depth (m), in units of exp(greatest / h - 1), which may be large.
  struct Term {
    double value, slope;
  };
  Term at(double depth) const {
    const double x = depth * per_height_;
    if (x <= 1.0) return {0.5 * x * x * unit_, x * unit_};
    const double power = std::exp(x - greatest_);
    return {power - 0.5 * unit_, power};
  }

  // What follows from the sum of w psi over all corners.
  struct Mean {
    double depth;  // L, m
    double force;  // times w times the slope it is a corner's force, the derivative of E by its depth, m
    double share;  // times psi it is the derivative of E by a corner's weight, m^2
  };
  Mean mean(double sum) const {
    const bool beyond = sum > 0.5 * unit_;
    const double x = beyond ? greatest_ + std::log(sum + 0.5 * unit_) : std::sqrt(2.0 * sum / unit_);
    const double slope = beyond ? sum + 0.5 * unit_ : x * unit_, depth = x / per_height_;
    return {depth, depth / slope, depth / (slope * per_height_)};
  }

 private:
  // A ball whose corners carry a third each, as in a regular tessellation, is then as hard as it is deep: to 7 % from 8 corners on.
  static constexpr double steps = 2.0;

  double greatest_, per_height_, unit_;  // greatest depth by h; 1/h
};

}  // namespace cmb
