#include "mesh/intersection/triangle_section.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "math/pi.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/intersection/deepest_in_polytope.hpp"
#include "mesh/wedges/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

constexpr int mantle_planes = 16;  // that hold a round side

struct Angle {
  double cosine, sine;
};

const std::array<Angle, mantle_planes> &mantle_angles() {
  static const std::array<Angle, mantle_planes> angles = [] {
    std::array<Angle, mantle_planes> all{};
    for (std::size_t k = 0; k < mantle_planes; ++k) {
      const double angle = 2.0 * 3.14159265358979323846 * static_cast<double>(k) / mantle_planes;
      all[k] = {std::cos(angle), std::sin(angle)};
    }
    return all;
  }();
  return angles;
}

// The point of a plane convex polygon nearest to p.
Vec3 nearest_on_polygon(const Vec3 &p, const std::vector<Vec3> &polygon) {
  Vec3 nearest = polygon[0];
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    const Vec3 candidate = nearest_on_triangle(p, polygon[0], polygon[k], polygon[k + 1]).point;
    if (norm2(p - candidate) < norm2(p - nearest)) nearest = candidate;
  }
  return nearest;
}

// The least value on the segment of (distance from the z axis) + slope * z: a convex function.
double least_on_segment(const Vec3 &p, const Vec3 &q, double slope) {
  const auto value = [&](const Vec3 &x) { return std::hypot(x.x, x.y) + slope * x.z; };
  double least = std::fmin(value(p), value(q));
  const Vec3 d = q - p;
  const double a = d.x * d.x + d.y * d.y, m = -slope * d.z;
  if (!(a > m * m)) return least;
  // Where the derivative vanishes: a s' = m sqrt(a s'^2 + c), s' = s + b / a.
  const double b = p.x * d.x + p.y * d.y, across = p.x * d.y - p.y * d.x, c = across * across / a;
  const double s = m * std::sqrt(c / (a * (a - m * m))) - b / a;
  if (s > 0.0 && s < 1.0) least = std::fmin(least, value(p + s * d));
  return least;
}

// The same over a plane convex polygon: on its border, or where the axis passes through.
double least_on_polygon(const std::vector<Vec3> &polygon, double slope) {
  double least = std::numeric_limits<double>::infinity(), low = least, high = -least;
  bool positive = true, negative = true;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vec3 &p = polygon[k], &q = polygon[k + 1 == polygon.size() ? 0 : k + 1];
    least = std::fmin(least, least_on_segment(p, q, slope));
    const double turn = p.x * q.y - p.y * q.x;
    positive = positive && turn >= 0.0;
    negative = negative && turn <= 0.0;
    low = std::fmin(low, p.z);
    high = std::fmax(high, p.z);
  }
  if (!positive && !negative) return least;
  Vec3 normal;
  for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
    normal = normal + cross(polygon[k] - polygon[0], polygon[k + 1] - polygon[0]);
  }
  // A plane that holds the axis, as good as, has it on the border, too, and its signs tell nothing.
  constexpr double along = 1e-12;
  if (!(std::fabs(normal.z) > along * norm(normal))) return least;
  const double z = dot(normal, polygon[0]) / normal.z;
  return std::fmin(least, slope * std::fmin(high, std::fmax(low, z)));
}

}  // namespace

SectionedBody::SectionedBody(const convex::ConvexBody &body, const Pose &place, std::vector<Vec3> &polygon,
                             std::vector<Vec3> &room)
    : body_(body), place_(place), polygon_(polygon), room_(room) {}

SectionedBody::SectionedBody(const convex::Polytope &polytope, const Pose &place, const std::vector<Vec3> &vertices,
                             const std::vector<Vec3> &normals, std::vector<Vec3> &polygon, std::vector<Vec3> &room)
    : body_(convex::make_polytope(polytope)),
      place_(place),
      vertices_(&vertices),
      normals_(&normals),
      polygon_(polygon),
      room_(room) {}

Vec3 SectionedBody::center() const { return place_(convex::core_center(body_)); }

double SectionedBody::reach(const Vec3 &d) const {
  const Vec3 local = transposed_times(place_.rotation, d);
  return dot(local, convex::core_support(body_, local).point) + body_.radius * norm(d) + dot(d, place_.translation);
}

