// Triangles of polygons that are not convex.
#pragma once

#include <cstddef>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// A file's polygon: its triangles stand in a row, and fan out from its first corner.
struct PolygonFan {
  std::size_t first_triangle = 0, corners = 3;
  std::size_t place = 0;  // where the file has it, as the reader counts
};

// Corners of a polygon whose fan folds over, at most: what follows takes time by their square.
constexpr std::size_t most_folded_corners = 4096;

// Where the fan folds over, as of a concave polygon, puts triangles in its place that do not. The polygon need not be quite
// plane: it is seen along the mean of its normals. False where there are none, as of a border that crosses itself, or where
// there are more than most_folded_corners; the triangles are as they were then. Vertices' numbers are in range.
bool unfold(const PolygonFan &fan, MeshData &data);

}  // namespace cmb::mesh
