// Convex bodies: a core shape, swept by a sphere of given radius.
#pragma once

#include "math/vector3.hpp"
#include "shape/polytope.hpp"

namespace cmb::convex {

enum class CoreShape { point, segment, box, polytope, ellipsoid, cylinder, cone };

// A convex body in its own frame. `polytope` is borrowed (never null for CoreShape::polytope, must
// outlive the body) and null otherwise. Lengths in metres, all finite; use the functions below.
struct ConvexBody {
  CoreShape core = CoreShape::point;
  Vec3 half;  // segment: {0, 0, half length}; box: half lengths; ellipsoid: semi-axes;
              // cylinder, cone: {radius, radius, half length}
  const Polytope *polytope = nullptr;
  double radius = 0.0;  // of the sweeping sphere, >= 0
};

inline ConvexBody make_sphere(double radius) { return {CoreShape::point, {}, nullptr, radius}; }
// Axis z; `length` is that of the segment.
inline ConvexBody make_capsule(double radius, double length) {
  return {CoreShape::segment, {0, 0, 0.5 * length}, nullptr, radius};
}
// Full lengths; `radius` rounds the box outwards.
inline ConvexBody make_box(const Vec3 &size, double radius = 0.0) {
  return {CoreShape::box, 0.5 * size, nullptr, radius};
}
inline ConvexBody make_polytope(const Polytope &polytope, double radius = 0.0) {
  return {CoreShape::polytope, {}, &polytope, radius};
}
inline ConvexBody make_ellipsoid(const Vec3 &semi_axes, double radius = 0.0) {
  return {CoreShape::ellipsoid, semi_axes, nullptr, radius};
}
// Axis z, centred, full length.
inline ConvexBody make_cylinder(double radius, double length, double rounding = 0.0) {
  return {CoreShape::cylinder, {radius, radius, 0.5 * length}, nullptr, rounding};
}
// Axis z, base of the given radius at z = -length/2, apex at z = +length/2.
inline ConvexBody make_cone(double radius, double length, double rounding = 0.0) {
  return {CoreShape::cone, {radius, radius, 0.5 * length}, nullptr, rounding};
}

// Whether the core has corners only: point, segment, box or polytope.
inline bool is_polyhedral(CoreShape core) {
  return core == CoreShape::point || core == CoreShape::segment || core == CoreShape::box ||
         core == CoreShape::polytope;
}

// The length of a cone's rulings, by its half lengths.
inline double cone_slant(const Vec3 &half) { return std::sqrt(half.x * half.x + 4.0 * half.z * half.z); }

// Radius of the core's smallest sphere about the origin of its frame.
inline double core_radius(const ConvexBody &body) {
  switch (body.core) {
    case CoreShape::point: return 0.0;
    case CoreShape::polytope: return body.polytope->radius();
    case CoreShape::ellipsoid: return std::fmax(body.half.x, std::fmax(body.half.y, body.half.z));
    case CoreShape::cylinder:
    case CoreShape::cone: return std::sqrt(body.half.x * body.half.x + body.half.z * body.half.z);
    default: return norm(body.half);
  }
}

// A point inside the core.
inline Vec3 core_center(const ConvexBody &body) {
  if (body.core == CoreShape::polytope) return body.polytope->center();
  if (body.core == CoreShape::cone) return {0, 0, -0.5 * body.half.z};
  return {};
}

// A point of the core's surface and, for polyhedral cores, the number of that vertex.
struct SupportPoint {
  Vec3 point;
  std::int32_t vertex = -1;
};

// The core's farthest point along d (finite, need not be unit).
inline SupportPoint core_support(const ConvexBody &body, const Vec3 &d) {
  const Vec3 &h = body.half;
  switch (body.core) {
    case CoreShape::point: return {{}, 0};
    case CoreShape::segment: return d.z < 0.0 ? SupportPoint{{0, 0, -h.z}, 0} : SupportPoint{{0, 0, h.z}, 1};
    case CoreShape::box: {
      const int bits = (d.x < 0.0 ? 0 : 1) | (d.y < 0.0 ? 0 : 2) | (d.z < 0.0 ? 0 : 4);
      // Without a branch; -0 counts as 0.
      return {{std::copysign(h.x, d.x + 0.0), std::copysign(h.y, d.y + 0.0), std::copysign(h.z, d.z + 0.0)}, bits};
    }
    case CoreShape::polytope: {
      const std::int32_t vertex = body.polytope->support_vertex(d);
      return {body.polytope->vertices()[static_cast<std::size_t>(vertex)], vertex};
    }
    case CoreShape::ellipsoid: {
      const Vec3 scaled{h.x * d.x, h.y * d.y, h.z * d.z};
      const double length = norm(scaled);
      if (!(length > 0.0)) return {{h.x, 0, 0}, -1};
      return {{h.x * scaled.x / length, h.y * scaled.y / length, h.z * scaled.z / length}, -1};
    }
    case CoreShape::cylinder: {
      const double across = std::sqrt(d.x * d.x + d.y * d.y);
      const double scale = across > 0.0 ? h.x / across : 0.0;
      return {{scale * d.x, scale * d.y, d.z < 0.0 ? -h.z : h.z}, -1};
    }
    case CoreShape::cone: {
      const double across = std::sqrt(d.x * d.x + d.y * d.y);
      if (d.z * 2.0 * h.z >= h.x * across) return {{0, 0, h.z}, -1};
      const double scale = across > 0.0 ? h.x / across : 0.0;
      return {{scale * d.x, scale * d.y, -h.z}, -1};
    }
  }
  return {};
}

// The same of the whole body, along a direction that is not zero.
inline Vec3 swept_support(const ConvexBody &body, const Vec3 &d) {
  const Vec3 on_core = core_support(body, d).point;
  return body.radius > 0.0 ? on_core + (body.radius / norm(d)) * d : on_core;
}

}  // namespace cmb::convex
