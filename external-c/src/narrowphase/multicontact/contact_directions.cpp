#include "narrowphase/multicontact/contact_directions.hpp"

#include <algorithm>

#include "math/smoothstep.hpp"
#include "narrowphase/interior_ball.hpp"
#include "narrowphase/multicontact/cone_ring.hpp"
#include "narrowphase/multicontact/cutting_plane_projection.hpp"
#include "narrowphase/multicontact/multiplier_distribution.hpp"

namespace cmb::convex {

namespace {

// Agreement of the ball's distance from the surface with its radius, relative to the bodies' size. A ball that was farther
// from rest would rest on any two of the places of a surface that is nearly as curved as the ball.
constexpr double tolerance = 1e-12;
// How far a point of a known ball may be outside of its body, relative to the size.
constexpr double on_surface = 1e-10;
// Overlaps less deep, relative to the size, have one contact direction: what the ball rests on would be lost in rounding.
constexpr double shallow = 1e-7;
// The sums of shares from which on, and at which, the minimum translation takes over.
constexpr double squeezed = 4.0, opposed = 8.0;

// The ball that is known to touch the surface at the minimum translation.
double ball_at(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const SignedDistance &nearest, double enough,
               double slack) {
  const Vec3 outward = -nearest.normal;
  const double swept = a.radius + b.radius;
  return swept + interior_ball_radius(a, b, b_in_a, outward, nearest.point_a - a.radius * outward,
                                      nearest.point_b + b.radius * outward,
                                      enough - swept, slack);
}

ContactDirections single(const SignedDistance &nearest) {
  ContactDirections result;
  result.count = 1;
  result.contact[0] = {nearest.normal, -nearest.distance, nearest.point_a, nearest.point_b, {}, 1.0};
  return result;
}

}  // namespace

ContactDirections contact_directions(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a,
                                     const SignedDistance &nearest, double size,
                                     DistanceScratch &scratch) {
  const double depth = -nearest.distance, radius = inner_parallel_radius(depth, size), slack = tolerance * size;
  if (!(depth > shallow * size)) return single(nearest);
  const double known = std::max(nearest.interior_ball, ball_at(a, b, b_in_a, nearest, radius, on_surface * size));
  if (known >= radius) return single(nearest);

  ActiveSet active;
  active.radius = radius, active.slack = slack;
  active.planes[0] = {-nearest.normal, depth, nearest.point_a, nearest.point_b, 0.0};
  active.count = 1;
  if (!active.project_origin() || !cutting_plane_projection(a, b, b_in_a, size, active, scratch)) return single(nearest);
  replace_by_cone_ring(a, b, b_in_a, size, active);
  SupportingPlane places[max_planes];
  const int count = distribute_multipliers(a, b, b_in_a, size, active, scratch, places);
  ContactDirections result;  // the centre is at least radius - depth > 0 from the origin
  const Vec3 &p = active.centre;
  const double length = norm(p);
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += places[k].multiplier / length;
  // Ways that nearly oppose each other would need ever greater shares: the shortest takes over.
  const double left = falling_smoothstep(std::max(0.0, (sum - squeezed) / (opposed - squeezed)));
  if (left < 1.0) {
    result = single(nearest);
    result.contact[0].share = 1.0 - left;
  }
  for (int k = 0; k < count; ++k) {
    const SupportingPlane &plane = places[k];
    const Vec3 aside = p - dot(p, plane.direction) * plane.direction;
    result.contact[result.count++] = {-plane.direction, plane.height, plane.a, plane.b, aside,
                                      left * plane.multiplier / length};
  }
  return result;
}

}  // namespace cmb::convex
