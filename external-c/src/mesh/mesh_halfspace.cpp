#include "mesh/mesh_halfspace.hpp"

#include <limits>
#include <utility>

#include "convex/convex_hull.hpp"
#include "scene/shape.hpp"

namespace cmb::mesh {

std::shared_ptr<const ContactPolytope> mesh_hull(const TriangleMesh &mesh) {
  convex::Polytope geometry;
  if (!convex::build_convex_hull(mesh.vertices(), geometry, nullptr, nullptr)) return nullptr;
  return std::make_shared<const ContactPolytope>(std::move(geometry));
}

void mesh_halfspace_contact(const TriangleMesh &mesh, const std::shared_ptr<const ContactPolytope> &hull,
                            const Pose &pose, const Plane &plane, ContactSet &result) {
  if (hull) {
    Shape shape;
    shape.kind = ShapeKind::hull;
    shape.body = convex::make_polytope(hull->geometry());
    shape.polytope = hull;
    halfspace_contact(shape, pose, plane, result);
    return;
  }
  const double weight = 1.0 / static_cast<double>(mesh.vertices().size());
  result.distance = std::numeric_limits<double>::infinity();
  result.normal = plane.normal;
  for (const Vec3 &vertex : mesh.vertices()) {
    const Vec3 p = pose(vertex);
    const double height = dot(plane.normal, p) - plane.offset;
    if (height < 0.0) result.points.push_back({-height, weight, plane.normal, p - (0.5 * height) * plane.normal});
    if (height < result.distance) {
      result.distance = height;
      result.witness = p - (0.5 * height) * plane.normal;
    }
  }
}

}  // namespace cmb::mesh
