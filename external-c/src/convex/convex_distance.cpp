#include "convex_distance.hpp"

#include <algorithm>

#include "box_axes.hpp"
#include "feature_enumeration.hpp"
#include "gjk.hpp"
#include "minkowski_difference.hpp"

namespace cmb::convex {

namespace {

// Signed distance of the cores; `direction` is unit, from A to B.
struct CoreDistance {
  double distance;
  Vec3 direction, a, b;
  DistanceMethod method;
  bool proven;
};

CoreDistance from_gap(const Vec3 &a, const Vec3 &b, const Vec3 &if_zero, DistanceMethod method) {
  const double distance = norm(b - a);
  return {distance, distance > 0.0 ? (1.0 / distance) * (b - a) : if_zero, a, b, method, true};
}

// Two cores that are points or segments: their difference has no interior.
CoreDistance point_or_segment_pair(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &pose) {
  const Vec3 half_a = body_a.half, half_b = pose.rotation * body_b.half, &t = pose.translation;
  const double aa = norm2(half_a), bb = norm2(half_b), ab = dot(half_a, half_b);
  const double at = dot(half_a, t), bt = dot(half_b, t);
  const double denominator = aa * bb - ab * ab;
  // Minimise |s half_a - t - r half_b| over s, r in [-1, 1].
  double s = 0.0, r = 0.0;
  if (denominator > 1e-14 * aa * bb) {
    s = std::clamp((at * bb - ab * bt) / denominator, -1.0, 1.0);
  } else if (aa > 0.0 && bb > 0.0) {
    // Parallel: the middle of the common stretch.
    const double middle = at / aa, reach = std::fabs(ab) / aa;
    const double low = std::max(-1.0, middle - reach), high = std::min(1.0, middle + reach);
    s = std::clamp(0.5 * (low + high), -1.0, 1.0);
  }
  if (bb > 0.0) {
    r = (s * ab - bt) / bb;
    r = std::clamp(r, -1.0, 1.0);
  }
  if (aa > 0.0) s = std::clamp((at + r * ab) / aa, -1.0, 1.0);
  if (bb > 0.0) r = std::clamp((s * ab - bt) / bb, -1.0, 1.0);
  const Vec3 a = s * half_a, b = t + r * half_b;
  Vec3 across = cross(half_a, half_b);
  if (!(norm2(across) > 1e-24 * aa * bb)) across = any_perpendicular(normalized(aa > bb ? half_a : half_b));
  return from_gap(a, b, normalized(across), DistanceMethod::closed_form);
}

// A point against a box centred at the origin.
CoreDistance box_and_point(const Vec3 &half, const Vec3 &p) {
  Vec3 nearest;
  int shallow = 0;
  double depth = INFINITY;
  bool inside = true;
  for (int k = 0; k < 3; ++k) {
    nearest.set(k, std::clamp(p[k], -half[k], half[k]));
    inside = inside && std::fabs(p[k]) <= half[k];
    if (half[k] - std::fabs(p[k]) < depth) depth = half[k] - std::fabs(p[k]), shallow = k;
  }
  if (!inside) return from_gap(nearest, p, {0, 0, 1}, DistanceMethod::closed_form);
  CoreDistance result{-depth, {}, p, p, DistanceMethod::closed_form, true};
  result.direction.set(shallow, std::copysign(1.0, p[shallow]));
  result.a.set(shallow, std::copysign(half[shallow], p[shallow]));
  return result;
}

CoreDistance exchanged(const CoreDistance &d, const Pose &pose) {
  // Computed in B's frame with the roles exchanged.
  return {d.distance, -(pose.rotation * d.direction), pose(d.b), pose(d.a), d.method, d.proven};
}

bool lies_on_line(CoreShape core) { return core == CoreShape::point || core == CoreShape::segment; }

CoreDistance enumerated(const MinkowskiDifference &difference, DistanceScratch &scratch) {
  ++scratch.counters.brute_force;
  const EnumerationResult r = enumerate_features(difference);
  return {r.distance, r.direction, r.a, r.b, DistanceMethod::brute_force, true};
}

CoreDistance iterated(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &pose, const Vec3 &first,
                      DistanceScratch &scratch) {
  const MinkowskiDifference difference(body_a, body_b, pose);
  const bool polyhedral = is_polyhedral(body_a.core) && is_polyhedral(body_b.core);
  const double tolerance = (polyhedral ? 1e-14 : 1e-11) * difference.scale;
  const GjkResult gjk = gjk_distance(difference, first, tolerance);
  const auto gjk_answer = [&](bool proven) {
    Vec3 a, b;
    for (int k = 0; k < gjk.count; ++k) {
      a = a + gjk.weight[k] * gjk.simplex[k].a;
      b = b + gjk.weight[k] * gjk.simplex[k].b;
    }
    CoreDistance result = from_gap(a, b, {0, 0, 1}, DistanceMethod::gjk);
    result.distance = norm(gjk.closest);
    result.direction = normalized(-gjk.closest);
    result.proven = proven;
    return result;
  };
  if (gjk.status == GjkResult::Status::apart) return gjk_answer(true);
  if (gjk.status == GjkResult::Status::uncertain && gjk.lower > 0.0) {
    if (polyhedral) return enumerated(difference, scratch);
    ++scratch.counters.unproven;
    return gjk_answer(false);
  }
  const PenetrationResult inside =
      scratch.expanding_polytope.depth(difference, gjk.simplex, gjk.count, polyhedral ? tolerance : 1e-9 * difference.scale);
  // A negative depth says that the origin is outside after all.
  if (polyhedral && (!inside.proven || inside.depth < -1e-12 * difference.scale)) return enumerated(difference, scratch);
  if (!inside.proven) ++scratch.counters.unproven;
  return {-inside.depth, inside.direction, inside.a, inside.b, DistanceMethod::expanding_polytope, inside.proven};
}

CoreDistance core_distance(const ConvexBody &a, const ConvexBody &b, const Pose &pose, DistanceScratch &scratch) {
  if (lies_on_line(a.core) && lies_on_line(b.core)) return point_or_segment_pair(a, b, pose);
  if (a.core == CoreShape::box && b.core == CoreShape::point) return box_and_point(a.half, pose.translation);
  if (a.core == CoreShape::point && b.core == CoreShape::box) {
    return exchanged(box_and_point(b.half, pose.inverse().translation), pose);
  }
  Vec3 first = core_center(a) - pose(core_center(b));
  if (a.core == CoreShape::box && b.core == CoreShape::box) {
    const BoxAxes axes = box_axes(a.half, b.half, pose);
    if (axes.separation <= 0.0) {
      return {axes.separation, axes.axis, axes.a, axes.b, DistanceMethod::separating_axes, true};
    }
    first = -axes.axis;
  }
  if (norm2(first) == 0.0) first = {1, 0, 0};
  return iterated(a, b, pose, first, scratch);
}

// Vertex, edge or face of the core that its supporting plane along m (unit, core's frame) touches.
Feature support_feature(const ConvexBody &body, const Vec3 &m) {
  constexpr double parallel = 1e-8;  // sine of the angle up to which a face or edge counts as in the plane
  switch (body.core) {
    case CoreShape::point: return {FeatureKind::vertex, 0};
    case CoreShape::segment:
      if (std::fabs(m.z) <= parallel) return {FeatureKind::edge, 0};
      return {FeatureKind::vertex, m.z < 0.0 ? 0 : 1};
    case CoreShape::box: {
      static const Polytope box = Polytope::box({1, 1, 1});
      return support_feature({CoreShape::polytope, {}, &box, 0.0}, m);
    }
    case CoreShape::polytope: {
      const Polytope &p = *body.polytope;
      const std::int32_t v = p.support_vertex(m);
      Feature result{FeatureKind::vertex, v};
      for (std::int32_t k = p.neighbour_begin(v); k < p.neighbour_begin(v + 1); ++k) {
        const std::int32_t e = p.neighbour_edges()[static_cast<std::size_t>(k)];
        const Polytope::Edge &edge = p.edges()[static_cast<std::size_t>(e)];
        if (std::fabs(dot(edge.direction, m)) > parallel) continue;
        for (std::int32_t f : edge.face) {
          const Vec3 &n = p.faces()[static_cast<std::size_t>(f)].normal;
          if (dot(n, m) > 0.0 && norm2(cross(n, m)) <= parallel * parallel) return {FeatureKind::face, f};
        }
        result = {FeatureKind::edge, e};
      }
      return result;
    }
    default: return {};
  }
}

}  // namespace

SignedDistance signed_distance(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, DistanceScratch &scratch) {
  ++scratch.counters.queries;
  SignedDistance result;
  const Mat3 &r = b_in_a.rotation;
  if (!is_finite(b_in_a.translation) || !is_finite(r.row[0]) || !is_finite(r.row[1]) || !is_finite(r.row[2])) {
    result.proven = false;
    return result;
  }
  const CoreDistance core = core_distance(a, b, b_in_a, scratch);
  result.distance = core.distance - a.radius - b.radius;
  result.normal = -core.direction;
  result.point_a = core.a + a.radius * core.direction;
  result.point_b = core.b - b.radius * core.direction;
  result.feature_a = support_feature(a, core.direction);
  result.feature_b = support_feature(b, -transposed_times(r, core.direction));
  result.method = core.method;
  result.proven = core.proven;
  return result;
}

}  // namespace cmb::convex
