// The angle of a vector of the plane.
#pragma once

#include <cmath>

namespace cmb::convex {

// The angle between the x axis and (x, y), y >= 0; 0 where both are 0. As std::atan2 gives it, to 5e-16, in less than half
// of the time and with the same bits whatever the C library. The arc tangent of up to tan(pi/8) is a polynomial through the
// Chebyshev nodes (relative error 4e-17); larger ones follow from the angles to the diagonal and to the y axis.
inline double angle_from_x(double x, double y) {
  constexpr double tangent_of_eighth = 0.41421356237309503, pi = 3.14159265358979323846;
  const double ax = std::fabs(x), low = ax < y ? ax : y, high = ax < y ? y : ax;
  // 1 or 0; without branches, all of which would be unpredictable.
  const double near_diagonal = 0.5 + std::copysign(0.5, low - tangent_of_eighth * high);
  const double flat = 0.5 + std::copysign(0.5, ax - y);
  const double t = (low - near_diagonal * high) / (high + near_diagonal * low), s = t * t, s2 = s * s, s4 = s2 * s2;
  const double first = (1.0 + -0.3333333333332844 * s) + (0.1999999999885511 + -0.14285714180976467 * s) * s2;
  const double second =
      (0.11111106180455946 + -0.09090773074808414 * s) + (0.07689953496306857 + -0.06640233930429408 * s) * s2;
  const double third = 0.056883492268090106 + -0.04348052215716462 * s + 0.021135373157693246 * s2;
  const double angle = near_diagonal * (0.25 * pi) + t * (first + s4 * (second + s4 * third));
  // From the axis that is nearer, forwards or backwards.
  const double side = std::copysign(1.0, x), from = 0.5 * pi - 0.5 * pi * side * flat;
  return high > 0.0 ? from + side * (2.0 * flat - 1.0) * angle : 0.0;
}

}  // namespace cmb::convex
