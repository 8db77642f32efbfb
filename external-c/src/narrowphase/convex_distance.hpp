// Signed distance of two convex bodies: exact Euclidean distance apart, minimum translation inside.
//
// For unit vectors m let h(m) be the support function of the Minkowski difference A - B. The signed
// distance is  max over m of -h(m):  the Euclidean distance where the bodies are apart, minus the
// length of the shortest translation that parts them where they overlap. A sphere sweeping either
// core adds its radius to h, so it is subtracted from the cores' signed distance.
//
// Deterministic; queries neither allocate nor throw, and end after a bounded number of steps.
#pragma once

#include <cstddef>
#include <cstdint>

#include "math/vector3.hpp"
#include "narrowphase/polytope/expanding_polytope.hpp"
#include "narrowphase/polytope/facet_walk.hpp"
#include "shape/convex_body.hpp"

namespace cmb::convex {

// Where a core touches its supporting plane perpendicular to the normal. Numbers are those of the
// Polytope; a box counts as Polytope::box; a segment's ends are the vertices 0 (-z) and 1 (+z).
enum class FeatureKind : std::uint8_t { vertex, edge, face, smooth };
struct Feature {
  FeatureKind kind = FeatureKind::smooth;
  std::int32_t index = -1;  // -1 for smooth
};

// Which algorithm gave the answer.
enum class DistanceMethod : std::uint8_t {
  closed_form,
  separating_axes,
  gjk,
  facet_walk,
  expanding_polytope,
  refined,
  brute_force
};

struct SignedDistance {
  double distance = 0.0;  // m; positive apart, negative inside
  Vec3 normal{0, 0, 1};   // unit, from B to A, in A's frame (of shapes: in world axes)
  Vec3 point_a;           // witness points on both surfaces, in A's frame:
  Vec3 point_b;           // point_a - point_b = distance * normal
  DistanceMethod method = DistanceMethod::closed_form;
  // Where the bodies overlap: a ball of this radius in the difference is known to touch its surface there (m; 0: none known).
  double interior_ball = 0.0;
  bool proven = true;  // the answer lies between bounds that agree to the tolerance; else the best found
};

// Room that queries work in and what they count; about 1 MB. One for each thread.
struct DistanceScratch {
  ExpandingPolytope expanding_polytope;
  FacetWalk facet_walk;
  struct Counters {
    std::uint64_t queries = 0;
    std::uint64_t walks = 0;        // overlaps of polytopes that a walk over the facets answered
    std::uint64_t brute_force = 0;  // polyhedral queries that only the last resort could answer
    std::uint64_t unproven = 0;     // smooth queries answered without proof
  } counters;
};

// The signed distance of A and B; `b_in_a` maps B's frame to A's, its rotation orthonormal to 1e-9.
// A pose that is not finite gives distance 0, the normal {0, 0, 1} and proven = false.
SignedDistance signed_distance(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, DistanceScratch &scratch);

// The vertex, edge or face of a body's core that its supporting plane along m (unit, in the body's frame) touches, to
// 1e-8 rad: with m = -normal for A, and the normal in B's frame for B, where they are nearest.
Feature support_feature(const ConvexBody &body, const Vec3 &m);

}  // namespace cmb::convex
