#include "query/mesh_query.hpp"

#include "mesh/core/triangle_mesh.hpp"

namespace cmb {

void mesh_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, MeshQueryScratch &scratch,
                  ContactSet &result) {
  const mesh::TriangleMesh &mesh = *b.mesh;
  switch (a.kind) {
    case ShapeKind::sphere:
      mesh::sphere_contact(pose_a.translation, a.body.radius, mesh, pose_b, scratch, result);
      return;
    case ShapeKind::capsule:
      mesh::capsule_contact(a.body.radius, 2.0 * a.body.half.z, pose_a, mesh, pose_b, scratch, result);
      return;
    case ShapeKind::box:
    case ShapeKind::hull:
      mesh::polytope_contact(a.polytope->geometry(), pose_a, mesh, pose_b, scratch, result);
      return;
    case ShapeKind::ellipsoid:
    case ShapeKind::cylinder:
    case ShapeKind::cone:
      mesh::smooth_contact(a.body, pose_a, mesh, pose_b, scratch, result);
      return;
    case ShapeKind::mesh:
      mesh::mesh_pair_contact(*a.mesh, pose_a, mesh, pose_b, scratch, result);
      return;
    case ShapeKind::halfspace:
      return;
  }
}

}  // namespace cmb
