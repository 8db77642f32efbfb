// What the vertices of a polytope near a contact would carry.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "manifold/polytope/contact_side.hpp"
#include "math/solid_angle.hpp"

namespace cmb {

// Turns the directions in a vertex' normal cone that look towards the other body by `rotation`, whose last row is the
// direction towards it, into `cone`. Returns whether they are the whole of the normal cone.
bool visible_cone(const ContactSide &side, std::int32_t vertex, const convex::Mat3 &rotation, DirectionCone &cone);

// Their solid angle; `cone` is room.
double visible_angle(const ContactSide &side, std::int32_t vertex, DirectionCone &cone);

// What a vertex would carry if its normal cone filled the hemisphere, and how that changes with the direction towards
// the other body as far as that turns with the other body.
struct Stiffness {
  double value = 0.0;
  Vec3 slope;           // in the side's axes
};

// The stiffness of a side's vertices, found where it is asked for.
class VertexStiffness {
 public:
  // For the vertices gathered by `side`, which is borrowed until the next start. The direction towards the other body
  // turns with that one as far as `turning` says (0 to 1).
  void start(const ContactSide &side, double turning);

  // Of the side's vertex k.
  const Stiffness &of(std::int32_t k) {
    const auto at = static_cast<std::size_t>(k);
    if (found_in_[at] != start_) find(k, known_[at]), found_in_[at] = start_;
    return known_[at];
  }

 private:
  void find(std::int32_t k, Stiffness &stiffness);

  const ContactSide *side_ = nullptr;
  double turning_ = 0.0;
  std::vector<Stiffness> known_;
  std::vector<std::uint32_t> found_in_;  // the start after which each was found last
  std::uint32_t start_ = 0;
  DirectionCone cone_;
};

}  // namespace cmb
