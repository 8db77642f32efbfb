// Forces between the bodies of a scene.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "broadphase/broad_phase.hpp"
#include "contact_multibody_scene.h"
#include "query/pair_query.hpp"
#include "response/pair_laws.hpp"

namespace cmb {

// Room that an evaluation works in; one for each thread.
struct ResponseScratch {
  BroadPhaseScratch broad_phase;
  PairLaws laws;
  std::vector<double> deceleration;
  std::vector<Vec3> force, torque;
  std::vector<std::uint32_t> among;
};

// This thread's scratch.
ResponseScratch &response_scratch();

// Calls visit(body_a, body_b, points) for each pair of bodies of scratch.candidates that touches, sorted, body_a < body_b, 0-based.
// `points` is a std::vector<ContactPoint>, valid during the call.
template <typename Visit>
void visit_touching(const BroadPhase &broad_phase, BroadPhaseScratch &scratch, QueryScratch &query, Visit &&visit) {
  const Scene &scene = broad_phase.scene();
  const std::vector<Candidate> &candidates = scratch.candidates;
  for (std::size_t i = 0; i < candidates.size();) {
    const std::size_t a = candidates[i].body_a, b = candidates[i].body_b;
    std::vector<ContactPoint> &points = query.contact.points;
    points.clear();
    for (; i < candidates.size() && candidates[i].body_a == a && candidates[i].body_b == b; ++i) {
      const Candidate &candidate = candidates[i];
      ContactSet &contact = query.shape_contact;
      contact.points.clear();
      cmb_backend who = CMB_BACKEND_AUTO;
      query_shapes(scene, scene.bodies[a][candidate.shape_a],
                   scratch.shape_poses[broad_phase.first_shape(a) + candidate.shape_a],
                   scene.bodies[b][candidate.shape_b],
                   scratch.shape_poses[broad_phase.first_shape(b) + candidate.shape_b], query, contact, who);
      points.insert(points.end(), contact.points.begin(), contact.points.end());
    }
    if (!points.empty()) visit(a, b, points);
  }
}

// The same for all pairs that touch where scratch.body_poses says that the bodies are.
template <typename Visit>
void visit_contacts(const BroadPhase &broad_phase, BroadPhaseScratch &scratch, QueryScratch &query, Visit &&visit) {
  broad_phase.find_candidates(scratch);
  visit_touching(broad_phase, scratch, query, visit);
}

// Fills scratch.force and scratch.torque, of each body; scratch.broad_phase.body_poses are those of the motion. Arguments are
// valid but for what PairLaws complains of: throws ResponseError.
cmb_response_sums evaluate_response(const BroadPhase &broad_phase, const cmb_contact_law &law,
                                    const cmb_body_properties &properties, const cmb_motion &motion,
                                    ResponseScratch &scratch, QueryScratch &query);

// The same were there no other bodies than scratch.among, 0-based and ascending: nothing is read or written of others.
cmb_response_sums evaluate_response_among(const BroadPhase &broad_phase, const cmb_contact_law &law,
                                          const cmb_body_properties &properties, const cmb_motion &motion,
                                          ResponseScratch &scratch, QueryScratch &query);

}  // namespace cmb
