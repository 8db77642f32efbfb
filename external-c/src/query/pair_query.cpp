#include "query/pair_query.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "backend/distance_library.hpp"
#include "manifold/axis/capsule_manifold.hpp"
#include "manifold/halfspace_manifold.hpp"
#include "math/pose_algebra.hpp"
#include "query/bound_gap.hpp"
#include "query/mesh_halfspace.hpp"
#include "query/mesh_query.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

namespace {

// How far, by the shapes' size, a library's distance may be from what the shapes leave along its own normal.
constexpr double library_tolerance = 1e-4;

// Asks the scene's library; whether its answer is used. It counts as it is: along its normal, to its depth, and no other
// separating direction is looked for.
bool find_library_answer(const Scene &scene, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                         SignedDistance &answer) {
  SignedDistance theirs;
  const bool holds = scene.library->distance(a, pose_a, b, pose_b, theirs) &&
                     answer_holds(theirs, a, pose_a, b, pose_b, library_tolerance);
  (holds ? scene.answered : scene.refused).fetch_add(1, std::memory_order_relaxed);
  if (!holds) return false;
  theirs.interior_ball = std::numeric_limits<double>::infinity();
  answer = theirs;
  return true;
}

// Asks the scene's back end; the exact path answers where that has no answer, or one that does not hold.
void find_answer(const Scene &scene, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                 BackendScratch &scratch, SignedDistance &answer, cmb_backend &who) {
  if (scene.library != nullptr && find_library_answer(scene, a, pose_a, b, pose_b, answer)) {
    who = scene.backend;
    return;
  }
  who = CMB_BACKEND_ANALYTIC;
  find_exact_distance(a, pose_a, b, pose_b, scratch, answer);
}

void take_gap(const BoundGap &gap, ContactSet &result) {
  result.distance = gap.distance;
  result.normal = gap.normal;
  result.witness = gap.witness;
}

// From the exact answer to that of the bounds, which are less than 2 exact_within apart.
void fade_to_gap(const BoundGap &gap, double exact_within, ContactSet &result) {
  const double x = gap.distance / exact_within - 1.0;
  if (!(x > 0.0)) return;
  const double part = x * x * (3.0 - 2.0 * x);
  result.distance += part * (gap.distance - result.distance);
  result.normal = normalized((1.0 - part) * result.normal + part * gap.normal, gap.normal);
  result.witness = (1.0 - part) * result.witness + part * gap.witness;
}

// Where a shape is whose body is at `body`: that pose, or `placed`, which receives the shape's own.
const Pose &shape_pose(const Pose &body, const Shape &shape, Pose &placed) {
  if (!shape.is_moved) return body;
  placed = compose(body, shape.in_body);
  return placed;
}

const PlacedShapes &place_shapes(const Scene &scene, std::size_t body, const Pose &pose, QueryScratch &scratch) {
  static_assert(sizeof(Pose) == 12 * sizeof(double));
  PlacedShapes &placed = scratch.placed[body];
  if (placed.scene_number == scene.number && std::memcmp(&placed.body, &pose, sizeof pose) == 0) return placed;
  placed.scene_number = 0;  // should there be no room
  placed.body = pose;
  placed.poses.clear();
  placed.centers.clear();
  Pose at;
  for (const Shape &shape : scene.bodies[body]) {
    const Pose &of_shape = shape_pose(pose, shape, at);
    placed.poses.push_back(of_shape);
    placed.centers.push_back(of_shape(shape.bound_center));
  }
  placed.scene_number = scene.number;
  return placed;
}

}  // namespace

