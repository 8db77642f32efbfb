// The module with FCL.
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/distance.h>

#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "backend/distance_library.hpp"
#include "backend/fcl_geometry.hpp"

namespace {

using namespace cmb;

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

std::optional<SignedDistance> overlap(const Placed &a, const Placed &b) {
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
  SignedDistance answer;
  answer.distance = -deepest->penetration_depth;
  answer.normal = -vector(deepest->normal);  // FCL's points from the first object to the second
  const Vec3 position = vector(deepest->pos);
  answer.point_a = position + 0.5 * answer.distance * answer.normal;
  answer.point_b = position - 0.5 * answer.distance * answer.normal;
  return answer;
}

std::optional<SignedDistance> gap(const Placed &a, const Placed &b) {
  fcl::DistanceRequestd request(true);
  request.gjk_solver_type = solver;
  request.distance_tolerance = solver_tolerance;
  fcl::DistanceResultd result;
  const double distance = fcl::distance(a.geometry, a.pose, b.geometry, b.pose, request, result);
  if (!(distance > 0.0)) return std::nullopt;
  SignedDistance answer;
  answer.distance = distance;
  answer.point_a = vector(result.nearest_points[0]);
  answer.point_b = vector(result.nearest_points[1]);
  answer.normal = normalized(answer.point_a - answer.point_b);
  return answer;
}

LibraryShape *make_shape(const Shape &shape) {
  try {
    auto geometry = fcl_geometry(shape);
    if (!geometry) return nullptr;
    geometry->computeLocalAABB();
    return new FclShape(std::move(geometry));
  } catch (...) {
    return nullptr;  // FCL refuses the shape
  }
}

bool distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, SignedDistance &answer) {
  if (!a.in_library || !b.in_library) return false;
  try {
    const Placed placed_a{static_cast<const FclShape &>(*a.in_library).geometry(), fcl_transform(pose_a)};
    const Placed placed_b{static_cast<const FclShape &>(*b.in_library).geometry(), fcl_transform(pose_b)};
    auto found = overlap(placed_a, placed_b);
    if (!found) found = gap(placed_a, placed_b);
    if (found) answer = *found;
    return found.has_value();
  } catch (...) {
    return false;  // FCL throws where its solver fails
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const cmb::DistanceLibrary cmb_distance_library = {
    CMB_VERSION, sizeof(cmb::Shape), sizeof(cmb::SignedDistance), make_shape, distance};
