#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "backend/distance_backend.hpp"
#include "backend/fcl_geometry.hpp"

namespace cmb {

namespace {

// FCL's own GJK and EPA. Its other solver, built on libccd, contains assertions that end the program, and Debian
// ships FCL with assertions on.
constexpr fcl::GJKSolverType solver = fcl::GST_INDEP;
constexpr double solver_tolerance = 1e-9;
constexpr std::size_t most_contacts = 16;

class FclShape : public LibraryShape {
 public:
  explicit FclShape(std::unique_ptr<const fcl::CollisionGeometryd> geometry) : geometry_(std::move(geometry)) {}
  const fcl::CollisionGeometryd *geometry() const { return geometry_.get(); }

 private:
  std::unique_ptr<const fcl::CollisionGeometryd> geometry_;
};

struct Placed {
  const fcl::CollisionGeometryd *geometry;
  fcl::Transform3d pose;
};

Vec3 vector(const fcl::Vector3d &v) { return {v.x(), v.y(), v.z()}; }

std::optional<ConvexAnswer> overlap(const Placed &a, const Placed &b) {
  fcl::CollisionRequestd request(most_contacts, true);
  request.gjk_solver_type = solver;
  request.gjk_tolerance = solver_tolerance;
  fcl::CollisionResultd result;
  fcl::collide(a.geometry, a.pose, b.geometry, b.pose, request, result);
  if (!result.isCollision() || result.numContacts() == 0) return std::nullopt;
  const fcl::Contactd *deepest = &result.getContact(0);
  for (std::size_t i = 1; i < result.numContacts(); ++i) {
    if (result.getContact(i).penetration_depth > deepest->penetration_depth) deepest = &result.getContact(i);
  }
  if (!(deepest->penetration_depth > 0.0)) return std::nullopt;  // its solver gives some depths with the wrong sign
  ConvexAnswer answer;
  answer.distance = -deepest->penetration_depth;
  answer.normal = -vector(deepest->normal);  // FCL's points from the first object to the second
  const Vec3 position = vector(deepest->pos);
  answer.point_a = position + 0.5 * answer.distance * answer.normal;
  answer.point_b = position - 0.5 * answer.distance * answer.normal;
  return answer;
}

std::optional<ConvexAnswer> gap(const Placed &a, const Placed &b) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  request.distance_tolerance = solver_tolerance;
  fcl::DistanceResultd result;
  const double distance = fcl::distance(a.geometry, a.pose, b.geometry, b.pose, request, result);
  if (!(distance > 0.0)) return std::nullopt;
  ConvexAnswer answer;
  answer.distance = distance;
  answer.point_a = vector(result.nearest_points[0]);
  answer.point_b = vector(result.nearest_points[1]);
  answer.normal = normalized(answer.point_a - answer.point_b);
  return answer;
}

}  // namespace

std::shared_ptr<const LibraryShape> make_fcl_shape(const Shape &shape) {
  try {
    auto geometry = fcl_geometry(shape);
    if (!geometry) return nullptr;
    geometry->computeLocalAABB();
    return std::make_shared<const FclShape>(std::move(geometry));
  } catch (const std::logic_error &) {
    return nullptr;  // FCL refuses the shape
  }
}

std::optional<ConvexAnswer> fcl_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                                         BackendScratch &) {
  if (!a.in_library || !b.in_library) return std::nullopt;
  try {
    const Placed placed_a{static_cast<const FclShape &>(*a.in_library).geometry(), fcl_transform(pose_a)};
    const Placed placed_b{static_cast<const FclShape &>(*b.in_library).geometry(), fcl_transform(pose_b)};
    const auto answer = overlap(placed_a, placed_b);
    return answer ? answer : gap(placed_a, placed_b);
  } catch (...) {
    return std::nullopt;  // FCL throws where its solver fails
  }
}

}  // namespace cmb