void query_shapes(const Scene &scene, const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                  QueryScratch &scratch, ContactSet &result, cmb_backend &who) {
  const PairEntry pair = pair_entry(a, b);
  if (pair.exchanged && !is_bounded_convex(pair.method)) {
    query_shapes(scene, b, pose_b, a, pose_a, scratch, result, who);
    reverse(result);
    return;
  }
  who = CMB_BACKEND_ANALYTIC;
  switch (pair.method) {
    case PairMethod::none: return;
    case PairMethod::sphere_halfspace:
    case PairMethod::polytope_halfspace:
    case PairMethod::round_halfspace: halfspace_contact(a, pose_a, world_plane(pose_b), result); return;
    case PairMethod::mesh_halfspace: mesh_halfspace_contact(a, pose_a, world_plane(pose_b), result); return;
    case PairMethod::sphere_mesh:
    case PairMethod::polytope_mesh:
    case PairMethod::round_mesh:
    case PairMethod::mesh_mesh: mesh_contact(a, pose_a, b, pose_b, scratch.mesh, result); return;
    case PairMethod::capsule_capsule:
      if (scene.library == nullptr && capsule_contact(a, pose_a, b, pose_b, result)) return;
      break;
    default: break;
  }
  SignedDistance &answer = scratch.answer;
  find_answer(scene, a, pose_a, b, pose_b, scratch.backend, answer, who);
  convex_contact(a, pose_a, b, pose_b, answer, scratch.backend.distance, scratch.manifold, result);
}

QueryScratch &query_scratch() {
  static thread_local QueryScratch scratch;
  return scratch;
}

namespace {

// As query_shapes, but for shapes whose bounds, `gap` apart, are farther apart than `exact_within` (m).
void query_shapes_within(double exact_within, const BoundGap &gap, const Scene &scene, const Shape &a,
                         const Pose &pose_a, const Shape &b, const Pose &pose_b, QueryScratch &scratch,
                         ContactSet &result, cmb_backend &who) {
  if (gap.distance >= 2.0 * exact_within) {
    take_gap(gap, result);
    who = CMB_BACKEND_ANALYTIC;
    return;
  }
  query_shapes(scene, a, pose_a, b, pose_b, scratch, result, who);
  fade_to_gap(gap, exact_within, result);
}

void query_compounds(const Scene &scene, std::size_t body_a, const Pose &pose_a, std::size_t body_b,
                     const Pose &pose_b, QueryScratch &scratch, ContactSet &result, PairReport &report,
                     double exact_within) {
  const BodyShapes &a = scene.bodies[body_a], &b = scene.bodies[body_b];
  scratch.apart.clear();
  if (scratch.placed.size() < scene.bodies.size()) scratch.placed.resize(scene.bodies.size());
  const PlacedShapes &placed_a = place_shapes(scene, body_a, pose_a, scratch);
  const PlacedShapes &placed_b = place_shapes(scene, body_b, pose_b, scratch);
  const auto take = [&](std::size_t i, std::size_t j, const BoundGap &gap) {
    ContactSet &contact = scratch.shape_contact;
    contact.points.clear();
    cmb_backend who = CMB_BACKEND_AUTO;
    query_shapes_within(exact_within, gap, scene, a[i], placed_a.poses[i], b[j], placed_b.poses[j], scratch, contact,
                        who);
    result.points.insert(result.points.end(), contact.points.begin(), contact.points.end());
    if (contact.distance < result.distance) {
      result.distance = contact.distance;
      result.normal = contact.normal;
      result.witness = contact.witness;
      report.backend = who;
    }
  };
  const auto gap = [&](std::size_t i, std::size_t j) {
    return bound_gap(a[i], placed_a.poses[i], b[j], placed_b.poses[j]);
  };
  const auto gap_of_spheres = [&](std::size_t i, std::size_t j) {
    if (a[i].kind == ShapeKind::halfspace || b[j].kind == ShapeKind::halfspace) {
      return sphere_gap(a[i], placed_a.poses[i], b[j], placed_b.poses[j]);
    }
    return norm(placed_a.centers[i] - placed_b.centers[j]) - a[i].bound_radius - b[j].bound_radius;
  };
  const auto look_at_all_with = [&](std::size_t i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (pair_entry(a[i], b[j]).method == PairMethod::none) continue;
      const double of_spheres = gap_of_spheres(i, j);
      if (of_spheres > 0.0) {
        scratch.apart.push_back({i, j, of_spheres});
        continue;
      }
      const BoundGap between = gap(i, j);
      if (between.distance > 0.0) {
        scratch.apart.push_back({i, j, between.distance});
      } else {
        take(i, j, between);
      }
    }
  };
  const auto take_nearest_of_apart = [&] {
    const auto nearest =
        std::min_element(scratch.apart.begin(), scratch.apart.end(),
                         [](const ShapesApart &x, const ShapesApart &y) { return x.at_least < y.at_least; });
    if (nearest == scratch.apart.end()) return;
    std::iter_swap(scratch.apart.begin(), nearest);
    for (const ShapesApart &shapes : scratch.apart) {
      if (shapes.at_least >= result.distance) continue;
      const BoundGap between = gap(shapes.first, shapes.second);
      if (between.distance < result.distance) take(shapes.first, shapes.second, between);
    }
    scratch.apart.clear();
  };
  // First what may touch; of what is apart the shapes that seem nearest, and then what can be nearer than they are. Shapes
  // that the sphere about all of b is away from come last, as a rule without a look at b's shapes.
  const BodyBounds &bounds_b = scene.bounds[body_b];
  const Vec3 center_b = pose_b(bounds_b.center);
  scratch.away.clear();
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double of_all = a[i].kind == ShapeKind::halfspace || !bounds_b.bounded()
                              ? 0.0
                              : norm(placed_a.centers[i] - center_b) - a[i].bound_radius - bounds_b.radius;
    if (of_all > 0.0) {
      scratch.away.push_back({i, of_all});
    } else {
      look_at_all_with(i);
    }
  }
  take_nearest_of_apart();
  const auto nearest = std::min_element(scratch.away.begin(), scratch.away.end(),
                                        [](const ShapeAway &x, const ShapeAway &y) { return x.at_least < y.at_least; });
  if (nearest != scratch.away.end()) std::iter_swap(scratch.away.begin(), nearest);
  for (const ShapeAway &shape : scratch.away) {
    if (shape.at_least >= result.distance) continue;
    look_at_all_with(shape.number);
    take_nearest_of_apart();
  }
}

