// The module with coal.
#include "backend/distance_library.hpp"

#include <coal/distance.h>

#include <memory>
#include <utility>

#include "backend/coal_geometry.hpp"

namespace {

using cmb::SignedDistance;
using cmb::LibraryShape;
using cmb::Pose;
using cmb::Shape;
using cmb::Vec3;

class CoalShape : public LibraryShape {
 public:
  explicit CoalShape(std::unique_ptr<const coal::CollisionGeometry> geometry) : geometry_(std::move(geometry)) {}
  const coal::CollisionGeometry *geometry() const { return geometry_.get(); }

 private:
  std::unique_ptr<const coal::CollisionGeometry> geometry_;
};

Vec3 vector(const coal::Vec3s &v) { return {v.x(), v.y(), v.z()}; }

LibraryShape *make_shape(const Shape &shape) {
  try {
    auto geometry = cmb::coal_geometry(shape);
    return geometry ? new CoalShape(std::move(geometry)) : nullptr;
  } catch (...) {
    return nullptr;
  }
}

bool distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, SignedDistance &answer) {
  if (!a.in_library || !b.in_library) return false;
  try {
    const coal::DistanceRequest request(true, true);
    coal::DistanceResult result;
    coal::distance(static_cast<const CoalShape &>(*a.in_library).geometry(), cmb::coal_transform(pose_a),
                   static_cast<const CoalShape &>(*b.in_library).geometry(), cmb::coal_transform(pose_b), request, result);
    answer.distance = result.min_distance;
    answer.normal = -vector(result.normal);  // coal's points from the first shape to the second
    answer.point_a = vector(result.nearest_points[0]);
    answer.point_b = vector(result.nearest_points[1]);
    return true;
  } catch (...) {
    return false;
  }
}

}  // namespace

extern "C" __attribute__((visibility("default"))) const cmb::DistanceLibrary cmb_distance_library = {
    CMB_VERSION, sizeof(cmb::Shape), sizeof(cmb::SignedDistance), make_shape, distance};
