#include "narrowphase/smooth/curved_distance.hpp"

#include <algorithm>

#include "narrowphase/gjk.hpp"
#include "narrowphase/interior_ball.hpp"
#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/alternating_projections.hpp"
#include "narrowphase/smooth/direction_refinement.hpp"
#include "narrowphase/smooth/feature_direction.hpp"
#include "narrowphase/smooth/flat_face_direction.hpp"
#include "shape/inset_body.hpp"

namespace cmb::convex {

namespace {

// The gap between the bounds of a depth, relative to the bodies, from which Newton's method goes on, and the most points of
// the search.
constexpr double rough_depth = 1e-3;
constexpr std::int32_t rough_points = 40;
// Agreement of the bounds, relative to the bodies.
constexpr double relative_tolerance = 1e-11;
// Agreement of a minimum, sharpened by Newton's method, with a search's lower bound that proves it the least, relative to the
// bodies; and of the search's own bounds.
constexpr double proof = 1e-8, searched = 1e-9;
// Bodies shrink by these parts of the greatest balls in them until they are apart; the gap between the bounds of their distance, relative
// to it, at which the features there are looked at. Ellipsoids have no border to miss: beside them a wider one will do first.
constexpr double shrinkages[] = {0.05, 0.3, 0.6}, shrunk_gap = 0.02, wide_gap = 0.3, wide_gap_of_segments = 0.1;
// One minus the cosine up to which directions belong to one minimum.
constexpr double same_minimum = 1e-5;
// One minus the cosine up to which a direction is that of a place known to be near, and that angle; how far places are from where
// a search saw them (rad).
constexpr double known_place = 1e-4, beside_known = 0.015, near_place = 0.05;
// The contact directions ask for balls of up to so many depths.
constexpr double ways_reach = 1.5;

// Outward directions of a body's side and ends, in the half plane y = 0, x >= 0 of its frame; 0 where its profile is
// not made of straight lines.
int profile_normals(const ConvexBody &body, Vec3 normals[3]) {
  switch (body.core) {
    case CoreShape::cylinder:
    case CoreShape::segment:
      normals[0] = {1, 0, 0}, normals[1] = {0, 0, 1}, normals[2] = {0, 0, -1};
      return 3;
    case CoreShape::cone: {
      const double slant = cone_slant(body.half);
      normals[0] = {2.0 * body.half.z / slant, 0, body.half.x / slant}, normals[1] = {0, 0, -1};
      return 2;
    }
    default: return 0;
  }
}

// Bodies of revolution on one axis are equally deep all round, which no bound of a general search settles. But their
// difference is a body of revolution too, with a polygon as its profile: its sides are all the contact directions there are.
// Receives the direction of the shortest one; false where the bodies are not of that kind, or apart.
bool coaxial_translation(const MinkowskiDifference &difference, Vec3 &direction, double &depth) {
  const Mat3 &r = difference.b_in_a.rotation;
  const Vec3 &t = difference.b_in_a.translation;
  constexpr double tilt = 1e-14;
  const double aside = tilt * difference.scale;
  if (r.row[0].z * r.row[0].z + r.row[1].z * r.row[1].z > tilt * tilt || t.x * t.x + t.y * t.y > aside * aside) return false;
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

// Whether p lies within the face, whose plane it is in.
bool is_within_sides(const Polytope &polytope, const Polytope::Face &face, const Vec3 &p) {
  const std::int32_t *const corners = polytope.face_vertices().data() + face.first;
  const auto corner = [&](std::int32_t k) { return polytope.vertices()[static_cast<std::size_t>(corners[k])]; };
  Vec3 from = corner(face.count - 1);
  for (std::int32_t k = 0; k < face.count; ++k) {
    const Vec3 to = corner(k);
    if (dot(cross(to - from, face.normal), p - from) > 0.0) return false;
    from = to;
  }
  return true;
}

// How far p is from the polytope's vertex that is farthest along d, the edges and the faces there: an upper bound of how far
// outside it is, from that vertex' surroundings alone. `little` will do: what is less is not told.
double off_support(const Polytope &polytope, const Vec3 &p, const Vec3 &d, double little) {
  const std::int32_t v = polytope.support_vertex(d);
  const Vec3 from = p - polytope.vertices()[static_cast<std::size_t>(v)];
  double nearest2 = norm2(from), nearest_plane = INFINITY;
  if (nearest2 <= little * little) return std::sqrt(nearest2);
  for (std::int32_t k = polytope.neighbour_begin(v); k < polytope.neighbour_begin(v + 1); ++k) {
    const Vec3 &along = polytope.neighbour_ways()[static_cast<std::size_t>(k)];
    const double part = dot(from, along);
    if (part > 0.0) nearest2 = std::min(nearest2, norm2(from - std::min(part / norm2(along), 1.0) * along));
    // Each face has one edge that leads from the vertex in its own turn.
    const Polytope::Edge &edge = polytope.edges()[static_cast<std::size_t>(polytope.neighbour_edges()[static_cast<std::size_t>(k)])];
    const Polytope::Face &face = polytope.faces()[static_cast<std::size_t>(edge.face[edge.vertex[0] == v ? 0 : 1])];
    const double height = std::fabs(dot(face.normal, from));
    if (height < nearest_plane && height * height < nearest2 && is_within_sides(polytope, face, p)) nearest_plane = height;
  }
  return std::min(nearest_plane, std::sqrt(nearest2));
}

// The same of any core; `d` is the outward direction there.
double off_support(const ConvexBody &body, const Vec3 &p, const Vec3 &d, double little) {
  return body.core == CoreShape::polytope ? off_support(*body.polytope, p, d, little) : outside(body, p);
}

// How far the points nearest to each other, in A's frame, are from lying in the bodies; `little` will do.
double missing(const MinkowskiDifference &difference, const RefinedDirection &r, double little) {
  const Mat3 &rotation = difference.b_in_a.rotation;
  return off_support(difference.body_a, r.a, r.direction, little) +
         off_support(difference.body_b, transposed_times(rotation, r.b - difference.b_in_a.translation),
                     -transposed_times(rotation, r.direction), little);
}

// The same, by the planes of polytopes' faces.
double missing_of_planes(const MinkowskiDifference &difference, const RefinedDirection &r) {
  const Vec3 b_local = transposed_times(difference.b_in_a.rotation, r.b - difference.b_in_a.translation);
  return outside_planes(difference.body_a, r.a) + outside_planes(difference.body_b, b_local);
}

// Whether a minimum of the support function is the least: where the bodies are apart their points prove it, where they overlap
// a ball in the difference does.
bool proven(const MinkowskiDifference &difference, const RefinedDirection &r, CoreDistance &result) {
  const ConvexBody &a = difference.body_a, &b = difference.body_b;
  const Pose &pose = difference.b_in_a;
  const double tolerance = relative_tolerance * difference.scale;
  double ball = 0.0;
  if (r.height > 0.0) {
    const double swept = a.radius + b.radius, enough = ways_reach * (r.height + swept) - swept;
    ball = interior_ball_radius(a, b, pose, r.direction, r.a, r.b, enough, tolerance);
    if (!(ball >= r.height)) return false;
  } else {
    if (!(missing(difference, r, 0.01 * tolerance) <= tolerance)) return false;
  }
  result = {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, true, ball};
  return true;
}

// The bodies' points that a search found, in A's frame.
void nearest_points(const GjkResult &gjk, Vec3 &a, Vec3 &b) {
  a = b = {};
  for (int k = 0; k < gjk.count; ++k) {
    a = a + gjk.weight[k] * gjk.simplex[k].a;
    b = b + gjk.weight[k] * gjk.simplex[k].b;
  }
}

bool is_ellipsoid(const ConvexBody &body) { return body.core == CoreShape::ellipsoid; }

// To what part of the cores, and how many times in alternation.
struct Projections {
  double part;
  int rounds;
};
constexpr Projections attempts[] = {{0.9, 4}, {1.0, 8}};

// The gap between the bounds of the distance of shrunk bodies at which their features are looked at first.
double first_gap(const MinkowskiDifference &difference) {
  const ConvexBody &a = difference.body_a, &b = difference.body_b;
  if (!is_ellipsoid(a) && !is_ellipsoid(b)) return shrunk_gap;
  const ConvexBody &other = is_ellipsoid(a) ? b : a;
  if (other.core == CoreShape::segment) return wide_gap_of_segments;
  if (other.core != CoreShape::polytope) return wide_gap;
  // A gap leaves the square root of its double open in the direction: as much as a corner's part of the sphere is wide.
  constexpr double two_pi = 6.283;
  return std::min(wide_gap, two_pi / static_cast<double>(other.polytope->vertices().size()));
}

enum class Quick { found, not_proven, too_deep };

// The gaps between the bounds of the distance of bodies apart, relative to it, at which the features there may have the answer.
constexpr double apart_gaps[] = {1e-2, 1e-4};

// Goes on with a search for the distance of bodies apart until the features that it has come to prove it; false where they do not,
// or the bodies touch.
bool find_apart(const MinkowskiDifference &difference, double tolerance, GjkResult &gjk, CoreDistance &result) {
  const Pose &pose = difference.b_in_a;
  for (const double gap : apart_gaps) {
    gjk_continue(difference, tolerance, gap, gjk);
    if (gjk.status != GjkResult::Status::apart) return false;
    Vec3 on_a, on_b;
    nearest_points(gjk, on_a, on_b);
    RefinedDirection r;
    if (feature_direction(difference, gjk.direction, on_a, transposed_times(pose.rotation, on_b - pose.translation), r) &&
        r.height < 0.0 && proven(difference, r, result)) {
      return true;
    }
  }
  return false;
}

// Straight through a flat end, or where the bodies, inset until they are apart, are nearest: what is not much in each other
// most often touches there.
Quick find_quickly(const MinkowskiDifference &difference, const Vec3 &first, CoreDistance &result) {
  RefinedDirection r;
  const Pose &pose = difference.b_in_a;
  const double reach = core_radius(difference.body_a) + core_radius(difference.body_b);
  if (norm2(pose.translation) <= reach * reach && flat_face_direction(difference, r) && proven(difference, r, result)) {
    return Quick::found;
  }
  if (has_projection(difference.body_a.core) && has_projection(difference.body_b.core)) {
    for (const Projections &attempt : attempts) {
      if (!direction_by_alternating_projections(difference, attempt.part, attempt.rounds, r)) continue;
      if (proven(difference, r, result)) return Quick::found;
      if (r.height > 0.0) break;
    }
  }
  for (const double part : shrinkages) {
    const InsetBody a = inset(difference.body_a, part), b = inset(difference.body_b, part);
    const Pose b_in_a{pose.rotation, pose(b.origin) - a.origin};
    const MinkowskiDifference apart(a.body, b.body, b_in_a);
    const auto features_prove_it = [&](const GjkResult &gjk) {
      Vec3 on_a, on_b;
      nearest_points(gjk, on_a, on_b);
      on_b = transposed_times(pose.rotation, on_b - b_in_a.translation);
      return feature_direction(difference, gjk.direction, grown(a, on_a), grown(b, on_b), r) && proven(difference, r, result);
    };
    const double tolerance = 1e-6 * apart.scale, gap = first_gap(difference);
    GjkResult gjk = gjk_distance(apart, first, tolerance, gap);
    if (gap > shrunk_gap && gjk.status == GjkResult::Status::apart) {
      if (features_prove_it(gjk)) return Quick::found;
      gjk_continue(apart, tolerance, shrunk_gap, gjk);
    }
    if (gjk.status != GjkResult::Status::apart) {
      // Where no body is round all over there is seldom a ball that proves what is that deep.
      if (is_ellipsoid(difference.body_a) || is_ellipsoid(difference.body_b)) continue;
      break;
    }
    if (features_prove_it(gjk)) return Quick::found;
    if (part == shrinkages[0]) return Quick::not_proven;
    break;
  }
  return Quick::too_deep;
}

// Curved cores: Newton's method sharpens the answer; `best_possible` bounds the distance from above.
CoreDistance refined(const MinkowskiDifference &difference, const CoreDistance &rough, double best_possible,
                     DistanceScratch &scratch) {
  RefinedDirection r = refine_direction(difference, rough.direction, rough.a, rough.b);
  const auto is_proven = [&] { return best_possible + r.height <= proof * difference.scale; };
  if (!is_proven() && r.height > 0.0) {
    // As beside a cone's axis, where a crease is about equally low all round.
    const RefinedDirection farther = refine_direction(difference, r.direction, r.a, r.b, near_creases, true);
    if (farther.height < r.height) r = farther;
  }
  const bool proven = is_proven();
  if (!proven) ++scratch.counters.unproven;
  return {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, proven};
}

// A minimum from rough bounds, where a ball proves it.
bool find_from_rough_bounds(const MinkowskiDifference &difference, const GjkResult &gjk, DistanceScratch &scratch,
                            PenetrationResult &rough, CoreDistance &result) {
  const Pose &pose = difference.b_in_a;
  rough = scratch.expanding_polytope.depth(difference, gjk.simplex, gjk.count, rough_depth * difference.scale, rough_points);
  RefinedDirection r;
  return feature_direction(difference, rough.direction, rough.a, transposed_times(pose.rotation, rough.b - pose.translation),
                           r) &&
         r.height > 0.0 && proven(difference, r, result);
}

// Replaces a minimum by one that is lower.
void take_lower(const MinkowskiDifference &difference, const RefinedDirection &r, CoreDistance &best) {
  if (!(-r.height > best.distance + 1e-13 * difference.scale)) return;
  best.distance = -r.height, best.direction = r.direction, best.a = r.a, best.b = r.b;
}

// The least depth to the tolerance of a search, `inside`, sharpened.
CoreDistance sharpened(const MinkowskiDifference &difference, const PenetrationResult &inside, DistanceScratch &scratch) {
  const CoreDistance result{-inside.depth, inside.direction, inside.a, inside.b, DistanceMethod::expanding_polytope,
                            inside.proven, {}};
  // Where the search proved the depth, the feature that it ended at has the minimum; or, if the points there are beside the
  // bodies, one just beside that has; or another one as near to the tolerance.
  RefinedDirection there;
  const Vec3 b_local = transposed_times(difference.b_in_a.rotation, inside.b - difference.b_in_a.translation);
  if (inside.proven && feature_direction(difference, inside.direction, inside.a, b_local, there) &&
      there.height <= inside.depth && there.height - inside.lower <= proof * difference.scale &&
      dot(there.direction, inside.direction) > 1.0 - same_minimum &&
      missing_of_planes(difference, there) <= relative_tolerance * difference.scale &&
      !creases_nearby(difference, there.direction)) {
    return {-there.height, there.direction, there.a, there.b, DistanceMethod::refined, true};
  }
  // Surfaces of revolution on one axis are equally deep all round: no bound settles that, but the
  // other directions refined show whether one of them is nearer.
  CoreDistance best = refined(difference, result, -inside.lower, scratch);
  for (int k = 0; k < inside.other_count; ++k) {
    take_lower(difference, refine_direction(difference, inside.other[k], result.a, result.b, 0.2), best);
  }
  return best;
}

// `rough`: of a search of the same difference that ended last; without steps where there is none.
CoreDistance overlapping(const MinkowskiDifference &difference, const GjkResult &gjk, const PenetrationResult &rough, DistanceScratch &scratch,
                         const KnownMinima *known) {
  constexpr std::int32_t most_points = 160;
  const double tolerance = searched * difference.scale;
  ExpandingPolytope &polytope = scratch.expanding_polytope;
  PenetrationResult inside = rough.steps > 0 ? polytope.go_on(difference, rough, tolerance, most_points)
                                             : polytope.depth(difference, gjk.simplex, gjk.count, tolerance, most_points);
  CoreDistance best = sharpened(difference, inside, scratch);
  if (known == nullptr) return best;
  // What is nearer by less than the search tells.
  const auto is_known = [known](const Vec3 &d) {
    return std::any_of(known->direction, known->direction + known->count,
                       [&d](const Vec3 &k) { return dot(k, d) > 1.0 - known_place; });
  };
  // Beside a known place a further one that the search does not tell from it can only be beyond a border.
  const bool at_known = is_known(best.direction);
  if (!at_known || creases_nearby(difference, best.direction, beside_known)) {
    const double nearby = at_known ? beside_known : near_place;
    take_lower(difference, refine_direction(difference, best.direction, best.a, best.b, nearby), best);
  }
  scratch.expanding_polytope.find_others(inside.depth, inside);
  for (int k = 0; k < inside.other_count; ++k) {
    if (is_known(inside.other[k])) continue;
    take_lower(difference, refine_direction(difference, inside.other[k], best.a, best.b, near_place), best);
  }
  return best;
}

}  // namespace

CoreDistance curved_distance(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &b_in_a, const Vec3 &first,
                             DistanceScratch &scratch, const KnownMinima *known) {
  const MinkowskiDifference difference(body_a, body_b, b_in_a);
  const double tolerance = relative_tolerance * difference.scale;
  Vec3 coaxial_direction;
  double coaxial_depth;
  if (coaxial_translation(difference, coaxial_direction, coaxial_depth)) {
    const DifferencePoint start = difference.support(coaxial_direction);
    const RefinedDirection r = refine_direction(difference, coaxial_direction, start.a, start.b);
    return {-r.height, r.direction, r.a, r.b, DistanceMethod::refined, r.height >= coaxial_depth - tolerance, {}};
  }
  CoreDistance result;
  const Quick quick = known != nullptr ? Quick::not_proven : find_quickly(difference, first, result);
  if (quick == Quick::found) return result;
  GjkResult gjk = gjk_distance(difference, first, tolerance, 0.1);
  if (gjk.status == GjkResult::Status::apart) {
    if (find_apart(difference, tolerance, gjk, result)) return result;
    if (gjk.status == GjkResult::Status::apart) gjk_continue(difference, tolerance, 0.0, gjk);
  }
  const bool apart = gjk.status == GjkResult::Status::apart ||
                     (gjk.status == GjkResult::Status::uncertain && gjk.lower > 0.0);
  if (!apart) {
    PenetrationResult rough;
    if (quick == Quick::too_deep && find_from_rough_bounds(difference, gjk, scratch, rough, result)) return result;
    return overlapping(difference, gjk, rough, scratch, known);
  }
  result = {norm(gjk.closest), gjk.direction, {}, {}, DistanceMethod::gjk, true};
  nearest_points(gjk, result.a, result.b);
  return refined(difference, result, result.distance, scratch);
}

}  // namespace cmb::convex
