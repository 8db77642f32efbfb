// The contact of a convex body with a mesh by what its overlap with the mesh's wedges stores.
#pragma once

#include "manifold/contact_set.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/elastic/elastic_points.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

// Appends the overlap's points, of sheets as far as the body's sections let it carry, and what passes through the body; sets distance,
// normal and witness where it touches. Returns false, with no points added, where body and mesh do not touch. `scratch` is overwritten.
bool append_overlap_contact(const WedgeIntegrals &overlap, const SectionedBody &body, const TriangleMesh &mesh, const Pose &pose,
                            ElasticScratch &scratch, ContactSet &result);

}  // namespace cmb::mesh
