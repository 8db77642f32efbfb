// Back ends: who computes the signed distance of two convex shapes.
#pragma once

#include "narrowphase/convex_distance.hpp"
#include "shape/shape.hpp"

namespace cmb {

// The signed distance of shapes A and B in world axes.
struct ConvexAnswer {
  double distance = 0.0;  // m; negative: length of the shortest translation that parts them
  Vec3 normal;            // unit, from B to A
  Vec3 point_a, point_b;  // witness points; point_a - point_b = distance * normal
  bool proven = true;     // the answer lies between bounds that agree
  // Of boxes and hulls that overlap, from the exact path: the mean normal of the difference's surface, which does not
  // jump (narrowphase/polytope/mean_normal.hpp). Else the normal.
  Vec3 mean_normal;
  // From the exact path, where the shapes overlap: a ball of this radius in A - B touches its surface there (m; 0: none known).
  double interior_ball = 0.0;
};

// Room that back ends work in; one for each thread.
struct BackendScratch {
  convex::DistanceScratch distance;
};

// The engine's own exact path: answers for all shapes but half-spaces and meshes. Poses map the shapes' frames to the
// world. Never throws.
void find_exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, BackendScratch &scratch,
                         ConvexAnswer &answer);
ConvexAnswer exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                            BackendScratch &scratch);

// Whether a library's answer holds: finite, unit normal, and the two shapes' extents along it leave the distance it
// says to `tolerance` (relative to the shapes' size). An overlap's depth that is true along the normal but not the
// least of all directions passes: only an exact search can tell.
bool answer_holds(const ConvexAnswer &answer, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                  double tolerance);

}  // namespace cmb
