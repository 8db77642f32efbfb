// Contact of a mesh with a half-space.
#pragma once

#include <memory>

#include "geometry/contact_polytope.hpp"
#include "manifold/contact_set.hpp"
#include "manifold/halfspace_manifold.hpp"
#include "mesh/triangle_mesh.hpp"

namespace cmb::mesh {

// The convex hull of the mesh, null where all vertices lie in a plane. Of a mesh a half-space can touch nothing else.
std::shared_ptr<const ContactPolytope> mesh_hull(const TriangleMesh &mesh);

// Appends the contact of the mesh, placed by `pose`, with a half-space, the second body. The corners of its hull carry,
// as those of any polytope (halfspace_contact); where `hull` is null, all vertices, in equal parts.
void mesh_halfspace_contact(const TriangleMesh &mesh, const std::shared_ptr<const ContactPolytope> &hull,
                            const Pose &pose, const Plane &plane, ContactSet &result);

}  // namespace cmb::mesh
