#include "query/mesh_halfspace.hpp"

#include <limits>

#include "mesh/core/triangle_mesh.hpp"

namespace cmb {

void mesh_halfspace_contact(const Shape &shape, const Pose &pose, const Plane &plane, ContactSet &result) {
  if (shape.mesh_hull) {
    Shape hull;
    hull.kind = ShapeKind::hull;
    hull.body = convex::make_polytope(shape.mesh_hull->geometry());
    hull.polytope = shape.mesh_hull;
    halfspace_contact(hull, pose, plane, result);
    return;
  }
  const std::vector<Vec3> &vertices = shape.mesh->vertices();
  const double weight = 1.0 / static_cast<double>(vertices.size());
  result.distance = std::numeric_limits<double>::infinity();
  result.normal = plane.normal;
  for (const Vec3 &vertex : vertices) {
    const Vec3 p = pose(vertex);
    const double height = dot(plane.normal, p) - plane.offset;
    if (height < 0.0) result.points.push_back({-height, weight, plane.normal, p - (0.5 * height) * plane.normal});
    if (height < result.distance) {
      result.distance = height;
      result.witness = p - (0.5 * height) * plane.normal;
    }
  }
}

}  // namespace cmb
