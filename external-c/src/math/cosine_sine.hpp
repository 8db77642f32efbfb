// Cosines and sines of angles that are not wide, two at once.
#pragma once

#include <cmath>

#include "math/lanes.hpp"

namespace cmb::convex {

// Up to this angle (rad) the series below end with less than rounding.
constexpr double widest_of_series = 1.0;

// By Taylor's series: to 2e-16 of angles up to widest_of_series. A library's functions, which first look for the quadrant, take several times as long.
inline void find_cosine_sine(Lanes angle, Lanes &cosine, Lanes &sine) {
  constexpr double f2 = 2.0, f3 = 6.0, f4 = 24.0, f5 = 120.0, f6 = 720.0, f7 = 5040.0, f8 = 40320.0, f9 = 362880.0, f10 = 3628800.0,
                   f11 = 39916800.0, f12 = 479001600.0, f13 = 6227020800.0, f14 = 87178291200.0, f15 = 1307674368000.0,
                   f16 = 20922789888000.0, f17 = 355687428096000.0, f18 = 6402373705728000.0;
  const Lanes x = angle * angle;
  Lanes c = 1.0 / f16 - x * (1.0 / f18);
  c = -1.0 / f14 + x * c;
  c = 1.0 / f12 + x * c;
  c = -1.0 / f10 + x * c;
  c = 1.0 / f8 + x * c;
  c = -1.0 / f6 + x * c;
  c = 1.0 / f4 + x * c;
  cosine = 1.0 - (1.0 / f2) * x + (x * x) * c;
  Lanes s = -1.0 / f15 + x * (1.0 / f17);
  s = 1.0 / f13 + x * s;
  s = -1.0 / f11 + x * s;
  s = 1.0 / f9 + x * s;
  s = -1.0 / f7 + x * s;
  s = 1.0 / f5 + x * s;
  s = -1.0 / f3 + x * s;
  sine = angle + (angle * x) * s;
}

}  // namespace cmb::convex
