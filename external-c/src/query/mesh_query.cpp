#include "query/mesh_query.hpp"

#include "mesh/core/triangle_mesh.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

void mesh_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, MeshQueryScratch &scratch,
                  ContactSet &result) {
  const mesh::TriangleMesh &mesh = *b.mesh;
  switch (pair_entry(a, b).method) {
    case PairMethod::sphere_mesh:
      mesh::sphere_contact(pose_a.translation, a.body.radius, mesh, pose_b, scratch, result);
      return;
    case PairMethod::capsule_mesh:
      mesh::capsule_contact(a.body.radius, 2.0 * a.body.half.z, pose_a, mesh, pose_b, scratch, result);
      return;
    case PairMethod::polytope_mesh:
      mesh::polytope_contact(a.polytope->geometry(), pose_a, mesh, pose_b, scratch, result);
      return;
    case PairMethod::round_mesh:
      mesh::smooth_contact(a.body, pose_a, mesh, pose_b, scratch, result);
      return;
    case PairMethod::mesh_mesh:
      mesh::mesh_pair_contact(*a.mesh, pose_a, mesh, pose_b, scratch, result);
      return;
    default: return;
  }
}

}  // namespace cmb
