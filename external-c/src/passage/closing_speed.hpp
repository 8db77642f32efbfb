// How fast the surfaces of two bodies may come near each other.
#pragma once

#include <cstddef>

#include "math/vector3.hpp"
#include "scene/scene.hpp"

namespace cmb {

// Where a body is and how it moves, in world axes.
struct BodyMotion {
  Pose pose;
  Vec3 velocity, angular_velocity;  // of the origin of its frame
};

// What a body turns about without moving as a set of points, and how far its points are from there.
struct TurningReach {
  Vec3 center, axis;    // in the body's frame
  double radius = 0.0;  // infinite of half-spaces
  bool has_axis = false;  // turning about the axis moves nothing
};

TurningReach turning_reach(const Scene &scene, std::size_t body);

// The velocity of a body's centre against another's, and a bound of the rate at which their distance changes.
struct ClosingSpeed {
  Vec3 of_centers;
  double largest = 0.0;
};

ClosingSpeed closing_speed(const Scene &scene, std::size_t a, const TurningReach &reach_a, const BodyMotion &motion_a,
                           std::size_t b, const TurningReach &reach_b, const BodyMotion &motion_b);

}  // namespace cmb
