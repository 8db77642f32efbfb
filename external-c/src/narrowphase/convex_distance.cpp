#include "narrowphase/convex_distance.hpp"

#include <algorithm>

#include "narrowphase/analytic/box_distance.hpp"
#include "narrowphase/analytic/box_separating_axes.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"
#include "narrowphase/gjk.hpp"
#include "narrowphase/interior_ball.hpp"
#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/polytope/feature_enumeration.hpp"
#include "narrowphase/smooth/curved_distance.hpp"
#include "narrowphase/smooth/feature_direction.hpp"

namespace cmb::convex {

namespace {

CoreDistance exchanged(const CoreDistance &d, const Pose &pose) {
  // Computed in B's frame with the roles exchanged.
  return {d.distance, -(pose.rotation * d.direction), pose(d.b), pose(d.a), d.method, d.proven};
}

// How far the witness points of an overlap are from lying opposite each other.
double witness_error(const CoreDistance &d) { return norm(d.a - d.b + d.distance * d.direction); }

// Where nearly parallel faces left the witness points of an overlap off the mark: B moved along the
// direction until it is clear of A by a small gap has its nearest points over the same places.
CoreDistance with_better_witness(const MinkowskiDifference &difference, const CoreDistance &rough) {
  const double gap = 1e-6 * difference.scale;  // small: a distance proven to e leaves sqrt(2 gap e) sideways
  const Vec3 shift = (gap - rough.distance) * rough.direction;
  const Pose clear{difference.b_in_a.rotation, difference.b_in_a.translation + shift};
  const MinkowskiDifference apart(difference.body_a, difference.body_b, clear);
  const GjkResult gjk = gjk_distance(apart, -rough.direction, 1e-14 * apart.scale);
  CoreDistance better = rough;
  better.a = better.b = {};
  for (int k = 0; k < gjk.count; ++k) {
    better.a = better.a + gjk.weight[k] * gjk.simplex[k].a;
    better.b = better.b + gjk.weight[k] * (gjk.simplex[k].b - shift);
  }
  return better;
}

CoreDistance with_checked_witness(const MinkowskiDifference &difference, const CoreDistance &rough) {
  if (rough.distance > 0.0 || witness_error(rough) <= 1e-12 * difference.scale) return rough;
  const CoreDistance better = with_better_witness(difference, rough);
  return witness_error(better) < witness_error(rough) ? better : rough;
}

CoreDistance enumerated(const MinkowskiDifference &difference, DistanceScratch &scratch) {
  ++scratch.counters.brute_force;
  const EnumerationResult r = enumerate_features(difference);
  return with_checked_witness(difference, {r.distance, r.direction, r.a, r.b, DistanceMethod::brute_force, true});
}

// How far p is outside a box centred at the origin.
double outside_box(const Vec3 &half, const Vec3 &p) {
  return std::max({std::fabs(p.x) - half.x, std::fabs(p.y) - half.y, std::fabs(p.z) - half.z});
}

CoreDistance overlapping_boxes(const ConvexBody &a, const ConvexBody &b, const BoxPair &boxes, const BoxAxes &axes) {
  const Pose &pose = boxes.b_in_a();
  CoreDistance result{axes.separation, axes.axis, axes.a, axes.b, DistanceMethod::separating_axes, true};
  const double scale = norm(a.half) + norm(b.half);
  const Vec3 b_local = transposed_times(pose.rotation, axes.b - pose.translation);
  const double outside = std::max(outside_box(a.half, axes.a), outside_box(b.half, b_local));
  if (outside <= 1e-11 * scale) return result;
  const CoreDistance better = with_better_witness(MinkowskiDifference(a, b, pose), result);
  return witness_error(better) < outside ? better : result;
}

bool has_facets(CoreShape core) { return core == CoreShape::box || core == CoreShape::polytope; }

// That of bodies with corners only, relative to their size and distance.
constexpr double polyhedral_tolerance = 1e-14;

// Of boxes, polytopes and segments.
CoreDistance iterated(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &pose, const Vec3 &first,
                      DistanceScratch &scratch) {
  const MinkowskiDifference difference(body_a, body_b, pose);
  const double tolerance = polyhedral_tolerance * difference.scale;
  const double size = core_radius(body_a) + core_radius(body_b);
  GjkResult gjk = gjk_start(difference, first);
  // Mostly bodies that are apart are so along the first direction.
  const bool may_overlap = dot(gjk.closest, first) < 0.0;
  if (may_overlap && has_facets(body_a.core) && has_facets(body_b.core) && norm2(pose.translation) <= size * size) {
    FacetWalk::Result walked;
    const FacetWalk::Outcome outcome = scratch.facet_walk.minimum_translation(difference, -first, gjk.simplex[0], walked);
    if (outcome == FacetWalk::Outcome::found) {
      ++scratch.counters.walks;
      return with_checked_witness(difference, {-walked.depth, walked.direction, walked.a, walked.b,
                                               DistanceMethod::facet_walk, true});
    }
    if (outcome == FacetWalk::Outcome::apart) gjk.simplex[0] = difference.support(walked.direction), gjk.closest = gjk.simplex[0].w;
  }
  gjk_continue(difference, tolerance, 0.0, gjk);
  if (gjk.status == GjkResult::Status::apart) {
    CoreDistance result{norm(gjk.closest), gjk.direction, {}, {}, DistanceMethod::gjk, true};
    for (int k = 0; k < gjk.count; ++k) {
      result.a = result.a + gjk.weight[k] * gjk.simplex[k].a;
      result.b = result.b + gjk.weight[k] * gjk.simplex[k].b;
    }
    return result;
  }
  if (gjk.status == GjkResult::Status::uncertain && gjk.lower > 0.0) return enumerated(difference, scratch);
  const PenetrationResult inside =
      scratch.expanding_polytope.depth(difference, gjk.simplex, gjk.count, tolerance, 1024);
  // A negative depth says that the origin is outside after all.
  if (!inside.proven || inside.depth < -1e-12 * difference.scale) return enumerated(difference, scratch);
  return with_checked_witness(difference, {-inside.depth, inside.direction, inside.a, inside.b,
                                           DistanceMethod::expanding_polytope, true});
}

Vec3 nearest_in_box(const Vec3 &half, const Vec3 &p) {
  return {std::clamp(p.x, -half.x, half.x), std::clamp(p.y, -half.y, half.y), std::clamp(p.z, -half.z, half.z)};
}

// Where a search between bodies with corners only begins: from the middle of one to the place of a box or segment that is nearest to it, which
// is more nearly how both lie than the way between their middles. From B to A, in A's frame.
Vec3 first_direction(const ConvexBody &a, const ConvexBody &b, const Pose &pose) {
  const Vec3 center_a = core_center(a), center_b = pose(core_center(b));
  if (is_box_like(a.core)) {
    const Vec3 nearest = nearest_in_box(a.half, center_b);
    if (norm2(nearest - center_b) > 0.0) return nearest - center_b;
  } else if (is_box_like(b.core)) {
    const Vec3 local = transposed_times(pose.rotation, center_a - pose.translation), nearest = nearest_in_box(b.half, local);
    if (norm2(local - nearest) > 0.0) return pose.rotation * (local - nearest);
  }
  return center_a - center_b;
}

CoreDistance core_distance(const ConvexBody &a, const ConvexBody &b, const Pose &pose, DistanceScratch &scratch) {
  if (lies_on_line(a.core) && lies_on_line(b.core)) {
    return distance_of_segments({0, 0, 1}, a.half.z, normalized(pose.rotation.column(2)), b.half.z, pose.translation);
  }
  if (b.core == CoreShape::point && has_point_formula(a.core)) return distance_of_point(a, pose.translation);
  if (a.core == CoreShape::point && has_point_formula(b.core)) {
    return exchanged(distance_of_point(b, pose.inverse().translation), pose);
  }
  const bool polyhedral = is_polyhedral(a.core) && is_polyhedral(b.core);
  Vec3 first = polyhedral ? first_direction(a, b, pose) : core_center(a) - pose(core_center(b));
  const double reach = core_radius(a) + core_radius(b);
  if (a.core == CoreShape::box && b.core == CoreShape::box && norm2(pose.translation) <= reach * reach) {
    const BoxPair boxes(a.half, b.half, pose);
    BoxAxes axes;
    find_box_axes(boxes, axes);
    if (axes.separation <= 0.0) return overlapping_boxes(a, b, boxes, axes);
    first = -axes.axis;
  }
  if (is_box_like(a.core) && is_box_like(b.core)) {
    const double tolerance = polyhedral_tolerance * (reach + norm(pose.translation));
    CoreDistance apart;
    if (distance_of_disjoint_boxes(a.half, b.half, pose, tolerance, apart)) return apart;
  }
  if (norm2(first) == 0.0) first = {1, 0, 0};
  if (!polyhedral) return curved_distance(a, b, pose, first, scratch);
  return iterated(a, b, pose, first, scratch);
}

}  // namespace

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
        if (std::fabs(dot(p.edge_directions()[static_cast<std::size_t>(e)], m)) > parallel) continue;
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

SignedDistance signed_distance(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, DistanceScratch &scratch) {
  ++scratch.counters.queries;
  SignedDistance result;
  const Mat3 &r = b_in_a.rotation;
  if (!is_finite(b_in_a.translation) || !is_finite(r.row[0]) || !is_finite(r.row[1]) || !is_finite(r.row[2])) {
    result.proven = false;
    return result;
  }
  const Vec3 &t = b_in_a.translation;
  const double largest = std::max({std::fabs(t.x), std::fabs(t.y), std::fabs(t.z)});
  CoreDistance core;
  if (largest < 1e100) {
    core = core_distance(a, b, b_in_a, scratch);
  } else {
    // So far away that squares overflow: the bodies are points.
    const Vec3 shrunk = (1.0 / largest) * t;
    core = {std::fmin(norm(shrunk) * largest, 1.7e308), normalized(shrunk), {}, t, DistanceMethod::closed_form, false};
  }
  return swept_distance(core, a.radius, b.radius);
}

}  // namespace cmb::convex
