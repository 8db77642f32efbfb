// What a capsule stores whose axis is near an obstacle, and the points that carry its force and torque.
//
// With the depth s = reach - gap of a place on the axis, the axis stores
//     E = 1/2 (integral of s^3) / (integral of s)
// over the stretch of it where s > 0: d^2 / 2 where it lies d deep along the obstacle, (12/35) d^2 where it crosses a bend that is wide
// beside the depth, d^2 / 4 where an end alone is in contact. Each place pushes along the shortest way to the obstacle, which is the
// gradient of its depth; s^3 and s vanish where a stretch begins or ends, so force and torque are continuous.
#pragma once

#include <algorithm>
#include <vector>

#include "manifold/contact_set.hpp"

namespace cmb {

// Sums over an axis, piece by piece. Places are measured along the axis from one `origin` (world); vectors are in any frame,
// `carry` is told which.
class AxisEnergy {
 public:
  // The stretch from `from` to `to`, where the obstacle's nearest place is off by the gap g(x) = gap + x slope (from it to the
  // axis), whose square is reach^2 + shallow + 2 linear x + curvature x^2. Only what is nearer than the reach counts.
  void add_round(const convex::Vec3 &gap, const convex::Vec3 &slope, double shallow, double linear, double curvature, double reach,
                 double from, double to);
  // The stretch from `from` to `to` over a flat side of outward normal `normal`, of depth `depth` - x `rate`.
  void add_flat(const convex::Vec3 &normal, double depth, double rate, double from, double to);

  // One place of a rule over a stretch that is deep, beside an obstacle of any form: the place at `x`, `depth` deep, is pushed along
  // `direction` (unit); `weight` (m) is the rule's. The stretch is to be told by extend().
  void add_place(double x, double weight, double depth, const convex::Vec3 &direction);
  // Takes it that what is deep reaches from `from` to `to`, or farther.
  void extend(double from, double to) { begin_ = std::min(begin_, from), end_ = std::max(end_, to); }
  // What is deep lies between these places; so does the origin.
  double begin() const { return begin_; }
  double end() const { return end_; }

  // Appends two points that carry the gradient of `part` of the energy and store it, but none deeper than `deepest`; false, and
  // nothing appended, where nothing is stored. The axis runs along `axis` (unit, world), its surface is `radius` away,
  // and `sense` is 1 where the capsule is the first body of the pair, -1 where it is the second one. `frame` maps the
  // vectors above to the world.
  bool carry(const convex::Mat3 &frame, const convex::Vec3 &axis, const convex::Vec3 &origin, double radius, double part,
             double deepest, double sense, std::vector<ContactPoint> &points) const;

 private:
  void integrate_round(const convex::Vec3 &gap, const convex::Vec3 &slope, double shallow, double linear, double curvature,
                       double reach, double from, double to);

  double begin_ = 0.0, end_ = 0.0;
  double sum_ = 0.0, first_ = 0.0, second_ = 0.0, cube_ = 0.0;  // of depth, times x, x^2; of depth^3
  convex::Vec3 one_, one_x_, square_, square_x_;  // of the direction, times x, and of depth^2 times them
};

}  // namespace cmb
