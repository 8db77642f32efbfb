#include "narrowphase/multicontact/difference_cuts.hpp"

#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/curved_distance.hpp"
#include "narrowphase/smooth/direction_refinement.hpp"

namespace cmb::convex {

namespace {

// As far as a way may turn about a place that a ball is near (rad).
constexpr double nearby = 0.6;

}  // namespace

Cut cut_at(const SignedDistance &there, const Vec3 &centre) {
  return {-there.normal, -there.distance - dot(centre, there.normal), there.point_a, there.point_b - centre, 0.0};
}

SignedDistance distance_beside(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const HeldBall &ball,
                               DistanceScratch &scratch) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + ball.centre};
  if (is_polyhedral(a.core) && is_polyhedral(b.core)) return signed_distance(a, b, moved, scratch);
  EquallyNear known;
  for (; known.count < ball.count; ++known.count) known.direction[known.count] = ball.cuts[known.count].direction;
  return swept_distance(curved_distance(a, b, moved, -ball.cuts[0].direction, scratch, &known), a.radius, b.radius);
}

void move_cut(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &from, Cut &cut) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + from};
  const MinkowskiDifference difference(a, b, moved);
  const RefinedDirection r =
      refine_direction(difference, cut.direction, cut.a - a.radius * cut.direction, cut.b + from + b.radius * cut.direction);
  if (!(dot(r.direction, cut.direction) > 1.0 - 0.5 * nearby * nearby)) return;  // another place, as near
  cut.direction = r.direction;
  cut.height = r.height + a.radius + b.radius + dot(from, r.direction);
  cut.a = r.a + a.radius * r.direction;
  cut.b = r.b - b.radius * r.direction - from;
}

}  // namespace cmb::convex
