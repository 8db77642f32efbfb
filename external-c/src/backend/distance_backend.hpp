// Back ends: who computes the signed distance of two convex shapes.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "shape/shape.hpp"

namespace cmb {

using convex::SignedDistance;

// Room that back ends work in; one for each thread.
struct BackendScratch {
  convex::DistanceScratch distance;
};

// The engine's own exact path: answers for all shapes but half-spaces and meshes. Poses map the shapes' frames to the
// world, in whose axes the answer is. Never throws.
void find_exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, BackendScratch &scratch,
                         SignedDistance &answer);
SignedDistance exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                            BackendScratch &scratch);

// Whether a library's answer holds: finite, unit normal, and the two shapes' extents along it leave the distance it
// says to `tolerance` (relative to the shapes' size) and with its sign: what is said to be apart is apart. An overlap's
// depth that is true along the normal but not the least of all directions passes: only an exact search can tell.
bool answer_holds(const SignedDistance &answer, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                  double tolerance);

}  // namespace cmb
