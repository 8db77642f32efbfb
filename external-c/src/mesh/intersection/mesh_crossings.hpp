// Which triangles of two meshes cross, and how deep.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/core/placed_vertices.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "mesh/intersection/pierced_load.hpp"

namespace cmb::mesh {

// A triangle of the mesh and one of the body.
struct TrianglePairNumbers {
  std::uint32_t triangle, facet;
};

// Pairs of triangles that may cross; room that grows in the first calls.
struct Crossings {
  struct Cut {
    TrianglePairNumbers pair;
    double depth;  // m, how deep the triangle's plane cuts into the facet
  };
  std::vector<Cut> cuts;
};

// Triangles that cross by no more than this do so by rounding, and those as far apart (m) may cross.
double rounding_of_crossings(const TriangleMesh &a, const TriangleMesh &b);

// In what follows `place` is the pose of `body` in the frame of `mesh`.

// Finds them all.
void find_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const PlacedVertices &vertices,
                    Crossings &crossings);

// Whether some of these pairs meet, or as good as do.
bool any_meet(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings);

// The depth of the deepest crossing of two triangles (triangle_crossing), 0 where that is at most `enough`.
double deepest_crossing(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings, double enough);

// Adds every crossing of two triangles to `load`; the triangles of `mesh` push.
void push_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings, PiercedLoad &load);

// The sum of the depths of all crossings with a sheet (sheet_crossing) deeper than `negligible`; as soon as it is more than
// `enough`, any sum more than that.
double depths_of_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings,
                           double negligible, double enough);

// Adds every crossing of two sheets (sheet_crossing) deeper than `enough` to `load`, where the triangles of `mesh` push, and to
// `reaction`, in the body's frame, where those of `body` do.
void push_sheet_crossings(const TriangleMesh &mesh, const TriangleMesh &body, const Pose &place, const Crossings &crossings,
                          double enough, PiercedLoad &load, PiercedLoad &reaction);

}  // namespace cmb::mesh
