// Closed convex meshes as polytopes.
#pragma once

#include <memory>

#include "mesh/core/triangle_mesh.hpp"
#include "shape/contact_polytope.hpp"

namespace cmb {

// Places of a mesh count as rounded by so much, relative to the radius of its bounding sphere: single precision keeps 6e-8 of a
// coordinate, and a place is off the plane of three others by a few of these.
constexpr double mesh_rounding = 2e-7;

// The hull of a mesh's vertices where the mesh is closed and its surface is the hull's to rounding: where all of it lies within
// that distance of the hull's faces, once. Triangles of one plane, to rounding, are one face, and corners lie where faces meet.
// Null of any other mesh, and of those with more than 8192 vertices. Deterministic. Allocates.
std::shared_ptr<const ContactPolytope> make_convex_mesh_hull(const mesh::TriangleMesh &mesh);

}  // namespace cmb
