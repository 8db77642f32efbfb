#include "direction_refinement.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// A circle m . axis = height of directions m across which a body's farthest point jumps: for m on it
// all of a line segment along `line` is farthest.
struct Crease {
  Vec3 axis;
  double height;
  Vec3 line;
};

// The creases and flat ends of a body near a direction, in A's frame.
struct Creases {
  static constexpr int capacity = 6;
  Crease crease[capacity];
  int count = 0;
  Vec3 flat[2];  // directions whose farthest points are a flat disc
  int flat_count = 0;

  void add(const Crease &c) {
    if (count < capacity) crease[count++] = c;
  }
};

// Of the core itself; `d` unit in its frame.
Creases core_creases(const ConvexBody &body, const Vec3 &d, double angle) {
  Creases result;
  const Vec3 z{0, 0, 1};
  const double across = std::sqrt(d.x * d.x + d.y * d.y);
  switch (body.core) {
    case CoreShape::point:
    case CoreShape::ellipsoid: break;
    case CoreShape::segment:
      if (std::fabs(d.z) < angle) result.add({z, 0.0, z});
      break;
    case CoreShape::box:
      for (int k = 0; k < 3; ++k) {
        Vec3 e;
        e.set(k, 1.0);
        if (std::fabs(d[k]) < angle) result.add({e, 0.0, e});
      }
      break;
    case CoreShape::polytope: {
      const Polytope &p = *body.polytope;
      const std::int32_t v = p.support_vertex(d);
      for (std::int32_t k = p.neighbour_begin(v); k < p.neighbour_begin(v + 1); ++k) {
        const Vec3 &e = p.edges()[static_cast<std::size_t>(p.neighbour_edges()[static_cast<std::size_t>(k)])].direction;
        if (std::fabs(dot(d, e)) < angle) result.add({e, 0.0, e});
      }
      break;
    }
    case CoreShape::cylinder:
      if (std::fabs(d.z) < angle) result.add({z, 0.0, z});
      if (across < angle) result.flat[result.flat_count++] = {0, 0, std::copysign(1.0, d.z)};
      break;
    case CoreShape::cone: {
      const double slant = std::hypot(body.half.x, 2.0 * body.half.z);
      const double height = body.half.x / slant;  // of the side's normals
      if (std::fabs(d.z - height) < angle && across > 0.0) {
        const Vec3 ruling{body.half.x * d.x / across, body.half.x * d.y / across, -2.0 * body.half.z};
        result.add({z, height, (1.0 / slant) * ruling});
      }
      if (across < angle && d.z < 0.0) result.flat[result.flat_count++] = {0, 0, -1};
      break;
    }
  }
  return result;
}

Creases creases_of_a(const MinkowskiDifference &difference, const Vec3 &m, double angle) {
  return core_creases(difference.body_a, m, angle);
}

Creases creases_of_b(const MinkowskiDifference &difference, const Vec3 &m, double angle) {
  const Mat3 &r = difference.b_in_a.rotation;
  Creases result = core_creases(difference.body_b, -transposed_times(r, m), angle);
  for (int k = 0; k < result.count; ++k) {
    Crease &c = result.crease[k];
    c = {r * c.axis, -c.height, r * c.line};
  }
  for (int k = 0; k < result.flat_count; ++k) result.flat[k] = -(r * result.flat[k]);
  return result;
}

// s . H t for the Hessian H of the core's support function at the unit direction d (its frame).
double core_curvature(const ConvexBody &body, const Vec3 &d, const Vec3 &s, const Vec3 &t) {
  const Vec3 &h = body.half;
  switch (body.core) {
    case CoreShape::ellipsoid: {
      const Vec3 hd{h.x * h.x * d.x, h.y * h.y * d.y, h.z * h.z * d.z};
      const double length = std::sqrt(dot(hd, d));
      const double st = h.x * h.x * s.x * t.x + h.y * h.y * s.y * t.y + h.z * h.z * s.z * t.z;
      return (st - dot(hd, s) * dot(hd, t) / (length * length)) / length;
    }
    case CoreShape::cone:
      if (core_support(body, d).point.z > 0.0) return 0.0;
      [[fallthrough]];
    case CoreShape::cylinder: {
      const double across2 = d.x * d.x + d.y * d.y;
      if (!(across2 > 0.0)) return 0.0;
      const Vec3 round{-d.y, d.x, 0.0};
      return h.x * dot(round, s) * dot(round, t) / (across2 * std::sqrt(across2));
    }
    default: return 0.0;
  }
}

