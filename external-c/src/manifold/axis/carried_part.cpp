#include "manifold/axis/carried_part.hpp"

#include <algorithm>

#include "math/smoothstep.hpp"

namespace cmb {

namespace {

// Of the minimum translation: an axis this much less deep pierces the obstacle.
constexpr double pierced_part = 0.25;
// Of the radius: how deep is wholly deep.
constexpr double all_part = 1.0;
// The part of the axis near edges up to which its energy carries all, and from which on nothing.
constexpr double few_near = 0.3, many_near = 0.8;

// From 1 at `full` to 0 at `none`.
double fading(double x, double full, double none) { return convex::falling_smoothstep(std::max(0.0, (x - full) / (none - full))); }

}  // namespace

double carried_part(double near_edges, double deepest, double depth, double radius) {
  const double clear = fading(near_edges, few_near, many_near);
  const double out = deepest > radius ? fading(1.0 - deepest / depth, 0.0, pierced_part) : 1.0;
  return out * (1.0 - (1.0 - clear) * (1.0 - fading(depth / radius, deep_axis_part, all_part)));
}

}  // namespace cmb
