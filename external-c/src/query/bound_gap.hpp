// A lower bound of the distance of two shapes or bodies, from their bounds alone.
#pragma once

#include "scene/body_bounds.hpp"
#include "shape/shape.hpp"

namespace cmb {

// How far apart bounds are: positive only where what they hold is apart, and then never more than its distance.
// Continuous in the poses.
struct BoundGap {
  double distance;       // m; the larger of the gaps between bounding spheres and between bounding boxes
  Vec3 normal, witness;  // as of a contact, by the spheres: along the line of their centres
};

// Of two shapes, not both half-spaces, at their poses in the world. Of a half-space the plane stands for its bounds.
BoundGap bound_gap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b);

// Of two bodies that are bounded.
BoundGap bound_gap(const BodyBounds &a, const Pose &pose_a, const BodyBounds &b, const Pose &pose_b);

// The gap between the bounding spheres alone, or between such a sphere and a half-space: never more than that of
// bound_gap, and cheaper.
double sphere_gap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b);

}  // namespace cmb
