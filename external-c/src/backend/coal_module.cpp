// coal behind the engine's interface; a module of its own, loaded by coal_backend.cpp.
#include "backend/coal_module.hpp"

#include <coal/distance.h>
#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>

#include <memory>

namespace {

using cmb::ConvexAnswer;
using cmb::Pose;
using cmb::Shape;
using cmb::ShapeKind;
using cmb::Vec3;

std::unique_ptr<coal::CollisionGeometry> hull_geometry(const cmb::convex::Polytope &polytope) {
  auto vertices = std::make_shared<std::vector<coal::Vec3s>>();
  auto triangles = std::make_shared<std::vector<coal::Triangle>>();
  for (const Vec3 &v : polytope.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  for (const auto &face : polytope.faces()) {
    const auto corner = [&](std::int32_t k) {
      return static_cast<std::size_t>(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
    };
    for (std::int32_t k = 1; k + 1 < face.count; ++k) triangles->emplace_back(corner(0), corner(k), corner(k + 1));
  }
  const auto vertex_count = static_cast<unsigned>(vertices->size());
  const auto triangle_count = static_cast<unsigned>(triangles->size());
  return std::make_unique<coal::Convex<coal::Triangle>>(vertices, vertex_count, triangles, triangle_count);
}

std::unique_ptr<coal::CollisionGeometry> geometry(const Shape &shape) {
  const Vec3 &half = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::sphere: return std::make_unique<coal::Sphere>(shape.body.radius);
    case ShapeKind::capsule: return std::make_unique<coal::Capsule>(shape.body.radius, 2.0 * half.z);
    case ShapeKind::box: return std::make_unique<coal::Box>(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
    case ShapeKind::hull: return hull_geometry(shape.polytope->geometry());
    case ShapeKind::ellipsoid: return std::make_unique<coal::Ellipsoid>(half.x, half.y, half.z);
    case ShapeKind::cylinder: return std::make_unique<coal::Cylinder>(half.x, 2.0 * half.z);
    case ShapeKind::cone: return std::make_unique<coal::Cone>(half.x, 2.0 * half.z);
    default: return nullptr;
  }
}

coal::Transform3s transform(const Pose &pose) {
  coal::Matrix3s rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = pose.rotation.row[i][j];
  }
  return {rotation, coal::Vec3s(pose.translation.x, pose.translation.y, pose.translation.z)};
}

Vec3 vector(const coal::Vec3s &v) { return {v.x(), v.y(), v.z()}; }

}  // namespace

extern "C" __attribute__((visibility("default"))) bool cmb_coal_distance(const Shape &a, const Pose &pose_a,
                                                                         const Shape &b, const Pose &pose_b,
                                                                         ConvexAnswer &answer) {
  try {
    const auto geometry_a = geometry(a), geometry_b = geometry(b);
    if (!geometry_a || !geometry_b) return false;
    const coal::DistanceRequest request(true, true);
    coal::DistanceResult result;
    coal::distance(geometry_a.get(), transform(pose_a), geometry_b.get(), transform(pose_b), request, result);
    answer.distance = result.min_distance;
    answer.normal = -vector(result.normal);  // coal's points from the first shape to the second
    answer.point_a = vector(result.nearest_points[0]);
    answer.point_b = vector(result.nearest_points[1]);
    return true;
  } catch (...) {
    return false;
  }
}
