// Which triangles share an edge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// A side of a triangle: from corner `side` to the next one.
struct Side {
  std::uint32_t low = 0, high = 0;  // the edge's vertices, low < high
  std::uint32_t triangle = 0;
  std::uint8_t side = 0;
  bool ascending = false;  // whether the triangle runs from low to high
};

// All sides, sorted by edge, then triangle. Corners of every triangle must differ.
std::vector<Side> sorted_sides(const std::vector<Triangle> &triangles);

// neighbours[t][k]: the triangle beyond side k of triangle t, or -1. Every edge has at most two sides.
std::vector<std::array<std::int32_t, 3>> triangle_neighbours(const std::vector<Triangle> &triangles);

// Of each triangle the number of what it hangs together with by edges, from 0, in the order of the triangles.
std::vector<std::uint32_t> connected_components(const std::vector<std::array<std::int32_t, 3>> &neighbours);

}  // namespace cmb::mesh
