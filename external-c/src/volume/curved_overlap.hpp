// The overlap of convex shapes of which at least one is round.
#pragma once

#include "volume/convex_overlap.hpp"
#include "volume/shape_overlap.hpp"
#include "volume/slices/sliced_overlap.hpp"

namespace cmb::overlap {

// Room to work in; one for each thread. Grows in the first calls.
struct CurvedScratch {
  convex::OverlapScratch flat;
  SlicedOverlap slices;
};

// How two shapes lie to each other where they overlap.
struct DeepestPoints {
  Vec3 normal;   // unit
  Vec3 a, b;     // of either surface, a - b along the normal
};

// Of shapes A and B, neither a half-space nor a mesh, not both boxes or hulls, at their poses in the world.
ShapeOverlap curved_overlap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                            const DeepestPoints &deepest, CurvedScratch &scratch);

// The axis of a body of revolution that is not a ball; else zero. Sections along it have straight sides.
Vec3 straight_axis(const Shape &shape, const Pose &pose);

}  // namespace cmb::overlap
