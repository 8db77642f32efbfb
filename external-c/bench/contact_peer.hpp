// Who computes the contact of a pair of shapes: the engine and its peers, each asked at the same poses.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "shape/shape.hpp"

namespace cmb::bench {

// A pair of shapes, and where both are.
struct PosedPair {
  std::string descriptor_a, descriptor_b;
  Shape a, b;                   // parsed from the descriptors
  std::vector<Pose> pose_a, pose_b;  // in step

  // Equal bodies share their geometry, whoever is asked.
  bool is_of_equals() const { return descriptor_a == descriptor_b; }
  bool has_mesh() const { return a.mesh || b.mesh; }  // convex or not
};

class ContactPeer {
 public:
  virtual ~ContactPeer() = default;
  // Computes the contact at pose k. Returns the signed distance found: NaN where the peer finds none.
  virtual double ask(std::size_t k) = 0;
};

// The pair is borrowed and must outlive the peer. Null where a peer has no answer for such shapes.
std::unique_ptr<ContactPeer> make_engine(const PosedPair &pair);       // cmb_query_scene, with its manifold and the exact distance
// The same, but of bodies that are apart bounds may tell how far at least: what a model asks that needs no clearances.
std::unique_ptr<ContactPeer> make_engine_within_bounds(const PosedPair &pair);
std::unique_ptr<ContactPeer> make_libccd_portal(const PosedPair &pair);  // ccdMPRPenetration: one point
std::unique_ptr<ContactPeer> make_fcl_collide(const PosedPair &pair);  // fcl::collide, its own solver; meshes: all contacts
// coal::collide, with or without its contact patch; meshes, which it has no patches for, with all their contacts. Null where the
// program is built without coal.
std::unique_ptr<ContactPeer> make_coal_collide(const PosedPair &pair, bool with_patch);
// How far apart bodies are.
std::unique_ptr<ContactPeer> make_fcl_distance(const PosedPair &pair);   // fcl::distance
std::unique_ptr<ContactPeer> make_coal_distance(const PosedPair &pair);  // coal::distance

}  // namespace cmb::bench