// As query_compounds, but of bodies whose bounds are far apart these tell, without a look at any shape.
void query_compounds_within(double exact_within, const Scene &scene, std::size_t a, const Pose &pose_a, std::size_t b,
                            const Pose &pose_b, QueryScratch &scratch, ContactSet &result, PairReport &report) {
  const BodyBounds &bounds_a = scene.bounds[a], &bounds_b = scene.bounds[b];
  if (!bounds_a.bounded() || !bounds_b.bounded()) {
    query_compounds(scene, a, pose_a, b, pose_b, scratch, result, report, exact_within);
    return;
  }
  const BoundGap gap = bound_gap(bounds_a, pose_a, bounds_b, pose_b);
  if (gap.distance >= 2.0 * exact_within) {
    take_gap(gap, result);
    report.backend = CMB_BACKEND_ANALYTIC;
    return;
  }
  query_compounds(scene, a, pose_a, b, pose_b, scratch, result, report, exact_within);
  fade_to_gap(gap, exact_within, result);
}

}  // namespace

void query_bodies(const Scene &scene, std::size_t body_a, const Pose &pose_a, std::size_t body_b, const Pose &pose_b,
                  QueryScratch &scratch, ContactSet &result, PairReport &report, double exact_within) {
  const BodyShapes &a = scene.bodies[body_a], &b = scene.bodies[body_b];
  result.points.clear();
  report = {};
  const bool single = a.size() == 1 && b.size() == 1;
  if (single && pair_entry(a[0], b[0]).method != PairMethod::none) {
    const Pose &at_a = shape_pose(pose_a, a[0], scratch.placed_a), &at_b = shape_pose(pose_b, b[0], scratch.placed_b);
    if (exact_within == std::numeric_limits<double>::infinity()) {
      query_shapes(scene, a[0], at_a, b[0], at_b, scratch, result, report.backend);
    } else {
      const BoundGap gap = bound_gap(a[0], at_a, b[0], at_b);
      query_shapes_within(exact_within, gap, scene, a[0], at_a, b[0], at_b, scratch, result, report.backend);
    }
    return;
  }
  result.distance = CMB_DISTANCE_NONE;
  result.normal = {0.0, 0.0, 1.0};
  result.witness = 0.5 * (pose_a.translation + pose_b.translation);
  if (single) return;
  if (exact_within == std::numeric_limits<double>::infinity()) {
    query_compounds(scene, body_a, pose_a, body_b, pose_b, scratch, result, report, exact_within);
  } else {
    query_compounds_within(exact_within, scene, body_a, pose_a, body_b, pose_b, scratch, result, report);
  }
}

}  // namespace cmb