Bounds SectionedBody::bounds() const {
  if (vertices_ != nullptr) return bounds_of(*vertices_);
  Bounds box;
  for (int k = 0; k < 3; ++k) {
    Vec3 axis;
    axis.set(k, 1.0);
    box.high.set(k, reach(axis));
    box.low.set(k, -reach(-axis));
  }
  return box;
}

double SectionedBody::volume() const {
  const Vec3 &half = body_.half;
  const double disc = pi * half.x * half.x, ball = 4.0 / 3.0 * pi;
  switch (body_.core) {
    case convex::CoreShape::point: return ball * body_.radius * body_.radius * body_.radius;
    case convex::CoreShape::segment: return pi * body_.radius * body_.radius * (2.0 * half.z + 4.0 / 3.0 * body_.radius);
    case convex::CoreShape::ellipsoid: return ball * half.x * half.y * half.z;
    case convex::CoreShape::cylinder: return 2.0 * half.z * disc;
    case convex::CoreShape::cone: return 2.0 / 3.0 * half.z * disc;
    default: break;
  }
  double volume = 0.0;
  const convex::Polytope &body = *body_.polytope;
  for (const convex::Polytope::Face &face : body.faces()) {
    const auto corner = [&](std::int32_t k) { return body.vertices()[static_cast<std::size_t>(body.face_vertices()[static_cast<std::size_t>(face.first + k)])]; };
    for (std::int32_t k = 2; k < face.count; ++k) volume += dot(corner(0), cross(corner(k - 1), corner(k))) / 6.0;
  }
  return volume;
}

TriangleSection SectionedBody::section(const Vec3 (&corner)[3], double enough) const {
  if (vertices_ != nullptr) return polytope_section(corner, enough);
  const Pose to_body = place_.inverse();
  const Vec3 local[3] = {to_body(corner[0]), to_body(corner[1]), to_body(corner[2])};
  TriangleSection result;
  switch (body_.core) {
    case convex::CoreShape::point:
      result = ellipsoid_section(local, {body_.radius, body_.radius, body_.radius});
      break;
    case convex::CoreShape::ellipsoid: result = ellipsoid_section(local, body_.half); break;
    case convex::CoreShape::segment: result = capsule_section(local); break;
    default: result = revolved_section(local, enough); break;
  }
  if (!(result.depth > enough)) return {};
  result.place = place_(result.place);
  return result;
}

TriangleSection SectionedBody::polytope_section(const Vec3 (&corner)[3], double enough) const {
  const convex::Polytope &body = *body_.polytope;
  const auto offset = [&](std::size_t f) {
    return dot((*normals_)[f], (*vertices_)[static_cast<std::size_t>(
                                   body.face_vertices()[static_cast<std::size_t>(body.faces()[f].first)])]);
  };
  for (std::size_t f = 0; f < normals_->size(); ++f) {
    const Vec3 &n = (*normals_)[f];
    if (offset(f) - std::min({dot(n, corner[0]), dot(n, corner[1]), dot(n, corner[2])}) <= enough) return {};
  }
  TriangleSection result;
  result.depth = deepest_in_polytope(corner, *normals_, center(), enough, offset);
  if (!(result.depth > enough)) return {};
  polygon_.assign(corner, corner + 3);
  for (std::size_t f = 0; f < normals_->size(); ++f) {
    clip_polygon(polygon_, -(*normals_)[f], -offset(f), room_);
    if (polygon_.size() < 3) return {};
  }
  result.place = nearest_on_polygon(center(), polygon_);
  return result;
}

// In stretched coordinates the ellipsoid is the unit ball. The depth is that of the nearest place by the slope of its
// distance there; about the middle, which has no slope, the least semi-axis.
TriangleSection SectionedBody::ellipsoid_section(const Vec3 (&corner)[3], const Vec3 &half) const {
  const auto stretched = [&](const Vec3 &p) { return Vec3{p.x / half.x, p.y / half.y, p.z / half.z}; };
  const Vec3 u = nearest_on_triangle({}, stretched(corner[0]), stretched(corner[1]), stretched(corner[2])).point;
  const double length = norm(u);
  if (!(length < 1.0)) return {};
  const double least = std::fmin(half.x, std::fmin(half.y, half.z)), slope = norm(stretched(u));
  const double by_slope = slope > 0.0 ? length * length / slope : 0.0;
  return {(1.0 - length) * (by_slope + (1.0 - length) * least), {u.x * half.x, u.y * half.y, u.z * half.z}};
}

