#include "narrowphase/multicontact/ways_out.hpp"

#include <algorithm>

#include "math/fade.hpp"
#include "narrowphase/inner_ball.hpp"
#include "narrowphase/multicontact/cone_ring.hpp"
#include "narrowphase/multicontact/pull_shares.hpp"
#include "narrowphase/multicontact/resting_ball.hpp"
#include "narrowphase/polytope/nearby_surface.hpp"

namespace cmb::convex {

namespace {

// Agreement of the ball's distance from the surface with its radius, relative to the bodies' size. A ball that was farther
// from rest would rest on any two of the places of a surface that is nearly as curved as the ball.
constexpr double tolerance = 1e-12;
// How far a point of a known ball may be outside of its body, relative to the size.
constexpr double on_surface = 1e-10;
// Overlaps less deep, relative to the size, have one way out: what the ball rests on would be lost in rounding.
constexpr double shallow = 1e-7;
// The sums of shares from which on, and at which, the shortest way takes over.
constexpr double squeezed = 4.0, opposed = 8.0;

// The ball that is known to touch the surface at the shortest way out.
double ball_at(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const SignedDistance &nearest, double enough,
               double slack) {
  const Vec3 outward = -nearest.normal;
  const double swept = a.radius + b.radius;
  return swept + inner_ball(a, b, b_in_a, outward, nearest.point_a - a.radius * outward, nearest.point_b + b.radius * outward,
                            enough - swept, slack);
}

WaysOut single(const SignedDistance &nearest) {
  WaysOut result;
  result.count = 1;
  result.way[0] = {nearest.normal, -nearest.distance, nearest.point_a, nearest.point_b, {}, 1.0};
  return result;
}

}  // namespace

WaysOut ways_out(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const SignedDistance &nearest, double size,
                 DistanceScratch &scratch) {
  const double depth = -nearest.distance, radius = surface_reach(depth, size), slack = tolerance * size;
  if (!(depth > shallow * size)) return single(nearest);
  const double known = std::max(nearest.ball, ball_at(a, b, b_in_a, nearest, radius, on_surface * size));
  if (known >= radius) return single(nearest);

  HeldBall ball;
  ball.radius = radius, ball.slack = slack;
  ball.cuts[0] = {-nearest.normal, depth, nearest.point_a, nearest.point_b, 0.0};
  ball.count = 1;
  if (!ball.settle() || !bring_to_rest(a, b, b_in_a, size, ball, scratch)) return single(nearest);
  hold_all_round(a, b, b_in_a, size, ball);
  Cut places[most_places];
  const int count = share_pulls(a, b, b_in_a, size, ball, scratch, places);
  WaysOut result;  // the centre is at least radius - depth > 0 from the origin
  const Vec3 &p = ball.centre;
  const double length = norm(p);
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += places[k].pull / length;
  // Ways that nearly oppose each other would need ever greater shares: the shortest takes over.
  const double left = faded(std::max(0.0, (sum - squeezed) / (opposed - squeezed)));
  if (left < 1.0) {
    result = single(nearest);
    result.way[0].share = 1.0 - left;
  }
  for (int k = 0; k < count; ++k) {
    const Cut &cut = places[k];
    const Vec3 aside = p - dot(p, cut.direction) * cut.direction;
    result.way[result.count++] = {-cut.direction, cut.height, cut.a, cut.b, aside, left * cut.pull / length};
  }
  return result;
}

}  // namespace cmb::convex
