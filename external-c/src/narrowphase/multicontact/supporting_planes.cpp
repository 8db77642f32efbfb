#include "narrowphase/multicontact/supporting_planes.hpp"

#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/curved_distance.hpp"
#include "narrowphase/smooth/direction_refinement.hpp"

namespace cmb::convex {

namespace {

// As far as a way may turn about a place that a ball is near (rad).
constexpr double nearby = 0.6;

}  // namespace

SupportingPlane supporting_plane_at(const SignedDistance &there, const Vec3 &centre) {
  return {-there.normal, -there.distance - dot(centre, there.normal), there.point_a, there.point_b - centre, 0.0};
}

SignedDistance distance_from_centre(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const ActiveSet &active,
                                    DistanceScratch &scratch) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + active.centre};
  if (is_polyhedral(a.core) && is_polyhedral(b.core)) return signed_distance(a, b, moved, scratch);
  KnownMinima known;
  for (; known.count < active.count; ++known.count) known.direction[known.count] = active.planes[known.count].direction;
  return swept_distance(curved_distance(a, b, moved, -active.planes[0].direction, scratch, &known), a.radius, b.radius);
}

void update_plane(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &from, SupportingPlane &plane) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + from};
  const MinkowskiDifference difference(a, b, moved);
  const RefinedDirection r =
      refine_direction(difference, plane.direction, plane.a - a.radius * plane.direction,
                       plane.b + from + b.radius * plane.direction);
  if (!(dot(r.direction, plane.direction) > 1.0 - 0.5 * nearby * nearby)) return;  // another place, as near
  plane.direction = r.direction;
  plane.height = r.height + a.radius + b.radius + dot(from, r.direction);
  plane.a = r.a + a.radius * r.direction;
  plane.b = r.b - b.radius * r.direction - from;
}

}  // namespace cmb::convex
