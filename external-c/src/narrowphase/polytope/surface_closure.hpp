// What closes a part of a convex surface round the origin.
#pragma once

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

// A cone from a point of the difference C on the far side to the rim of the part of C's surface that is known; or the same
// bent outwards over a girdle of six more points of C, which reaches farther out.
class SurfaceClosure {
 public:
  static constexpr int girdle_points = 6;

  // To close the surface outside a ball of `radius` round the origin; `normal` (unit) points to the middle of what is
  // known. Borrows the difference.
  SurfaceClosure(const MinkowskiDifference &difference, const Vec3 &normal, double radius);
  // The ball gets smaller.
  void shrink(double radius) { radius2_ = radius * radius; }
  // False where the girdle itself is not beyond the ball.
  bool put_girdle();
  void leave_girdle() { with_girdle_ = false; }
  bool with_girdle() const { return with_girdle_; }
  // Whether its part at a side of the rim from p to q is outside the ball.
  bool holds(const Vec3 &p, const Vec3 &q) const;
  // How often the triangles at a side lead from each point of the girdle to the next: once all round, the closure is
  // closed.
  void count_steps(const Vec3 &p, const Vec3 &q, int steps[girdle_points]) const;

 private:
  bool is_beyond(const Vec3 &p, const Vec3 &q, const Vec3 &r) const;
  int sector(const Vec3 &p) const;

  const MinkowskiDifference &difference_;
  double radius2_;
  Vec3 normal_, far_, across_[2], girdle_[girdle_points];
  bool with_girdle_ = false;
};

}  // namespace cmb::convex
