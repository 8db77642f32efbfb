#include "query/mesh_query.hpp"

#include "mesh/core/triangle_mesh.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

namespace {

// Of polytopes with more corners, given as meshes, the triangles are asked what they do: the overlap of all corners with all
// triangles takes too long (200 corners on a height field 6 times as long, on a torus 10 times).
constexpr std::size_t most_corners = 64;

}  // namespace

void mesh_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, MeshQueryScratch &scratch,
                  ContactSet &result) {
  const mesh::TriangleMesh &mesh = *b.mesh;
  switch (pair_entry(a, b).method) {
    case PairMethod::sphere_mesh:
      mesh::sphere_contact(pose_a.translation, a.body.radius, mesh, pose_b, scratch, result);
      return;
    case PairMethod::polytope_mesh:
      if (a.mesh && a.polytope->geometry().vertices().size() > most_corners) {
        if (mesh::mesh_pair_touch(*a.mesh, pose_a, mesh, pose_b, scratch, result)) return;
        mesh::polytope_clearance(a.polytope->geometry(), pose_a, mesh, pose_b, scratch, result);
        return;
      }
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
