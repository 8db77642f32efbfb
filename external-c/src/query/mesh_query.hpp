// The contact of a shape with a mesh.
#pragma once

#include "manifold/contact_set.hpp"
#include "mesh/contact/mesh_contact.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Room that queries work in; one for each thread.
using MeshQueryScratch = mesh::MeshContactScratch;

// The contact of shape A with mesh B at their poses in the world: appends points, sets distance, normal and witness. Of
// half-spaces, which mesh_halfspace.hpp answers for, nothing.
void mesh_contact(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, MeshQueryScratch &scratch,
                  ContactSet &result);

}  // namespace cmb
