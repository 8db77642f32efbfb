// Back ends: who computes the signed distance of two convex shapes.
#pragma once

#include <memory>
#include <optional>

#include "contact_multibody.h"
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
  // jump (narrowphase/polytope/nearby_surface.hpp). Else the normal.
  Vec3 mean_normal;
  // From the exact path, where the shapes overlap: a ball of this radius in A - B touches its surface there (m; 0: none known).
  double ball = 0.0;
};

// Room that back ends work in; one for each thread.
struct BackendScratch {
  convex::DistanceScratch distance;
};

// A back end answers or, where it has no answer it vouches for, returns nothing; it never throws and never aborts.
// Neither shape is a half-space or a mesh; poses map the shapes' frames to the world. FCL and coal answer for shapes only
// that they hold (Shape::in_library).
using DistanceFunction = std::optional<ConvexAnswer> (*)(const Shape &a, const Pose &pose_a, const Shape &b,
                                                         const Pose &pose_b, BackendScratch &scratch);

// The engine's own exact path; answers everything.
void find_exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, BackendScratch &scratch,
                         ConvexAnswer &answer);
std::optional<ConvexAnswer> exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                           BackendScratch &scratch);
// libccd's Minkowski portal refinement; answers overlapping shapes only.
std::optional<ConvexAnswer> libccd_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                            BackendScratch &scratch);
// FCL's collide and distance with its own solver.
std::optional<ConvexAnswer> fcl_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                         BackendScratch &scratch);
// coal's signed distance, where the engine was built with coal (CMake option CMB_COAL) and finds it; else no answer.
std::optional<ConvexAnswer> coal_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                          BackendScratch &scratch);
bool coal_is_available();

// The shape as FCL or coal holds it; null where it has none. Throw std::bad_alloc.
std::shared_ptr<const LibraryShape> make_fcl_shape(const Shape &shape);
std::shared_ptr<const LibraryShape> make_coal_shape(const Shape &shape);

// A back end that is a library.
struct DistanceLibrary {
  DistanceFunction distance;
  std::shared_ptr<const LibraryShape> (*make_shape)(const Shape &shape);  // null where it takes the engine's shapes
};

// Null for the engine's own.
const DistanceLibrary *distance_library(cmb_backend backend);

// Whether a library's answer holds: finite, unit normal, and the two shapes' extents along it leave the distance it
// says to `tolerance` (relative to the shapes' size). An overlap's depth that is true along the normal but not the
// least of all directions passes: only an exact search can tell.
bool answer_holds(const ConvexAnswer &answer, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                  double tolerance);

}  // namespace cmb
