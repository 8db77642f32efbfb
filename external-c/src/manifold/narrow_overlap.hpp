// Axes along overlaps that are narrow.
#pragma once

#include <cmath>

#include "math/symmetric_matrix.hpp"

namespace cmb {

// Whether what has this spread (the mean of the products of coordinates from its middle) is so narrow across z, as the overlap of an edge, that
// the square of its width may be lost beside that of its length; `turn` then maps to axes turned about z to run along it.
inline bool find_turn_along_narrow(const convex::SymmetricMatrix &spread, convex::Mat3 &turn) {
  constexpr double narrow = 1e-4;  // of squares
  const double xx = spread.m[0], yy = spread.m[1], xy = spread.m[5], both = xx + yy;
  if (!(xx * yy - xy * xy < narrow * both * both)) return false;
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy), along = std::cos(angle), across = std::sin(angle);
  turn = {{convex::Vec3{along, across, 0.0}, convex::Vec3{-across, along, 0.0}, convex::Vec3{0.0, 0.0, 1.0}}};
  return true;
}

}  // namespace cmb
