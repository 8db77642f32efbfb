#include "narrowphase/smooth/direction_newton.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// A quadratic form on the plane of u and v.
struct Form {
  double uu = 0.0, uv = 0.0, vv = 0.0;
};

// The Hessian of a core's support function at the unit direction d, for u and v perpendicular to it, in its frame.
Form core_curvature(const ConvexBody &body, const Vec3 &d, const Vec3 &u, const Vec3 &v) {
  const Vec3 &h = body.half;
  switch (body.core) {
    case CoreShape::ellipsoid: {
      const Vec3 square{h.x * h.x, h.y * h.y, h.z * h.z};
      const Vec3 of_d{square.x * d.x, square.y * d.y, square.z * d.z}, of_u{square.x * u.x, square.y * u.y, square.z * u.z},
          of_v{square.x * v.x, square.y * v.y, square.z * v.z};
      const double length2 = dot(of_d, d), by_length = 1.0 / std::sqrt(length2), by_length2 = 1.0 / length2;
      const double du = dot(of_d, u), dv = dot(of_d, v);
      return {by_length * (dot(of_u, u) - du * du * by_length2), by_length * (dot(of_u, v) - du * dv * by_length2),
              by_length * (dot(of_v, v) - dv * dv * by_length2)};
    }
    case CoreShape::cone:
    case CoreShape::cylinder: {
      const double across2 = d.x * d.x + d.y * d.y, across = std::sqrt(across2);
      if (!(across2 > 0.0) || (body.core == CoreShape::cone && d.z * 2.0 * h.z >= h.x * across)) return {};
      const double by = h.x / (across2 * across), round_u = d.x * u.y - d.y * u.x, round_v = d.x * v.y - d.y * v.x;
      return {by * round_u * round_u, by * round_u * round_v, by * round_v * round_v};
    }
    default: return {};
  }
}

Form curvature(const MinkowskiDifference &difference, const Vec3 &m, const Vec3 &u, const Vec3 &v) {
  Form result = core_curvature(difference.body_a, m, u, v);
  if (!is_polyhedral(difference.body_b.core)) {
    const Mat3 &r = difference.b_in_a.rotation;
    const Form of_b = core_curvature(difference.body_b, -transposed_times(r, m), transposed_times(r, u), transposed_times(r, v));
    result.uu += of_b.uu, result.uv += of_b.uv, result.vv += of_b.vv;
  }
  return result;
}

constexpr double largest_step = 0.2;
constexpr double slope_rounding = 1e-15;  // relative to the bodies
constexpr int most_steps = 24;  // far from the minimum; near it three or four suffice

// The step where the function does not bend upwards in all directions, as along the valley all round bodies of revolution on
// one axis: Newton's in the direction in which it bends most, if that is upwards, else down the slope.
void step_where_flat(const Form &bend, double gu, double gv, double height, double &du, double &dv) {
  const double mean = 0.5 * (bend.uu + bend.vv), half = 0.5 * (bend.uu - bend.vv);
  const double most = mean + std::hypot(half, bend.uv);
  // Along which: of two forms of the eigenvector the longer one.
  double along_u = half >= 0.0 ? most - bend.vv : bend.uv, along_v = half >= 0.0 ? bend.uv : most - bend.uu;
  const double length = std::hypot(along_u, along_v);
  if (length > 0.0) {
    along_u /= length, along_v /= length;
  } else {
    along_u = 1.0, along_v = 0.0;
  }
  const double slope = gu * along_u + gv * along_v, across = gv * along_u - gu * along_v;
  const double step = -slope / (most > 1e-3 * height ? most : height), step_across = -across / height;
  du = step * along_u - step_across * along_v;
  dv = step * along_v + step_across * along_u;
}

double crease_radius(const Crease &crease) { return std::sqrt(std::max(0.0, 1.0 - crease.height * crease.height)); }

}  // namespace

bool newton_on_sphere(const MinkowskiDifference &difference, Vec3 &m, int most_halvings) {
  Vec3 w = difference.support(m).w;
  for (int step = 0; step < most_steps; ++step) {
    const double height = dot(w, m);
    const Vec3 u = any_perpendicular(m), v = cross(m, u);
    const double gu = dot(w, u), gv = dot(w, v);
    const Form bend = curvature(difference, m, u, v);
    const double uu = bend.uu - height, vv = bend.vv - height, uv = bend.uv;
    const double determinant = uu * vv - uv * uv;
    const bool convex = uu > 0.0 && determinant > 1e-14 * uu * vv;
    if (!convex && !(std::fabs(height) > 0.0)) return false;
    double du, dv;
    if (convex) {
      du = (gv * uv - gu * vv) / determinant, dv = (gu * uv - gv * uu) / determinant;
    } else {
      step_where_flat({uu, uv, vv}, gu, gv, std::fabs(height), du, dv);
    }
    const double size = std::sqrt(du * du + dv * dv);
    if (convex && size < 1e-9) {  // the next step would be below rounding
      m = normalized(m + du * u + dv * v);
      return true;
    }
    double factor = size > largest_step ? largest_step / size : 1.0;
    // Near the minimum rounding hides the decrease; Newton's step is then right without it.
    const double slack = size < 1e-5 ? INFINITY : 0.0;
    for (int halving = 0;; ++halving, factor *= 0.5) {
      if (halving == most_halvings) return false;
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

bool project_on_crease(const Crease &crease, Vec3 &m) {
  const Vec3 outward = m - dot(m, crease.axis) * crease.axis;
  if (!(norm2(outward) > 1e-6)) return false;
  m = crease.height * crease.axis + crease_radius(crease) * normalized(outward);
  return true;
}

bool newton_on_crease(const MinkowskiDifference &difference, const Crease &crease, Vec3 &m, bool from_afar) {
  const double radius = crease_radius(crease);
  const auto on_crease = [&](const Vec3 &e) { return crease.height * crease.axis + radius * e; };
  Vec3 e = normalized(m - dot(m, crease.axis) * crease.axis);
  m = on_crease(e);
  Vec3 w = difference.support(m).w;
  for (int step = 0; step < most_steps; ++step) {
    const Vec3 tangent = cross(crease.axis, e);
    const double height = dot(w, m), slope = radius * dot(w, tangent);
    const double bend = radius * radius * curvature(difference, m, tangent, tangent).uu - radius * dot(w, e);
    // Where a corner lies on a cone's axis all of the crease is equally low: a step would end anywhere on it.
    if (std::fabs(slope) <= slope_rounding * difference.scale) return bend > 0.0;
    if (!from_afar && !(bend > 0.0 && std::fabs(slope) < largest_step * bend)) return false;
    // Far from the minimum, which may be on the other side of the crease, down the slope.
    const double newton = bend > 0.0 ? -slope / bend : -std::copysign(largest_step, slope);
    double turn = std::clamp(newton, -largest_step, largest_step);
    if (std::fabs(newton) < 1e-9) {  // the next step would be below rounding
      m = normalized(on_crease(normalized(e + turn * tangent)));
      return true;
    }
    // Near the minimum rounding hides the decrease; Newton's step is then right without it.
    const double slack = !from_afar || std::fabs(turn) < 1e-5 ? INFINITY : 0.0;
    for (int halving = 0;; ++halving, turn *= 0.5) {
      if (halving == 12) return false;
      const Vec3 next = normalized(e + turn * tangent);
      const Vec3 next_m = on_crease(next), next_w = difference.support(next_m).w;
      if (!(dot(next_w, next_m) < height + slack)) continue;
      e = next, m = next_m, w = next_w;
      break;
    }
  }
  return false;
}

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

}  // namespace cmb::convex
