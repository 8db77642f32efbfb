// How two ends of a rod, and the stations along it, share a load that comes at an angle.
#pragma once

#include "math/smoothstep.hpp"

namespace cmb {

// The part that the end nearer to the obstacle carries, minus the other end's, where `sine` is that of the
// rod's inclination to the contact plane, in [-1, 1]: 0 lying, 1 upright, smooth at both. Of one number or several at once.
template <typename Number>
inline Number end_share_difference(Number sine) {
  return 0.5 * sine * (3.0 - sine * sine);
}

// Its derivative by `sine`.
template <typename Number>
inline Number end_share_slope(Number sine) {
  return 1.5 * (1.0 - sine * sine);
}

// Stations of a line nearer than this, relative to half its length, count as one.
constexpr double station_spacing = 1e-9;

// Sine of the inclination at which a disc no longer touches with its face.
constexpr double flat_sine = 0.25;

// How a way of touching fades as a body inclines.
using convex::falling_smoothstep;
using convex::falling_smoothstep_slope;

}  // namespace cmb