// Cuts what is beyond a round side off, as good as: the places that are left are hardly outside.
void SectionedBody::clip_mantle(double radius, double slope) const {
  for (const Angle &angle : mantle_angles()) {
    if (polygon_.empty()) return;
    clip_polygon(polygon_, {-angle.cosine, -angle.sine, -slope}, -radius, room_);
  }
}

TriangleSection SectionedBody::capsule_section(const Vec3 (&corner)[3]) const {
  const double half = body_.half.z, radius = body_.radius;
  const auto clip_ends = [&](double reach) {
    polygon_.assign(corner, corner + 3);
    clip_polygon(polygon_, {0, 0, 1}, -reach, room_);
    if (!polygon_.empty()) clip_polygon(polygon_, {0, 0, -1}, -reach, room_);
    return polygon_.size() >= 3;
  };
  double depth = clip_ends(half) ? radius - least_on_polygon(polygon_, 0.0) : 0.0;
  for (const double z : {-half, half}) {
    const Vec3 end{0, 0, z};
    depth = std::fmax(depth, radius - norm(nearest_on_triangle(end, corner[0], corner[1], corner[2]).point - end));
  }
  clip_ends(half + radius);
  if (!(depth > 0.0) || polygon_.size() < 3) return {};
  clip_mantle(radius, 0.0);
  if (polygon_.size() < 3) return {};
  return {depth, nearest_on_polygon(convex::core_center(body_), polygon_)};
}

// A cylinder or cone: how deep the triangle's deepest place is below all sides. Deepest below the mantle, and below an end, are often other
// places, where the body's border is across an edge of the mesh.
TriangleSection SectionedBody::revolved_section(const Vec3 (&corner)[3], double enough) const {
  const bool cone = body_.core == convex::CoreShape::cone;
  const double half = body_.half.z, slope = cone ? 0.5 * body_.half.x / half : 0.0, radius = cone ? slope * half : body_.half.x;
  const double scale = 1.0 / std::hypot(1.0, slope);
  // What is that deep below the ends; what bounds a cone above is its mantle.
  const auto clip_ends = [&](double deep) {
    polygon_.assign(corner, corner + 3);
    clip_polygon(polygon_, {0, 0, 1}, deep - half, room_);
    if (!cone && !polygon_.empty()) clip_polygon(polygon_, {0, 0, -1}, deep - half, room_);
    return polygon_.size() >= 3;
  };
  // By how much the deepest of these below the mantle is deeper than they are below the ends: concave, and falls.
  const auto deeper = [&](double deep) {
    return clip_ends(deep) ? scale * (radius - least_on_polygon(polygon_, slope)) - deep : -std::numeric_limits<double>::infinity();
  };
  double low = enough, above_low = deeper(low);
  if (!(above_low > 0.0)) return {};
  double high = enough + above_low, below_high = deeper(high);
  constexpr int most_steps = 60;
  constexpr double rounding = 1e-14;
  for (int step = 0; step < most_steps && below_high < 0.0 && high - low > rounding * body_.half.x; ++step) {
    // Of a concave function the chord's zero is never beyond its own.
    const double chord = low + above_low / (above_low - below_high) * (high - low);
    const double next = step % 3 == 2 || !(chord > low) ? 0.5 * (low + high) : chord, above = deeper(next);
    if (above > 0.0) {
      low = next, above_low = above;
    } else {
      high = next, below_high = above;
    }
  }
  const double depth = below_high < 0.0 ? low : high;
  clip_ends(0.0);
  clip_mantle(radius, slope);
  if (polygon_.size() < 3) return {};
  return {depth, nearest_on_polygon(convex::core_center(body_), polygon_)};
}

}  // namespace cmb::mesh
