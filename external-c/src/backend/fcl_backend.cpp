#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <memory>
#include <utility>

#include "backend/distance_backend.hpp"

namespace cmb {

namespace {

// FCL's own GJK and EPA. Its other solver, built on libccd, contains assertions that end the program, and Debian
// ships FCL with assertions on.
constexpr fcl::GJKSolverType solver = fcl::GST_INDEP;
constexpr double solver_tolerance = 1e-9;
constexpr std::size_t most_contacts = 16;

std::shared_ptr<fcl::CollisionGeometryd> hull_geometry(const convex::Polytope &polytope) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3 &v : polytope.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const convex::Polytope::Face &face : polytope.faces()) {
    faces->push_back(face.count);
    for (std::int32_t k = 0; k < face.count; ++k) {
      faces->push_back(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
    }
  }
  return std::make_shared<fcl::Convexd>(vertices, static_cast<int>(polytope.faces().size()), faces);
}

std::shared_ptr<fcl::CollisionGeometryd> geometry(const Shape &shape) {
  const Vec3 &half = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::sphere: return std::make_shared<fcl::Sphered>(shape.body.radius);
    case ShapeKind::capsule: return std::make_shared<fcl::Capsuled>(shape.body.radius, 2.0 * half.z);
    case ShapeKind::box: return std::make_shared<fcl::Boxd>(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
    case ShapeKind::hull: return hull_geometry(shape.polytope->geometry());
    case ShapeKind::ellipsoid: return std::make_shared<fcl::Ellipsoidd>(half.x, half.y, half.z);
    case ShapeKind::cylinder: return std::make_shared<fcl::Cylinderd>(half.x, 2.0 * half.z);
    case ShapeKind::cone: return std::make_shared<fcl::Coned>(half.x, 2.0 * half.z);
    case ShapeKind::halfspace:
    case ShapeKind::mesh: break;
  }
  return nullptr;
}

fcl::Transform3d transform(const Pose &pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rotation.row[i][j];
    result.translation()(i) = pose.translation[i];
  }
  return result;
}

Vec3 vector(const fcl::Vector3d &v) { return {v.x(), v.y(), v.z()}; }

std::optional<ConvexAnswer> overlap(const fcl::CollisionObjectd &a, const fcl::CollisionObjectd &b) {
  fcl::CollisionRequestd request(most_contacts, true);
  request.gjk_solver_type = solver;
  request.gjk_tolerance = solver_tolerance;
  fcl::CollisionResultd result;
  fcl::collide(&a, &b, request, result);
  if (!result.isCollision() || result.numContacts() == 0) return std::nullopt;
  const fcl::Contactd *deepest = &result.getContact(0);
  for (std::size_t i = 1; i < result.numContacts(); ++i) {
    if (result.getContact(i).penetration_depth > deepest->penetration_depth) deepest = &result.getContact(i);
  }
  ConvexAnswer answer;
  answer.distance = -deepest->penetration_depth;
  answer.normal = -vector(deepest->normal);  // FCL's points from the first object to the second
  const Vec3 position = vector(deepest->pos);
  answer.point_a = position + 0.5 * answer.distance * answer.normal;
  answer.point_b = position - 0.5 * answer.distance * answer.normal;
  return answer;
}

std::optional<ConvexAnswer> gap(const fcl::CollisionObjectd &a, const fcl::CollisionObjectd &b) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  request.distance_tolerance = solver_tolerance;
  fcl::DistanceResultd result;
  const double distance = fcl::distance(&a, &b, request, result);
  if (!(distance > 0.0)) return std::nullopt;
  ConvexAnswer answer;
  answer.distance = distance;
  answer.point_a = vector(result.nearest_points[0]);
  answer.point_b = vector(result.nearest_points[1]);
  answer.normal = normalized(answer.point_a - answer.point_b);
  return answer;
}

}  // namespace

std::optional<ConvexAnswer> fcl_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                         BackendScratch &) {
  try {
    const fcl::CollisionObjectd object_a(geometry(a), transform(pose_a)), object_b(geometry(b), transform(pose_b));
    const auto answer = overlap(object_a, object_b);
    return answer ? answer : gap(object_a, object_b);
  } catch (...) {
    return std::nullopt;  // FCL throws where its solver fails
  }
}

}  // namespace cmb
