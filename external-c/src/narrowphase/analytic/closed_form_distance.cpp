#include "narrowphase/analytic/closed_form_distance.hpp"

#include <algorithm>

#include "math/index.hpp"
#include "shape/face_clusters.hpp"

namespace cmb::convex {

namespace {

CoreDistance from_gap(const Vec3 &a, const Vec3 &b, const Vec3 &if_zero) {
  const double distance = norm(b - a);
  return {distance, distance > 0.0 ? (1.0 / distance) * (b - a) : if_zero, a, b, DistanceMethod::closed_form, true};
}

}  // namespace

CoreDistance distance_of_segments(const Vec3 &axis_a, double half_a, const Vec3 &axis_b, double half_b, const Vec3 &t) {
  const NearestOnSegments nearest = nearest_on_segments(axis_a, half_a, axis_b, half_b, t);
  const Vec3 a = nearest.place_a * axis_a, b = t + nearest.place_b * axis_b, gap = b - a;
  const double distance = norm(gap);
  if (distance > 0.0) return {distance, (1.0 / distance) * gap, a, b, DistanceMethod::closed_form, true};
  Vec3 across = cross(axis_a, axis_b);
  if (!(std::min(half_a, half_b) > 0.0) || !(norm2(across) > 1e-24)) {
    across = any_perpendicular(half_a > half_b ? axis_a : axis_b);
  }
  return {0.0, normalized(across), a, b, DistanceMethod::closed_form, true};
}

namespace {

// A point against a box centred at the origin.
CoreDistance box_and_point(const Vec3 &half, const Vec3 &p) {
  Vec3 direction;
  const double distance = box_to_point(half, p, direction);
  const Vec3 nearest{std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y),
                     std::clamp(p.z, -half.z, half.z)};
  return {distance, direction, distance > 0.0 ? nearest : p - distance * direction, p, DistanceMethod::closed_form, true};
}

// A point against a cylinder or cone: in the half plane of the point and the axis, the body is a
// rectangle or a triangle.
CoreDistance revolved_and_point(const ConvexBody &body, const Vec3 &p) {
  const double across = std::sqrt(p.x * p.x + p.y * p.y);
  const Vec3 outward = across > 0.0 ? Vec3{p.x / across, p.y / across, 0.0} : Vec3{1, 0, 0};
  const double r = body.half.x, h = body.half.z;
  // Profile from the base's rim to the top: a straight line; then the top's disc and the base's.
  struct Line {
    double x0, z0, x1, z1;
  };
  const double top = body.core == CoreShape::cone ? 0.0 : r;
  const Line lines[3] = {{r, -h, top, h}, {top, h, 0.0, h}, {0.0, -h, r, -h}};
  double deepest = -INFINITY, nearest2 = INFINITY;
  Vec3 inside_normal, foot_inside, foot_outside;
  bool over_face = false;
  for (const Line &line : lines) {
    const double dx = line.x1 - line.x0, dz = line.z1 - line.z0, length2 = dx * dx + dz * dz;
    if (!(length2 > 0.0)) continue;  // a cone has no top disc
    const double length = std::sqrt(length2), nx = dz / length, nz = -dx / length;
    const double height = nx * (across - line.x0) + nz * (p.z - line.z0);
    if (height > deepest) {
      deepest = height;
      inside_normal = nx * outward + Vec3{0, 0, nz};
      foot_inside = p - height * inside_normal;
    }
    const double t = std::clamp(((across - line.x0) * dx + (p.z - line.z0) * dz) / length2, 0.0, 1.0);
    const double x = line.x0 + t * dx, z = line.z0 + t * dz;
    const double distance2 = (across - x) * (across - x) + (p.z - z) * (p.z - z);
    if (distance2 < nearest2) {
      nearest2 = distance2;
      foot_outside = x * outward + Vec3{0, 0, z};
      over_face = t > 0.0 && t < 1.0;
    }
  }
  // Over a face the distance is the height, and the direction known better than from the gap.
  if (deepest > 0.0 && !over_face) return from_gap(foot_outside, p, inside_normal);
  return {deepest, inside_normal, foot_inside, p, DistanceMethod::closed_form, true};
}

}  // namespace

bool has_point_formula(CoreShape core) {
  return core == CoreShape::box || core == CoreShape::cylinder || core == CoreShape::cone;
}

CoreDistance distance_of_point(const ConvexBody &body, const Vec3 &p) {
  return body.core == CoreShape::box ? box_and_point(body.half, p) : revolved_and_point(body, p);
}

double outside(const ConvexBody &body, const Vec3 &p) {
  const Vec3 &h = body.half;
  switch (body.core) {
    case CoreShape::point: return norm(p);
    case CoreShape::segment: return norm(p - Vec3{0, 0, std::clamp(p.z, -h.z, h.z)});
    case CoreShape::ellipsoid: {
      // Shrunk to the surface, the point moves by this.
      const double over = norm(Vec3{p.x / h.x, p.y / h.y, p.z / h.z});
      return over > 1.0 ? norm(p) * (1.0 - 1.0 / over) : 0.0;
    }
    case CoreShape::polytope: return INFINITY;
    default: return std::max(0.0, distance_of_point(body, p).distance);
  }
}

double outside_planes(const ConvexBody &body, const Vec3 &p) {
  if (body.core != CoreShape::polytope) return outside(body, p);
  double result = 0.0;
  body.polytope->clusters().visit_near(p, 0.0, [&](std::int32_t f) {
    const Polytope::Face &face = body.polytope->faces()[index(f)];
    result = std::max(result, dot(face.normal, p) - face.offset);
    return true;
  });
  return result;
}

}  // namespace cmb::convex
