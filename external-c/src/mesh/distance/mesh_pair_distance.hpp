// Distance of two meshes.
#pragma once

#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

struct TrianglePair {
  double distance = 0.0;       // m, 0 where they meet
  Vec3 on_a, on_b;             // in A's frame
  std::uint32_t a = 0, b = 0;  // the triangles
};

// Distance of triangles given by corners; `a` and `b` of the result are left alone.
TrianglePair triangle_distance(const Vec3 (&a)[3], const Vec3 (&b)[3]);

// Distance of the surfaces of A and B. `b_in_a` is B's pose in A's frame. Neither allocates nor throws.
TrianglePair mesh_pair_distance(const TriangleMesh &a, const TriangleMesh &b, const Pose &b_in_a);

}  // namespace cmb::mesh
