// Faces of boxes and polytopes whose constraints are nearly active in the projection onto an inner parallel body.
#pragma once

#include "narrowphase/multicontact/active_set.hpp"
#include "shape/convex_body.hpp"

namespace cmb::convex {

// Whether two directions (unit) are those of one place, found in two ways: they differ by less than 1e-8.
inline bool same_place(const Vec3 &a, const Vec3 &b) { return norm2(a - b) < 1e-16; }

// The supporting planes of C along the faces of a box or polytope whose partner is curved. They stay what they are while the
// ball moves, and are known without a search.
class NearActiveFaces {
 public:
  static constexpr int most = 16;

  // Those that are less than `within` (m) beyond the ball; of more than `most` the nearest.
  NearActiveFaces(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const ActiveSet &active, double within);

  int count() const { return count_; }
  // The plane, with the points opposite each other where the ball is the nearest to it.
  const SupportingPlane &plane(int k) const { return planes_[k]; }
  // How nearly the ball touches it: 1 where it does, 0 from `within` on, and where the ball's foot is as far beside the face,
  // or the curved body touches it with more than a point.
  double part(int k) const { return parts_[k]; }

  // Which of them is perpendicular to `direction`; count() where none is.
  int find(const Vec3 &direction) const {
    int k = 0;
    while (k < count_ && !same_place(planes_[k].direction, direction)) ++k;
    return k;
  }

 private:
  int count_ = 0;
  SupportingPlane planes_[most];
  double gaps_[most], parts_[most];
};

}  // namespace cmb::convex
