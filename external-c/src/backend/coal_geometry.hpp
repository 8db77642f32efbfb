// Shapes and poses as coal has them.
#pragma once

#include <coal/shape/convex.h>
#include <coal/shape/geometric_shapes.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "shape/shape.hpp"

namespace cmb {

// coal's polygons are triangles here: faces of more corners are cut into fans.
inline std::unique_ptr<coal::CollisionGeometry> coal_hull(const convex::Polytope &polytope) {
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

// Null for meshes. Throws std::bad_alloc and what coal throws.
inline std::unique_ptr<coal::CollisionGeometry> coal_geometry(const Shape &shape) {
  const Vec3 &half = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::halfspace: return std::make_unique<coal::Halfspace>(coal::Vec3s(0.0, 0.0, 1.0), 0.0);
    case ShapeKind::sphere: return std::make_unique<coal::Sphere>(shape.body.radius);
    case ShapeKind::capsule: return std::make_unique<coal::Capsule>(shape.body.radius, 2.0 * half.z);
    case ShapeKind::box: return std::make_unique<coal::Box>(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
    case ShapeKind::hull: return coal_hull(shape.polytope->geometry());
    case ShapeKind::ellipsoid: return std::make_unique<coal::Ellipsoid>(half.x, half.y, half.z);
    case ShapeKind::cylinder: return std::make_unique<coal::Cylinder>(half.x, 2.0 * half.z);
    case ShapeKind::cone: return std::make_unique<coal::Cone>(half.x, 2.0 * half.z);
    case ShapeKind::mesh: break;
  }
  return nullptr;
}

inline coal::Transform3s coal_transform(const Pose &pose) {
  coal::Matrix3s rotation;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) rotation(i, j) = pose.rotation.row[i][j];
  }
  return {rotation, coal::Vec3s(pose.translation.x, pose.translation.y, pose.translation.z)};
}

}  // namespace cmb
