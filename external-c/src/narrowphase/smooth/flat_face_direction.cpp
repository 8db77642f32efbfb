#include "narrowphase/smooth/flat_face_direction.hpp"

#include <algorithm>

namespace cmb::convex {

namespace {

// Sine and cosine up to which a side or an end lies on a flat end.
constexpr double level = 1e-11;

// Greatest coordinate of a core along d (unit).
double reach(const ConvexBody &body, const Vec3 &d) {
  const Vec3 &h = body.half;
  switch (body.core) {
    case CoreShape::box: return h.x * std::fabs(d.x) + h.y * std::fabs(d.y) + h.z * std::fabs(d.z);
    case CoreShape::ellipsoid: return norm({h.x * d.x, h.y * d.y, h.z * d.z});
    case CoreShape::cylinder: return h.x * std::sqrt(d.x * d.x + d.y * d.y) + h.z * std::fabs(d.z);
    case CoreShape::cone: return std::max(h.z * d.z, h.x * std::sqrt(d.x * d.x + d.y * d.y) - h.z * d.z);
    default: return dot(core_support(body, d).point, d);
  }
}

// A flat end: the axis of its outward normal in the core's frame.
struct End {
  int axis;
  double sense;
};

// Of one core, P, the flat end by which the other, Q, is the least deep; `pose` maps Q's frame to P's.
struct Facing {
  double depth = INFINITY;
  End end{2, 1.0};
};

void consider(const ConvexBody &p, const ConvexBody &q, const Pose &pose, Facing &best) {
  const Vec3 middle = pose(core_center(q));
  const auto along = [&](int axis, double sense) {
    const Vec3 inward = -sense * pose.rotation.row[axis];  // in Q's frame
    const double depth = p.half[axis] - sense * pose.translation[axis] + reach(q, inward);
    if (depth < best.depth) best = {depth, {axis, sense}};
  };
  switch (p.core) {
    case CoreShape::box:
      for (int k = 0; k < 3; ++k) along(k, middle[k] < 0.0 ? -1.0 : 1.0);
      break;
    case CoreShape::cylinder: along(2, middle.z < 0.0 ? -1.0 : 1.0); break;
    case CoreShape::cone: along(2, -1.0); break;
    default: break;
  }
}

// Clips the stretch [begin, end] of p + t d to |coordinate| <= half.
void clip(double p, double d, double half, double &begin, double &end) {
  if (d == 0.0) return;
  const double first = (-half - p) / d, last = (half - p) / d;
  begin = std::max(begin, std::min(first, last));
  end = std::min(end, std::max(first, last));
}

// The part of [begin, end] of the line p + t d (in P's frame) that is over P's flat end: its middle, or that of all.
double middle_over(const ConvexBody &body, const End &flat, const Vec3 &p, const Vec3 &d, double begin, double end) {
  double from = begin, to = end;
  if (body.core == CoreShape::box) {
    for (int k = 1; k < 3; ++k) {
      const int across = (flat.axis + k) % 3;
      clip(p[across], d[across], body.half[across], from, to);
    }
  } else {
    const double dd = d.x * d.x + d.y * d.y, pd = p.x * d.x + p.y * d.y, pp = p.x * p.x + p.y * p.y - body.half.x * body.half.x;
    const double discriminant = pd * pd - dd * pp;
    if (dd > 0.0 && discriminant > 0.0) {
      const double half = std::sqrt(discriminant) / dd;
      from = std::max(from, -pd / dd - half), to = std::min(to, -pd / dd + half);
    }
  }
  return from < to ? 0.5 * (from + to) : 0.5 * (begin + end);
}

// A point of Q (in P's frame) that is farthest against the outward normal n of P's flat end (in Q's frame), in the
// middle of those that are over that end.
Vec3 touching_point(const ConvexBody &p, const End &flat, const ConvexBody &q, const Pose &pose, const Vec3 &n) {
  const Vec3 &h = q.half;
  const double across = std::sqrt(n.x * n.x + n.y * n.y);
  const bool round = q.core == CoreShape::cylinder || q.core == CoreShape::cone;
  if (round && across < level && (q.core == CoreShape::cylinder || n.z > 0.0)) {
    // Flat on flat.
    const Vec3 center = pose({0, 0, n.z > 0.0 ? -h.z : h.z});
    if (p.core == CoreShape::box) {
      Vec3 nearest = center;
      for (int k = 1; k < 3; ++k) {
        const int side = (flat.axis + k) % 3;
        nearest.set(side, std::clamp(center[side], -p.half[side], p.half[side]));
      }
      return nearest;
    }
    const double apart = std::sqrt(center.x * center.x + center.y * center.y);
    if (!(apart > 0.0)) return center;
    // From P's middle: what both have in common reaches from apart - radius to P's rim at most.
    const double place = 0.5 * (std::max(apart - h.x, -p.half.x) + std::min(apart + h.x, p.half.x));
    return {center.x * place / apart, center.y * place / apart, center.z};
  }
  if (q.core == CoreShape::box) {
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3, last = (k + 2) % 3;
      if (std::fabs(n[next]) >= level || std::fabs(n[last]) >= level) continue;
      // A face on the round end: its point nearest to the end's middle.
      Vec3 nearest = transposed_times(pose.rotation, Vec3{0, 0, flat.sense * p.half.z} - pose.translation);
      nearest.set(k, -std::copysign(h[k], n[k]));
      nearest.set(next, std::clamp(nearest[next], -h[next], h[next]));
      nearest.set(last, std::clamp(nearest[last], -h[last], h[last]));
      return pose(nearest);
    }
  }
  if (q.core == CoreShape::cylinder && std::fabs(n.z) < level) {
    const Vec3 on_side = pose({-h.x * n.x / across, -h.x * n.y / across, 0.0}), axis = pose.rotation.column(2);
    return on_side + middle_over(p, flat, on_side, axis, -h.z, h.z) * axis;
  }
  if (q.core == CoreShape::segment && std::fabs(n.z) < level) {
    const Vec3 axis = pose.rotation.column(2);
    return pose.translation + middle_over(p, flat, pose.translation, axis, -h.z, h.z) * axis;
  }
  if (q.core == CoreShape::cone) {
    const double slant = cone_slant(h), side = (2.0 * h.z * -n.z - h.x * across) / slant;
    if (std::fabs(side) < level && across > 0.0) {  // on its side
      const Vec3 rim = pose({-h.x * n.x / across, -h.x * n.y / across, -h.z}), ruling = pose({0, 0, h.z}) - rim;
      return rim + middle_over(p, flat, rim, ruling, 0.0, 1.0) * ruling;
    }
  }
  return pose(core_support(q, -n).point);
}

}  // namespace

bool flat_face_direction(const MinkowskiDifference &difference, RefinedDirection &result) {
  const ConvexBody &a = difference.body_a, &b = difference.body_b;
  const Pose &b_in_a = difference.b_in_a;
  Facing of_a, of_b;
  consider(a, b, b_in_a, of_a);
  const Pose a_in_b = b_in_a.inverse();
  consider(b, a, a_in_b, of_b);
  const double depth = std::min(of_a.depth, of_b.depth);
  if (depth == INFINITY) return false;
  result.height = depth;
  if (of_a.depth <= of_b.depth) {
    Vec3 normal;
    normal.set(of_a.end.axis, of_a.end.sense);
    result.direction = normal;
    result.b = touching_point(a, of_a.end, b, b_in_a, of_a.end.sense * b_in_a.rotation.row[of_a.end.axis]);
    result.a = result.b + depth * normal;
    return true;
  }
  const Vec3 normal = of_b.end.sense * b_in_a.rotation.column(of_b.end.axis);  // out of B, in A's frame
  result.direction = -normal;
  result.a = b_in_a(touching_point(b, of_b.end, a, a_in_b, normal));
  result.b = result.a + depth * normal;
  return true;
}

}  // namespace cmb::convex