double curvature(const MinkowskiDifference &difference, const Vec3 &m, const Vec3 &s, const Vec3 &t) {
  const Mat3 &r = difference.b_in_a.rotation;
  return core_curvature(difference.body_a, m, s, t) +
         core_curvature(difference.body_b, -transposed_times(r, m), transposed_times(r, s), transposed_times(r, t));
}

constexpr double largest_step = 0.2;
constexpr int most_steps = 24;  // far from the minimum; near it three or four suffice

// Newton's method on the sphere, with shortened steps while far from a minimum; false where it ends
// elsewhere.
bool newton_on_sphere(const MinkowskiDifference &difference, Vec3 &m) {
  Vec3 w = difference.support(m).w;
  for (int step = 0; step < most_steps; ++step) {
    const double height = dot(w, m);
    const Vec3 u = any_perpendicular(m), v = cross(m, u);
    const double gu = dot(w, u), gv = dot(w, v);
    const double uu = curvature(difference, m, u, u) - height, vv = curvature(difference, m, v, v) - height,
                 uv = curvature(difference, m, u, v);
    const double determinant = uu * vv - uv * uv;
    const bool convex = uu > 0.0 && determinant > 1e-14 * uu * vv;
    if (!convex && !(std::fabs(height) > 0.0)) return false;
    double du = convex ? (gv * uv - gu * vv) / determinant : -gu / std::fabs(height);
    double dv = convex ? (gu * uv - gv * uu) / determinant : -gv / std::fabs(height);
    const double size = std::sqrt(du * du + dv * dv);
    if (convex && size < 1e-9) {  // the next step would be below rounding
      m = normalized(m + du * u + dv * v);
      return true;
    }
    double factor = size > largest_step ? largest_step / size : 1.0;
    // Near the minimum rounding hides the decrease; Newton's step is then right without it.
    const double slack = size < 1e-5 ? INFINITY : 0.0;
    for (int halving = 0;; ++halving, factor *= 0.5) {
      if (halving == 12) return false;
      const Vec3 next = normalized(m + (factor * du) * u + (factor * dv) * v);
      const Vec3 next_w = difference.support(next).w;
      if (!(dot(next_w, next) < height + slack)) continue;
      m = next;
      w = next_w;
      break;
    }
  }
  return false;
}

double crease_radius(const Crease &crease) { return std::sqrt(std::max(0.0, 1.0 - crease.height * crease.height)); }

// Moves m to the crease's nearest point; false where all are equally near.
bool project_on_crease(const Crease &crease, Vec3 &m) {
  const Vec3 outward = m - dot(m, crease.axis) * crease.axis;
  if (!(norm2(outward) > 1e-6)) return false;
  m = crease.height * crease.axis + crease_radius(crease) * normalized(outward);
  return true;
}

// Newton's method along a crease, from a point m on it.
bool newton_on_crease(const MinkowskiDifference &difference, const Crease &crease, Vec3 &m) {
  const double radius = crease_radius(crease);
  Vec3 e = normalized(m - dot(m, crease.axis) * crease.axis);
  for (int step = 0; step < most_steps; ++step) {
    m = crease.height * crease.axis + radius * e;
    const Vec3 tangent = cross(crease.axis, e);
    const Vec3 w = difference.support(m).w;
    const double slope = radius * dot(w, tangent);
    const double bend = radius * radius * curvature(difference, m, tangent, tangent) - radius * dot(w, e);
    if (!(bend > 0.0)) return false;
    const double turn = -slope / bend;
    if (!(std::fabs(turn) < largest_step)) return false;
    e = normalized(e + turn * tangent);
    if (std::fabs(turn) < 1e-9) {
      m = normalized(crease.height * crease.axis + radius * e);
      return true;
    }
  }
  return false;
}

