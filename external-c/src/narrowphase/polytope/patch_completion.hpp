// What closes a part of a convex surface round the origin.
#pragma once

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

// A cone from a point of the difference C on the far side to the rim of the part of C's surface that is known; or the same
// bent outwards over a support ring of six more points of C, which reaches farther out.
class PatchCompletion {
 public:
  static constexpr int ring_points = 6;

  // To close the surface outside a ball of `radius` round the origin; `normal` (unit) points to the middle of what is
  // known. Borrows the difference.
  PatchCompletion(const MinkowskiDifference &difference, const Vec3 &normal, double radius);
  // The ball gets smaller.
  void shrink(double radius) { radius2_ = radius * radius; }
  // False where the support ring itself is not beyond the ball.
  bool add_ring();
  void drop_ring() { has_ring_ = false; }
  bool has_ring() const { return has_ring_; }
  // Whether its part at a side of the rim from p to q is outside the ball.
  bool holds(const Vec3 &p, const Vec3 &q) const;
  // How often the triangles at a side lead from each point of the support ring to the next: once all round, the completion is
  // closed.
  void count_steps(const Vec3 &p, const Vec3 &q, int steps[ring_points]) const;

 private:
  bool is_beyond(const Vec3 &p, const Vec3 &q, const Vec3 &r) const;
  int sector(const Vec3 &p) const;

  const MinkowskiDifference &difference_;
  double radius2_;
  Vec3 normal_, far_, across_[2], ring_[ring_points];
  bool has_ring_ = false;
};

}  // namespace cmb::convex
