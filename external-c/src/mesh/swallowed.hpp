// Bodies that lie wholly inside a closed mesh.
#pragma once

#include "manifold/contact_set.hpp"
#include "mesh/triangle_mesh.hpp"

namespace cmb::mesh {

// Where the mesh is closed and holds `place`, a point of a body whose surface meets none of the mesh's: one point of
// weight 1 that pushes towards the nearest place of the mesh, and true. Sets distance, normal and witness of `result`.
bool swallowed_contact(const Vec3 &place, const TriangleMesh &mesh, const Pose &pose, ContactSet &result);

}  // namespace cmb::mesh
