// Contact of two bounded convex shapes of which one at least is curved.
#pragma once

#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/axis/capsule_on_polytope.hpp"
#include "manifold/contact_set.hpp"
#include "manifold/line_manifold.hpp"

namespace cmb {

// Room that contacts are made in; one for each thread.
struct CurvedManifoldScratch {
  LineManifoldScratch axis;
  CapsuleScratch capsule;
};

// Appends the contact of shapes A and B that overlap; `answer` is their signed distance (< 0). The contact is the sum of
// those along all contact directions (narrowphase/multicontact/contact_directions.hpp), each by its share. Further distances
// are found in `distance`.
void curved_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                    convex::DistanceScratch &distance, CurvedManifoldScratch &scratch,
                    std::vector<ContactPoint> &points);

}  // namespace cmb
