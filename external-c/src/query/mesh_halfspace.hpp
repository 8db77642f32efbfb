// Contact of a mesh with a half-space.
#pragma once

#include "manifold/contact_set.hpp"
#include "manifold/halfspace_manifold.hpp"
#include "shape/shape.hpp"

namespace cmb {

// Appends the contact of a mesh, placed by `pose`, with a half-space, the second body; sets distance, normal and
// witness. Of a mesh a half-space can touch its convex hull only, whose corners carry as those of any polytope
// (halfspace_contact); of a plane mesh, which has no hull, all vertices carry in equal parts.
void mesh_halfspace_contact(const Shape &shape, const Pose &pose, const Plane &plane, ContactSet &result);

}  // namespace cmb
