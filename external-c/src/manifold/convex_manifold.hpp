// Contact of two bounded convex shapes.
#pragma once

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"
#include "manifold/curved_manifold.hpp"
#include "manifold/polytope/elastic_contact.hpp"
#include "manifold/revolved/revolved_contact.hpp"

namespace cmb {

// Room that manifolds are made in; one for each thread.
struct ManifoldScratch {
  ElasticScratch polytopes;
  RevolvedScratch revolved;
  CurvedManifoldScratch curved;
};

// Appends the contact of shapes A and B (no half-spaces), whose signed distance is `answer`; further distances are found
// in `distance`. distance, normal and witness of `result` are set.
void convex_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const SignedDistance &answer,
                    convex::DistanceScratch &distance, ManifoldScratch &scratch, ContactSet &result);

}  // namespace cmb
