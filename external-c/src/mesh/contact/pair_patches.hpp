// What the triangles of one mesh push of another's surface.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/contact/patch_load.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/intersection/pierced_load.hpp"

namespace cmb::mesh {

// Room for pairs of triangles; grows in the first calls. What was found carries the number of its query, so that nothing
// has to be cleared.
struct PairScratch {
  struct Pair {
    std::uint32_t triangle, facet;
  };
  struct Cut {
    Pair pair;
    double depth;  // m, how deep the triangle's plane cuts into the facet
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
  std::vector<Cut> cuts;               // the pairs that may cross
  std::vector<Pair> open;              // still to be looked at
  std::vector<SeenPair> seen;          // a hash table of pairs that were looked at
  std::size_t seen_count = 0;
  std::vector<PlacedVertex> vertices;  // of the body
  std::vector<KnownWedge> wedge_of;    // by triangle: its place in `wedges`
  std::vector<TriangleWedge> wedges;
};

// Triangles that cross by no more than this do so by rounding, and those as far apart (m) may cross.
double rounding_of_crossings(const TriangleMesh &a, const TriangleMesh &b);

// Pushes to `load` every piece of the surface of `body` that lies in the wedge of a triangle of `mesh`. `place` is the
// body's pose in the mesh's frame.
//
// The search begins where the surfaces cross and follows both meshes from neighbour to neighbour: pieces in
// neighbouring wedges, or of neighbouring facets, hang together. So it takes as long as there are pieces, however deep
// they lie, and finds none of a surface that crosses nowhere.
// Leaves in `scratch` the pairs of triangles that may cross, for the functions below.
void push_pair_patches(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, PairScratch &scratch,
                       PatchScratch &patch_scratch, PatchLoad &load);

// The depth of the deepest crossing of two triangles (triangle_crossing), 0 where that is at most `enough`.
double deepest_crossing(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PairScratch &scratch,
                        double enough);

// Adds every crossing of two triangles to `load`; the triangles of `mesh` push.
void push_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PairScratch &scratch,
                    PiercedLoad &load);

// The sum of the depths of all crossings with a sheet (sheet_crossing) deeper than `negligible`; as soon as it is more than
// `enough`, any sum more than that.
double depths_of_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PairScratch &scratch,
                           double negligible, double enough);

// Adds every crossing of two sheets (sheet_crossing) deeper than `enough` to `load`, where the triangles of `mesh` push, and to
// `reaction`, in the body's frame, where those of `body` do.
void push_sheet_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place,
                          const PairScratch &scratch, double enough, PiercedLoad &load, PiercedLoad &reaction);

}  // namespace cmb::mesh
