// Shapes and poses as FCL has them.
#pragma once

#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cone.h>
#include <fcl/geometry/shape/convex.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/ellipsoid.h>
#include <fcl/geometry/shape/halfspace.h>
#include <fcl/geometry/shape/sphere.h>

#include <cstdint>
#include <memory>
#include <vector>

#include "shape/shape.hpp"

namespace cmb {

inline std::unique_ptr<fcl::CollisionGeometryd> fcl_hull(const convex::Polytope &polytope) {
  auto vertices = std::make_shared<std::vector<fcl::Vector3d>>();
  for (const Vec3 &v : polytope.vertices()) vertices->emplace_back(v.x, v.y, v.z);
  auto faces = std::make_shared<std::vector<int>>();
  for (const convex::Polytope::Face &face : polytope.faces()) {
    faces->push_back(face.count);
    for (std::int32_t k = 0; k < face.count; ++k) {
      faces->push_back(polytope.face_vertices()[static_cast<std::size_t>(face.first + k)]);
    }
  }
  return std::make_unique<fcl::Convexd>(vertices, static_cast<int>(polytope.faces().size()), faces);
}

// Null for meshes. Throws std::bad_alloc.
inline std::unique_ptr<fcl::CollisionGeometryd> fcl_geometry(const Shape &shape) {
  const Vec3 &half = shape.body.half;
  switch (shape.kind) {
    case ShapeKind::halfspace: return std::make_unique<fcl::Halfspaced>(fcl::Vector3d(0.0, 0.0, 1.0), 0.0);
    case ShapeKind::sphere: return std::make_unique<fcl::Sphered>(shape.body.radius);
    case ShapeKind::capsule: return std::make_unique<fcl::Capsuled>(shape.body.radius, 2.0 * half.z);
    case ShapeKind::box: return std::make_unique<fcl::Boxd>(2.0 * half.x, 2.0 * half.y, 2.0 * half.z);
    case ShapeKind::hull: return fcl_hull(shape.polytope->geometry());
    case ShapeKind::ellipsoid: return std::make_unique<fcl::Ellipsoidd>(half.x, half.y, half.z);
    case ShapeKind::cylinder: return std::make_unique<fcl::Cylinderd>(half.x, 2.0 * half.z);
    case ShapeKind::cone: return std::make_unique<fcl::Coned>(half.x, 2.0 * half.z);
    case ShapeKind::mesh: break;
  }
  return nullptr;
}

inline fcl::Transform3d fcl_transform(const Pose &pose) {
  fcl::Transform3d result = fcl::Transform3d::Identity();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) result.linear()(i, j) = pose.rotation.row[i][j];
    result.translation()(i) = pose.translation[i];
  }
  return result;
}

}  // namespace cmb
