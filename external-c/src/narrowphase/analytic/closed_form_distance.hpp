// Signed distances of cores in closed form.
#pragma once

#include <algorithm>

#include "narrowphase/convex_distance.hpp"

namespace cmb::convex {

// Signed distance of the cores; `direction` is unit, from A to B.
struct CoreDistance {
  double distance;
  Vec3 direction, a, b;
  DistanceMethod method;
  bool proven;
  double interior_ball = 0.0;  // as SignedDistance's, of the cores
};

// Two segments (points where half lengths are zero) along unit vectors, A's middle being the origin and B's t: where they are
// nearest. Those parallel to 1e-12 rad touch in the middle of their common stretch, where the distance may be that angle
// times the stretch greater than the least.
//
// With c = a x b, the lines are nearest at t . (b x c) / |c|^2 = (t x b) . c / |c|^2 along a. The last form keeps the distance to
// rounding at every angle: an error e of the products moves the place by e / angle along the lines, hence e across them, and
// turns c by e / angle, which moves the place by a part of the gap that the distance feels in second order only. The difference
// of squares 1 - (a . b)^2 would lose the place from 1e-7 rad on.
struct NearestOnSegments {
  double cosine;            // of the angle between them
  double foot_a, foot_b;    // where the other's middle is nearest, along A from its middle and along B from its
  double place_a, place_b;  // where they are nearest
};

inline NearestOnSegments nearest_on_segments(const Vec3 &axis_a, double half_a, const Vec3 &axis_b, double half_b,
                                             const Vec3 &t) {
  // By values, not references as std::clamp, so that no branch is made of it, which would be anyone's guess.
  const auto within = [](double half, double x) { return std::min(std::max(x, -half), half); };
  const double cosine = dot(axis_a, axis_b), foot_a = dot(axis_a, t), foot_b = -dot(axis_b, t);
  const Vec3 across = cross(axis_a, axis_b);
  const double sine2 = norm2(across);
  double a;
  if (sine2 > 1e-24) {
    a = within(half_a, dot(cross(t, axis_b), across) / sine2);
  } else {
    // Parallel: the middle of the common stretch.
    const double reach = std::fabs(cosine) * half_b;
    a = within(half_a, 0.5 * (std::max(-half_a, foot_a - reach) + std::min(half_a, foot_a + reach)));
  }
  const double b = within(half_b, a * cosine + foot_b);
  return {cosine, foot_a, foot_b, within(half_a, b * cosine + foot_a), b};
}

// Their distance.
CoreDistance distance_of_segments(const Vec3 &axis_a, double half_a, const Vec3 &axis_b, double half_b, const Vec3 &t);

// Whether distance_of_point knows a core: box, cylinder, cone.
bool has_point_formula(CoreShape core);

// Of a body's core, A, and a point of its frame, B.
CoreDistance distance_of_point(const ConvexBody &body, const Vec3 &p);

// Of a box's core, by its half lengths, and a point of its frame: the signed distance and the unit direction from the core.
inline double box_to_point(const Vec3 &half, const Vec3 &p, Vec3 &direction) {
  const Vec3 gap{p.x - std::clamp(p.x, -half.x, half.x), p.y - std::clamp(p.y, -half.y, half.y),
                 p.z - std::clamp(p.z, -half.z, half.z)};
  const double gap2 = norm2(gap);
  if (gap2 > 0.0) {
    const double distance = std::sqrt(gap2);
    direction = (1.0 / distance) * gap;
    return distance;
  }
  // Inside, or so near that the gap's square is nothing.
  const Vec3 room{half.x - std::fabs(p.x), half.y - std::fabs(p.y), half.z - std::fabs(p.z)};
  const int shallow = room.x <= room.y && room.x <= room.z ? 0 : room.y <= room.z ? 1 : 2;
  direction = {};
  direction.set(shallow, std::copysign(1.0, p[shallow]));
  return -room[shallow];
}

// An upper bound, exact to rounding near the surface, of how far a point of a core's frame is outside it; infinite for
// polytopes.
double outside(const ConvexBody &body, const Vec3 &p);
// The same; for polytopes how far it is beyond the farthest of the faces' planes, which is less off their edges.
double outside_planes(const ConvexBody &body, const Vec3 &p);

// Whether a core is a point or a segment.
inline bool lies_on_line(CoreShape core) { return core == CoreShape::point || core == CoreShape::segment; }

// That of the bodies, whose cores are swept by spheres.
inline SignedDistance swept_distance(const CoreDistance &core, double radius_a, double radius_b) {
  SignedDistance result;
  result.distance = core.distance - radius_a - radius_b;
  result.normal = -core.direction;
  result.point_a = core.a + radius_a * core.direction;
  result.point_b = core.b - radius_b * core.direction;
  result.method = core.method;
  result.proven = core.proven;
  result.interior_ball = core.interior_ball + radius_a + radius_b;
  return result;
}

}  // namespace cmb::convex
