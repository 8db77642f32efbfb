#include "narrowphase/smooth/feature_direction.hpp"

#include <algorithm>

#include "narrowphase/smooth/direction_newton.hpp"

namespace cmb::convex {

namespace {

// As far from a border, relative to the body, a point lies on it.
constexpr double on_border = 1e-9;
// A point of a flat end farther from its middle than this part of the radius lies on the rim.
constexpr double on_rim = 0.9;
// Sine of the angle between lines that cross.
constexpr double least_slope = 1e-3;

// So near to a feature's own minimum steps lead upwards where the minimum is on a crease beside it, which shorter ones would not tell.
constexpr int halvings_on_feature = 1;

// What a point of a core's surface lies on.
struct Place {
  enum class Kind { point, line, flat } kind = Kind::point;  // a point where one point alone is the farthest
  Crease crease;  // of a line
  Vec3 normal;    // of a flat end
};

Place on_line(const Vec3 &axis, double height, const Vec3 &line) { return {Place::Kind::line, {axis, height, line}, {}}; }
Place on_flat(const Vec3 &normal) { return {Place::Kind::flat, {}, normal}; }

Place on_box(const Vec3 &half, const Vec3 &p, const Vec3 &d) {
  int free = -1, facing = -1, count = 0;
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(p[k]) >= half[k] * (1.0 - on_border)) {
      ++count;
      facing = k;
    } else {
      free = k;
    }
  }
  if (count == 3) return {};
  Vec3 e;
  if (count == 2) {
    e.set(free, 1.0);
    return on_line(e, 0.0, e);
  }
  for (int k = 0; count == 0 && k < 3; ++k) {
    if (facing < 0 || std::fabs(d[k]) > std::fabs(d[facing])) facing = k;
  }
  e.set(facing, std::copysign(1.0, d[facing]));
  return on_flat(e);
}

Place on_polytope(const Polytope &polytope, const Vec3 &p, const Vec3 &d) {
  const std::int32_t v = polytope.support_vertex(d);
  const Vec3 from = p - polytope.vertices()[static_cast<std::size_t>(v)];
  const double slack = on_border * polytope.radius();
  if (norm2(from) <= slack * slack) return {};
  const Vec3 *facing = nullptr;
  for (std::int32_t k = polytope.neighbour_begin(v); k < polytope.neighbour_begin(v + 1); ++k) {
    const auto number = static_cast<std::size_t>(polytope.neighbour_edges()[static_cast<std::size_t>(k)]);
    const Polytope::Edge &edge = polytope.edges()[number];
    const Vec3 &direction = polytope.edge_directions()[number];
    if (norm2(from - dot(from, direction) * direction) <= slack * slack) return on_line(direction, 0.0, direction);
    for (const std::int32_t f : edge.face) {
      const Vec3 &normal = polytope.faces()[static_cast<std::size_t>(f)].normal;
      if (std::fabs(dot(normal, from)) <= slack && (facing == nullptr || dot(normal, d) > dot(*facing, d))) facing = &normal;
    }
  }
  return facing != nullptr ? on_flat(*facing) : Place{};
}

// Along the line that is farthest in the direction d on a crease.
Vec3 line_along(const ConvexBody &body, const Crease &crease, const Vec3 &d) {
  if (body.core != CoreShape::cone) return crease.line;
  const double across = std::sqrt(d.x * d.x + d.y * d.y), by = across > 0.0 ? body.half.x / across : 0.0;
  return normalized({by * d.x, by * d.y, -2.0 * body.half.z});
}

// `d` is the outward direction; both in the core's frame.
Place place_of(const ConvexBody &body, const Vec3 &p, const Vec3 &d) {
  const Vec3 &h = body.half, z{0, 0, 1};
  const auto on_end = [&](double height) {
    return p.x * p.x + p.y * p.y < on_rim * on_rim * h.x * h.x ? on_flat({0, 0, height}) : Place{};
  };
  switch (body.core) {
    case CoreShape::point:
    case CoreShape::ellipsoid: return {};
    case CoreShape::segment: return std::fabs(p.z) >= h.z * (1.0 - on_border) ? Place{} : on_line(z, 0.0, z);
    case CoreShape::box: return on_box(h, p, d);
    case CoreShape::polytope: return on_polytope(*body.polytope, p, d);
    case CoreShape::cylinder:
      if (std::fabs(p.z) < h.z * (1.0 - on_border)) return on_line(z, 0.0, z);
      return on_end(std::copysign(1.0, p.z));
    case CoreShape::cone: {
      if (p.z >= h.z * (1.0 - on_border)) return {};
      if (p.z <= -h.z * (1.0 - on_border)) return on_end(-1.0);
      return on_line(z, h.x / cone_slant(h), z);
    }
  }
  return {};
}

}  // namespace

bool feature_direction(const MinkowskiDifference &difference, const Vec3 &direction, const Vec3 &a, const Vec3 &b,
                       RefinedDirection &result) {
  using Kind = Place::Kind;
  const Mat3 &r = difference.b_in_a.rotation;
  const Place of_a = place_of(difference.body_a, a, direction);
  Place of_b = place_of(difference.body_b, b, -transposed_times(r, direction));
  if (of_b.kind == Kind::flat) of_b.normal = -(r * of_b.normal);
  const Crease crease_b = of_b.kind == Kind::line ? crease_of_other(of_b.crease, r) : Crease{};
  Vec3 m = direction;
  if (of_a.kind == Kind::flat || of_b.kind == Kind::flat) {
    m = of_a.kind == Kind::flat ? of_a.normal : of_b.normal;
  } else if (of_a.kind == Kind::line && of_b.kind == Kind::line) {
    if (!meeting_point(of_a.crease, crease_b, m)) return false;
  } else if (of_a.kind == Kind::line || of_b.kind == Kind::line) {
    const Crease &crease = of_a.kind == Kind::line ? of_a.crease : crease_b;
    if (!project_on_crease(crease, m) || !newton_on_crease(difference, crease, m)) return false;
  } else if (!newton_on_sphere(difference, m, halvings_on_feature)) {
    return false;
  }
  const DifferencePoint p = difference.support(m);
  result.direction = m;
  result.height = dot(p.w, m);
  const Vec3 along_a = of_a.kind == Kind::line ? line_along(difference.body_a, of_a.crease, m) : Vec3{};
  const Vec3 along_b =
      of_b.kind == Kind::line ? r * line_along(difference.body_b, of_b.crease, -transposed_times(r, m)) : Vec3{};
  if (of_a.kind == Kind::point) {
    result.a = p.a;
  } else if (of_b.kind == Kind::point) {
    result.a = p.b + result.height * m;
  } else if (of_a.kind == Kind::line && of_b.kind == Kind::line) {
    // Where B's line crosses A's, seen along m.
    const Vec3 side = cross(along_b, m);
    const double slope = dot(along_a, side);
    if (!(std::fabs(slope) > least_slope)) return false;
    result.a = p.a + (dot(p.b - p.a, side) / slope) * along_a;
  } else if (of_a.kind == Kind::line) {
    result.a = p.a + dot(a - p.a, along_a) * along_a;
  } else if (of_b.kind == Kind::line) {
    result.a = p.b + dot(a - p.b, along_b) * along_b + result.height * m;
  } else {
    result.a = a + dot(p.a - a, m) * m;
  }
  result.b = result.a - result.height * m;
  return true;
}

}  // namespace cmb::convex