// Where two creases meet, on the side of m.
bool meeting_point(const Crease &p, const Crease &q, Vec3 &m) {
  const double cosine = dot(p.axis, q.axis), sine2 = 1.0 - cosine * cosine;
  if (!(sine2 > 1e-12)) return false;
  const double s = (p.height - cosine * q.height) / sine2, t = (q.height - cosine * p.height) / sine2;
  const Vec3 in_plane = s * p.axis + t * q.axis;
  const double rest = 1.0 - norm2(in_plane);
  if (!(rest > 0.0)) return false;
  Vec3 across;
  if (!common_perpendicular(p.axis, q.axis, across)) return false;
  if (dot(across, m) < 0.0) across = -across;
  m = normalized(in_plane + std::sqrt(rest) * across);
  return true;
}

// Witness points for the final direction.
void find_witness(const MinkowskiDifference &difference, RefinedDirection &result, const Vec3 &a_before) {
  constexpr double angle = 1e-7;
  const Vec3 &m = result.direction;
  const DifferencePoint p = difference.support(m);
  const Creases ca = creases_of_a(difference, m, angle), cb = creases_of_b(difference, m, angle);
  if (ca.count == 0 && ca.flat_count == 0) {
    result.a = p.a;  // A has one farthest point
  } else if (cb.count == 0 && cb.flat_count == 0) {
    result.a = p.b + result.height * m;
  } else {
    const bool line_a = ca.count == 1 && ca.flat_count == 0, line_b = cb.count == 1 && cb.flat_count == 0;
    const Vec3 &along_a = ca.crease[0].line, &along_b = cb.crease[0].line;
    const Vec3 side = cross(along_b, m);
    const double slope = dot(along_a, side);
    if (line_a && line_b && std::fabs(slope) > 1e-3) {
      result.a = p.a + (dot(p.b - p.a, side) / slope) * along_a;  // where B's line crosses A's, seen along m
    } else if (line_a) {
      result.a = p.a + dot(a_before - p.a, along_a) * along_a;
    } else if (line_b) {
      result.a = p.b + dot(a_before - p.b, along_b) * along_b + result.height * m;
    } else {
      result.a = a_before + (dot(p.a, m) - dot(a_before, m)) * m;
    }
  }
  result.b = result.a - result.height * m;
}

}  // namespace

RefinedDirection refine_direction(const MinkowskiDifference &difference, const Vec3 &direction, const Vec3 &a,
                                  const Vec3 &b, double nearby) {
  RefinedDirection result{direction, dot(difference.support(direction).w, direction), a, b};
  // A candidate that is as low to rounding replaces one found by less exact means.
  const double rounding = 1e-15 * difference.scale;
  const auto attempt = [&](const Vec3 &m) {
    const double height = dot(difference.support(m).w, m);
    if (height > result.height + rounding) return;
    result.height = std::min(result.height, height);
    result.direction = m;
  };
  Creases all = creases_of_a(difference, direction, nearby);
  const Creases of_b = creases_of_b(difference, direction, nearby);
  const Vec3 start = direction;
  for (int k = 0; k < all.flat_count; ++k) attempt(all.flat[k]);
  for (int k = 0; k < of_b.flat_count; ++k) attempt(of_b.flat[k]);
  for (int k = 0; k < of_b.count; ++k) all.add(of_b.crease[k]);
  Vec3 m = start;
  if (newton_on_sphere(difference, m)) attempt(m);
  for (int k = 0; k < all.count; ++k) {
    // All of a crease is equally low where both bodies are of revolution about its axis.
    m = start;
    if (!project_on_crease(all.crease[k], m)) continue;
    attempt(m);
    if (newton_on_crease(difference, all.crease[k], m)) attempt(m);
  }
  for (int k = 0; k < all.count; ++k) {
    for (int l = k + 1; l < all.count; ++l) {
      m = start;
      if (meeting_point(all.crease[k], all.crease[l], m)) attempt(m);
    }
  }
  result.height = dot(difference.support(result.direction).w, result.direction);
  find_witness(difference, result, a);
  return result;
}

}  // namespace cmb::convex
