// The convex hull of a mesh.
#pragma once

#include <memory>

#include "mesh/core/triangle_mesh.hpp"
#include "shape/contact_polytope.hpp"

namespace cmb {

// Null where all vertices lie in a plane. Of meshes with more than 8192 vertices those count that lie farthest in some of
// 8192 directions spread evenly: the hull of finer ones is cut by less than a part in a thousand of their size. Allocates.
std::shared_ptr<const ContactPolytope> make_mesh_hull(const mesh::TriangleMesh &mesh);

}  // namespace cmb
