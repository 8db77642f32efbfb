// Two boxes flush on each other: of each a face lies in the contact plane, to rounding.
#pragma once

#include "manifold/polytope/contact_side.hpp"
#include "math/vector3.hpp"

namespace cmb {

// All over what both faces have in common, a convex polygon, the boxes are equally deep in each other. Each of its corners
// has the part of the hemisphere that its exterior angle is of a full turn: the limit of what the depth's graph
// (penetration_profile.hpp) has there as the boxes come to lie flush.
class FlushBoxes {
 public:
  struct Corner {
    double x, y;  // in the contact plane
    double part;  // of the hemisphere
  };

  // Finds the corners of boxes of the given half lengths, whose poses are in the contact's axes: z across the contact plane.
  // What lies where is decided as if B had been perturbed. False, and nothing found, where the boxes are not flush.
  bool find(const Vec3 &half_a, const Pose &a, const Vec3 &half_b, const Pose &b, const Perturbation &perturbation);

  const Corner *begin() const { return corners_; }
  const Corner *end() const { return corners_ + count_; }

 private:
  static constexpr int capacity = 16;  // the corners of both faces, and two crossings on each edge of one
  Corner corners_[capacity];
  int count_ = 0;
};

}  // namespace cmb
