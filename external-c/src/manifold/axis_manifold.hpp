// Contact of capsules with bounded convex shapes.
#pragma once

#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"

namespace cmb {

// Room that capsule contacts are made in; one for each thread.
struct AxisManifoldScratch {
  // A place on the capsule's axis and the contact of a sphere there.
  struct Station {
    double along = 0.0;  // m, from the axis' middle
    double depth = 0.0;  // may be negative
    Vec3 normal, position;
  };
  std::vector<Station> stations;
  BackendScratch backend;
};

// Appends the contact of A and B, at least one of which is a capsule, whose signed distance is `answer` (< 0).
//
// Spheres at stations along the axis penetrate by depths that form a concave function of the place. A station's
// weight is the part of all inclinations under which it would be the deepest; the weights sum to 1. Of two capsules
// each axis gives half.
void axis_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const ConvexAnswer &answer,
                  AxisManifoldScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
