// Where a polytope touches a disc that the polygon for the disc does not tell.
#pragma once

#include "manifold/disc_manifold.hpp"
#include "shape/polytope.hpp"

namespace cmb {

// The middle of what is about the deepest of a polytope's edges under a disc, half way between the surfaces. The deepest
// place, `deepest` (on the polytope, `depth` below the other surface), goes from one end of an edge to the other at once
// where the edge comes to lie in the disc's plane; this middle moves steadily, and is nearly that place where the
// polytope is a tip there. `witness`, half way at the deepest place, is what it becomes where no edge is under the disc.
Vec3 middle_of_deepest(const Disc &disc, const convex::Polytope &polytope, const Pose &pose, double depth,
                       const Vec3 &deepest, const Vec3 &witness);

}  // namespace cmb
