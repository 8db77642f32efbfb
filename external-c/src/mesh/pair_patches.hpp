// What the triangles of one mesh push of another's surface.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/patch_load.hpp"
#include "mesh/triangle_mesh.hpp"

namespace cmb::mesh {

// Room for pairs of triangles; grows in the first calls. What was found carries the number of its query, so that nothing
// has to be cleared.
struct PairScratch {
  struct Pair {
    std::uint32_t triangle, facet;
  };
  struct SeenPair {
    Pair pair;
    std::uint32_t query;
  };
  struct PlacedVertex {
    Vec3 place;  // in the mesh's frame
    std::uint32_t query;
  };
  struct KnownWedge {
    std::uint32_t number, query;
  };
  std::uint32_t query = 0;
  std::vector<Pair> open;              // still to be looked at
  std::vector<SeenPair> seen;          // a hash table of pairs that were looked at
  std::size_t seen_count = 0;
  std::vector<PlacedVertex> vertices;  // of the body
  std::vector<KnownWedge> wedge_of;    // by triangle: its place in `wedges`
  std::vector<TriangleWedge> wedges;
};

// Pushes to `load` every piece of the surface of `body` that lies in the wedge of a triangle of `mesh`. `place` is the
// body's pose in the mesh's frame.
//
// The search begins where the surfaces cross and follows both meshes from neighbour to neighbour: pieces in
// neighbouring wedges, or of neighbouring facets, hang together. So it takes as long as there are pieces, however deep
// they lie, and finds none of a surface that crosses nowhere.
void push_pair_patches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PairScratch &scratch,
                       PatchScratch &patch_scratch, PatchLoad &load);

}  // namespace cmb::mesh
