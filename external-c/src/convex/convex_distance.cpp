#include "convex_distance.hpp"

#include <algorithm>

#include "box_axes.hpp"
#include "boxes_apart.hpp"
#include "closed_distance.hpp"
#include "direction_refinement.hpp"
#include "feature_enumeration.hpp"
#include "gjk.hpp"
#include "inner_ball.hpp"
#include "minkowski_difference.hpp"
#include "touching_direction.hpp"

namespace cmb::convex {

namespace {

CoreDistance exchanged(const CoreDistance &d, const Pose &pose) {
  // Computed in B's frame with the roles exchanged.
  return {d.distance, -(pose.rotation * d.direction), pose(d.b), pose(d.a), d.method, d.proven, {}};
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

CoreDistance overlapping_boxes(const ConvexBody &a, const ConvexBody &b, const Pose &pose, const BoxAxes &axes,
                               bool with_mean) {
  CoreDistance result{axes.separation, axes.axis, axes.a, axes.b, DistanceMethod::separating_axes, true};
  if (with_mean) {
    result.mean_outward =
        nearby_surface_of_boxes(a.half, b.half, pose, std::max(0.0, -axes.separation), core_radius(a) + core_radius(b));
  }
  const double scale = norm(a.half) + norm(b.half);
  const Vec3 b_local = transposed_times(pose.rotation, axes.b - pose.translation);
  const double outside = std::max(outside_box(a.half, axes.a), outside_box(b.half, b_local));
  if (outside <= 1e-11 * scale) return result;
  const CoreDistance better = with_better_witness(MinkowskiDifference(a, b, pose), result);
  return witness_error(better) < outside ? better : result;
}

// Outward directions of a body's side and ends, in the half plane y = 0, x >= 0 of its frame; 0 where its profile is
// not made of straight lines.
int profile_normals(const ConvexBody &body, Vec3 normals[3]) {
  switch (body.core) {
    case CoreShape::cylinder:
    case CoreShape::segment:
      normals[0] = {1, 0, 0}, normals[1] = {0, 0, 1}, normals[2] = {0, 0, -1};
      return 3;
    case CoreShape::cone: {
      const double slant = std::hypot(body.half.x, 2.0 * body.half.z);
      normals[0] = {2.0 * body.half.z / slant, 0, body.half.x / slant}, normals[1] = {0, 0, -1};
      return 2;
    }
    default: return 0;
  }
}

// Bodies of revolution on one axis are equally deep all round, which no bound of a general search settles. But their
// difference is a body of revolution too, with a polygon as its profile: its sides are all the ways out there are.
// Receives the direction of the shortest one; false where the bodies are not of that kind, or apart.
bool coaxial_way_out(const MinkowskiDifference &difference, Vec3 &direction, double &depth) {
  const Mat3 &r = difference.b_in_a.rotation;
  const Vec3 &t = difference.b_in_a.translation;
  constexpr double tilt = 1e-14;
  if (std::hypot(r.row[0].z, r.row[1].z) > tilt || std::hypot(t.x, t.y) > tilt * difference.scale) return false;
  Vec3 of_a[3], of_b[3];
  const int count_a = profile_normals(difference.body_a, of_a), count_b = profile_normals(difference.body_b, of_b);
  if (count_a == 0 || count_b == 0) return false;
  depth = INFINITY;
  const auto consider = [&](const Vec3 &m) {
    const double height = dot(difference.support(m).w, m);
    if (height < depth) depth = height, direction = m;
  };
  for (int k = 0; k < count_a; ++k) consider(of_a[k]);
  // B's outward directions count turned over; its frame's x axis is of no meaning.
  for (int k = 0; k < count_b; ++k) consider({of_b[k].x, 0, -std::copysign(1.0, r.row[2].z) * of_b[k].z});
  return depth > 0.0;
}

bool has_facets(CoreShape core) { return core == CoreShape::box || core == CoreShape::polytope; }

// That of bodies with corners only, relative to their size and distance.
constexpr double polyhedral_tolerance = 1e-14;

// The gap between the bounds of a distance, relative to it, from which Newton's method goes on.
constexpr double rough_gap = 1e-4;
// The gap between the bounds of a depth, relative to the bodies, from which it goes on, and the most points of the search.
constexpr double rough_depth = 1e-3;
constexpr std::int32_t rough_points = 40;
// The ways out ask for balls of up to so many depths.
constexpr double ways_reach = 1.5;

CoreDistance iterated(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &pose, Vec3 first,
                      DistanceScratch &scratch, bool with_mean) {
  const MinkowskiDifference difference(body_a, body_b, pose);
  const bool polyhedral = is_polyhedral(body_a.core) && is_polyhedral(body_b.core);
  const double tolerance = (polyhedral ? polyhedral_tolerance : 1e-11) * difference.scale;
  const double size = core_radius(body_a) + core_radius(body_b);
  if (has_facets(body_a.core) && has_facets(body_b.core) && norm2(pose.translation) <= size * size) {
    SurfaceWalk::Result walked;
    const SurfaceWalk::Outcome outcome = scratch.surface_walk.way_out(difference, -first, with_mean ? size : 0.0, walked);
    if (outcome == SurfaceWalk::Outcome::found) {
      ++scratch.counters.walks;
      return with_checked_witness(difference, {-walked.depth, walked.direction, walked.a, walked.b,
                                               DistanceMethod::surface_walk, true, walked.mean_outward});
    }
    if (outcome == SurfaceWalk::Outcome::apart) first = -walked.direction;
  }
  Vec3 coaxial_direction;
  double coaxial_depth;
  if (!polyhedral && coaxial_way_out(difference, coaxial_direction, coaxial_depth)) {
    const DifferencePoint start = difference.support(coaxial_direction);
    const RefinedDirection r = refine_direction(difference, coaxial_direction, start.a, start.b);
    return {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, r.height >= coaxial_depth - tolerance, {}};
  }
  // A rough answer is the start of Newton's method, whose witness points prove it; else the search goes on.
  const bool checkable = !polyhedral && body_a.core != CoreShape::polytope && body_b.core != CoreShape::polytope;
  GjkResult gjk = gjk_distance(difference, first, tolerance, checkable ? rough_gap : 0.0);
  const auto gjk_answer = [&] {
    CoreDistance result{norm(gjk.closest), gjk.direction, {}, {}, DistanceMethod::gjk, true};
    for (int k = 0; k < gjk.count; ++k) {
      result.a = result.a + gjk.weight[k] * gjk.simplex[k].a;
      result.b = result.b + gjk.weight[k] * gjk.simplex[k].b;
    }
    return result;
  };
  // Curved cores: Newton's method sharpens the answer; `best_possible` bounds the distance from above.
  const auto refined = [&](const CoreDistance &rough, double best_possible) -> CoreDistance {
    const RefinedDirection r = refine_direction(difference, rough.direction, rough.a, rough.b);
    const bool proven = best_possible + r.height <= 1e-8 * difference.scale;
    if (!proven) ++scratch.counters.unproven;
    return {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, proven};
  };
  if (checkable && gjk.status == GjkResult::Status::apart && norm(gjk.closest) - gjk.lower > tolerance) {
    const CoreDistance rough = gjk_answer();
    const RefinedDirection r = refine_direction(difference, rough.direction, rough.a, rough.b);
    // The height is a lower bound of the distance; points of the bodies as far from each other are an upper one.
    const Vec3 b_local = transposed_times(pose.rotation, r.b - pose.translation);
    const double missing = outside(body_a, r.a) + outside(body_b, b_local);
    if (missing <= tolerance) return {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, true, {}};
    gjk = gjk_distance(difference, -rough.direction, tolerance);
  }
  const bool apart = gjk.status == GjkResult::Status::apart ||
                     (gjk.status == GjkResult::Status::uncertain && gjk.lower > 0.0);
  if (apart && !polyhedral) return refined(gjk_answer(), norm(gjk.closest));
  if (apart) return gjk.status == GjkResult::Status::apart ? gjk_answer() : enumerated(difference, scratch);
  if (!polyhedral) {
    // A ball that proves a minimum found from rough bounds spares the search for the others.
    const PenetrationResult rough =
        scratch.expanding_polytope.depth(difference, gjk.simplex, gjk.count, rough_depth * difference.scale, rough_points);
    RefinedDirection r;
    if (touching_direction(difference, rough.direction, rough.a, rough.b, r) && r.height > 0.0) {
      const double enough = ways_reach * (r.height + body_a.radius + body_b.radius) - body_a.radius - body_b.radius;
      const double ball = inner_ball(body_a, body_b, pose, r.direction, r.a, r.b, enough, tolerance);
      if (ball >= r.height) return {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, true, {}, ball};
    }
  }
  const PenetrationResult inside =
      polyhedral ? scratch.expanding_polytope.depth(difference, gjk.simplex, gjk.count, tolerance, 1024,
                                                  with_mean ? size : 0.0)
                 : scratch.expanding_polytope.depth(difference, gjk.simplex, gjk.count, 1e-9 * difference.scale, 160);
  CoreDistance result{-inside.depth, inside.direction, inside.a, inside.b, DistanceMethod::expanding_polytope,
                      inside.proven, inside.mean_outward};
  if (polyhedral) {
    // A negative depth says that the origin is outside after all.
    if (!inside.proven || inside.depth < -1e-12 * difference.scale) return enumerated(difference, scratch);
    return with_checked_witness(difference, result);
  }
  // Surfaces of revolution on one axis are equally deep all round: no bound settles that, but the
  // other directions refined show whether one of them is nearer.
  CoreDistance best = refined(result, -inside.lower);
  for (int k = 0; k < inside.other_count; ++k) {
    result.direction = inside.other[k];
    const RefinedDirection r = refine_direction(difference, result.direction, result.a, result.b, 0.2);
    if (-r.height > best.distance + 1e-13 * difference.scale) {
      best.distance = -r.height, best.direction = r.direction, best.a = r.a, best.b = r.b;
    }
  }
  return best;
}

CoreDistance core_distance(const ConvexBody &a, const ConvexBody &b, const Pose &pose, DistanceScratch &scratch,
                           bool with_mean) {
  if (lies_on_line(a.core) && lies_on_line(b.core)) {
    return distance_of_segments(a.half, pose.rotation * b.half, pose.translation);
  }
  if (b.core == CoreShape::point && has_point_formula(a.core)) return distance_of_point(a, pose.translation);
  if (a.core == CoreShape::point && has_point_formula(b.core)) {
    return exchanged(distance_of_point(b, pose.inverse().translation), pose);
  }
  Vec3 first = core_center(a) - pose(core_center(b));
  const double reach = core_radius(a) + core_radius(b);
  if (a.core == CoreShape::box && b.core == CoreShape::box && norm2(pose.translation) <= reach * reach) {
    const BoxAxes axes = box_axes(a.half, b.half, pose);
    if (axes.separation <= 0.0) return overlapping_boxes(a, b, pose, axes, with_mean);
    first = -axes.axis;
  }
  if (is_box_like(a.core) && is_box_like(b.core)) {
    const double tolerance = polyhedral_tolerance * (reach + norm(pose.translation));
    CoreDistance apart;
    if (distance_of_boxes_apart(a.half, b.half, pose, tolerance, apart)) return apart;
  }
  if (norm2(first) == 0.0) first = {1, 0, 0};
  return iterated(a, b, pose, first, scratch, with_mean);
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

SignedDistance signed_distance(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, DistanceScratch &scratch,
                               bool with_mean) {
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
    core = core_distance(a, b, b_in_a, scratch, with_mean);
  } else {
    // So far away that squares overflow: the bodies are points.
    const Vec3 shrunk = (1.0 / largest) * t;
    core = {std::fmin(norm(shrunk) * largest, 1.7e308), normalized(shrunk), {}, t, DistanceMethod::closed_form, false, {}};
  }
  return swept_distance(core, a.radius, b.radius);
}

}  // namespace cmb::convex
