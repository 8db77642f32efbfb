// How two sheets pass through each other where two of their triangles cross.
#pragma once

#include <cstdint>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/intersection/triangle_section.hpp"

namespace cmb::mesh {

// Place: the middle of the segment that triangle `t` of `mesh` and `facet` of `body` have in common, in the mesh's frame.
// Depth: what has come through there, the least of that segment's length and of how far each sheet reaches, to the side to which
// it reaches less, beyond the plane of the other one's triangle; 0 where that is at most `enough` (the place is of no use then).
// A sheet reaches as far as its triangles at the corners of the crossing one do, shared among these corners as the place is
// near them. So, other than the depth of two triangles by themselves, this one is not small because sheets cross along an edge
// between triangles; it is where they cross at their borders or hardly touch. `place`: the body's pose in the mesh's frame.
TriangleSection sheet_crossing(const TriangleMesh &mesh, std::uint32_t t, const TriangleMesh &body, std::uint32_t facet,
                               const Pose &place, double enough);

}  // namespace cmb::mesh
