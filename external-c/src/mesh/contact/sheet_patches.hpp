// What the triangles of one sheet push of another one.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/contact/patch_load.hpp"
#include "mesh/core/placed_vertices.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/wedges/triangle_wedge.hpp"
#include "mesh/intersection/mesh_crossings.hpp"

namespace cmb::mesh {

// Room for pairs of triangles; grows in the first calls. What was found carries the number of its query, so that nothing
// has to be cleared.
struct SheetPatchScratch {
  struct SeenPair {
    TrianglePairNumbers pair;
    std::uint32_t query;
  };
  struct KnownWedge {
    std::uint32_t number, query;
  };
  std::uint32_t query = 0;
  std::vector<TrianglePairNumbers> open;  // still to be looked at
  std::vector<SeenPair> seen;             // a hash table of pairs that were looked at
  std::size_t seen_count = 0;
  std::vector<KnownWedge> wedge_of;       // by triangle: its place in `wedges`
  std::vector<TriangleWedge> wedges;
};

// Pushes to `load` every piece of the surface of `body` that lies in the wedge of a triangle of `mesh`. `place` is the
// body's pose in the mesh's frame, `vertices` are its vertices there.
//
// The search begins where the surfaces cross and follows both meshes from neighbour to neighbour: pieces in
// neighbouring wedges, or of neighbouring facets, hang together. So it takes as long as there are pieces, however deep
// they lie, and finds none of a surface that crosses nowhere.
void push_sheet_patches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PlacedVertices &vertices,
                        const Crossings &crossings, SheetPatchScratch &scratch, PatchScratch &patch_scratch, PatchLoad &load);

}  // namespace cmb::mesh
