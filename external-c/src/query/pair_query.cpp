#include "query/pair_query.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "backend/distance_library.hpp"
#include "manifold/capsule_manifold.hpp"
#include "manifold/halfspace_manifold.hpp"
#include "math/pose_algebra.hpp"
#include "query/mesh_halfspace.hpp"
#include "query/mesh_query.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

namespace {

Plane world_plane(const Pose &pose) {
  const Vec3 normal = pose.rotation.column(2);
  return {normal, dot(normal, pose.translation)};
}

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
  theirs.mean_normal = theirs.normal;
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

// The gap between two shapes' bounding spheres, or between such a sphere and a half-space, not both: a lower bound of
// their distance.
struct BoundGap {
  double distance;
  Vec3 normal, witness;  // as of a contact
};

BoundGap gap_to_halfspace(const Shape &shape, const Pose &pose, const Plane &plane) {
  const Vec3 center = pose(shape.bound_center);
  const double height = dot(plane.normal, center) - plane.offset;
  return {height - shape.bound_radius, plane.normal, center - (0.5 * (height + shape.bound_radius)) * plane.normal};
}

BoundGap bound_gap(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b) {
  if (b.kind == ShapeKind::halfspace) return gap_to_halfspace(a, pose_a, world_plane(pose_b));
  if (a.kind == ShapeKind::halfspace) {
    BoundGap gap = gap_to_halfspace(b, pose_b, world_plane(pose_a));
    gap.normal = -gap.normal;
    return gap;
  }
  const Vec3 center_a = pose_a(a.bound_center), center_b = pose_b(b.bound_center), apart = center_a - center_b;
  const double length = norm(apart);
  const Vec3 normal = length > 0.0 ? (1.0 / length) * apart : Vec3{0, 0, 1};
  return {length - a.bound_radius - b.bound_radius, normal,
          0.5 * (center_a + center_b + (b.bound_radius - a.bound_radius) * normal)};
}

// From the exact answer to that of the bounding spheres, which are less than 2 exact_within apart.
void fade_to_gap(const BoundGap &gap, double exact_within, ContactSet &result) {
  const double x = gap.distance / exact_within - 1.0;
  if (!(x > 0.0)) return;
  const double part = x * x * (3.0 - 2.0 * x);
  result.distance += part * (gap.distance - result.distance);
  result.normal = normalized((1.0 - part) * result.normal + part * gap.normal, gap.normal);
  result.witness = (1.0 - part) * result.witness + part * gap.witness;
}

// Of an orthonormal rotation the diagonal tells. One comparison, for a branch each costs more.
bool is_identity(const Pose &pose) {
  const Mat3 &r = pose.rotation;
  const Vec3 &t = pose.translation;
  return std::fabs(r.row[0].x - 1.0) + std::fabs(r.row[1].y - 1.0) + std::fabs(r.row[2].z - 1.0) + std::fabs(t.x) +
             std::fabs(t.y) + std::fabs(t.z) == 0.0;
}

// Where a shape is whose body is at `body`: that pose, or `placed`, which receives the shape's own.
const Pose &shape_pose(const Pose &body, const Shape &shape, Pose &placed) {
  if (is_identity(shape.in_body)) return body;
  placed = compose(body, shape.in_body);
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
    case PairMethod::capsule_mesh:
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

// As query_shapes, but for shapes farther apart than `exact_within` (m).
void query_shapes_within(double exact_within, const Scene &scene, const Shape &a, const Pose &pose_a, const Shape &b,
                         const Pose &pose_b, QueryScratch &scratch, ContactSet &result, cmb_backend &who) {
  const BoundGap gap = bound_gap(a, pose_a, b, pose_b);
  if (gap.distance >= 2.0 * exact_within) {
    result.distance = gap.distance;
    result.normal = gap.normal;
    result.witness = gap.witness;
    who = CMB_BACKEND_ANALYTIC;
    return;
  }
  query_shapes(scene, a, pose_a, b, pose_b, scratch, result, who);
  fade_to_gap(gap, exact_within, result);
}

void query_compounds(const Scene &scene, const BodyShapes &a, const Pose &pose_a, const BodyShapes &b,
                     const Pose &pose_b, QueryScratch &scratch, ContactSet &result, PairReport &report,
                     double exact_within) {
  scratch.poses_a.clear();
  scratch.poses_b.clear();
  Pose placed;
  for (const Shape &shape : a) scratch.poses_a.push_back(shape_pose(pose_a, shape, placed));
  for (const Shape &shape : b) scratch.poses_b.push_back(shape_pose(pose_b, shape, placed));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) {
      if (pair_entry(a[i], b[j]).method == PairMethod::none) continue;
      // Shapes apart that cannot be the nearest have nothing to tell.
      const double bound = bound_gap(a[i], scratch.poses_a[i], b[j], scratch.poses_b[j]).distance;
      if (bound > 0.0 && bound >= result.distance) continue;
      ContactSet &contact = scratch.shape_contact;
      contact.points.clear();
      cmb_backend who = CMB_BACKEND_AUTO;
      query_shapes_within(exact_within, scene, a[i], scratch.poses_a[i], b[j], scratch.poses_b[j], scratch, contact, who);
      result.points.insert(result.points.end(), contact.points.begin(), contact.points.end());
      if (contact.distance < result.distance) {
        result.distance = contact.distance;
        result.normal = contact.normal;
        result.witness = contact.witness;
        report.backend = who;
      }
    }
  }
}

}  // namespace

void query_bodies(const Scene &scene, const BodyShapes &a, const Pose &pose_a, const BodyShapes &b, const Pose &pose_b,
                  QueryScratch &scratch, ContactSet &result, PairReport &report, double exact_within) {
  result.points.clear();
  report = {};
  const bool single = a.size() == 1 && b.size() == 1;
  if (single && pair_entry(a[0], b[0]).method != PairMethod::none) {
    const Pose &at_a = shape_pose(pose_a, a[0], scratch.placed_a), &at_b = shape_pose(pose_b, b[0], scratch.placed_b);
    if (exact_within == std::numeric_limits<double>::infinity()) {
      query_shapes(scene, a[0], at_a, b[0], at_b, scratch, result, report.backend);
    } else {
      query_shapes_within(exact_within, scene, a[0], at_a, b[0], at_b, scratch, result, report.backend);
    }
    return;
  }
  result.distance = CMB_DISTANCE_NONE;
  result.normal = {0.0, 0.0, 1.0};
  result.witness = 0.5 * (pose_a.translation + pose_b.translation);
  if (!single) query_compounds(scene, a, pose_a, b, pose_b, scratch, result, report, exact_within);
}

}  // namespace cmb
