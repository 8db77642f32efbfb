#include "mesh/core/mesh_topology.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

namespace cmb::mesh {

std::vector<Side> sorted_sides(const std::vector<Triangle> &triangles) {
  std::vector<Side> sides;
  sides.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t from = triangles[t][k], to = triangles[t][(k + 1) % 3];
      sides.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(t),
                       static_cast<std::uint8_t>(k), from < to});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side &a, const Side &b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

std::vector<std::array<std::int32_t, 3>> triangle_neighbours(const std::vector<Triangle> &triangles) {
  std::vector<std::array<std::int32_t, 3>> neighbours(triangles.size(), {-1, -1, -1});
  const std::vector<Side> sides = sorted_sides(triangles);
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    const Side &a = sides[i], &b = sides[i + 1];
    if (a.low != b.low || a.high != b.high) continue;
    neighbours[a.triangle][a.side] = static_cast<std::int32_t>(b.triangle);
    neighbours[b.triangle][b.side] = static_cast<std::int32_t>(a.triangle);
  }
  return neighbours;
}

std::vector<std::uint32_t> connected_components(const std::vector<std::array<std::int32_t, 3>> &neighbours) {
  constexpr std::uint32_t unknown = UINT32_MAX;
  std::vector<std::uint32_t> component(neighbours.size(), unknown), open;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < neighbours.size(); ++first) {
    if (component[first] != unknown) continue;
    component[first] = count;
    open.push_back(first);
    while (!open.empty()) {
      const std::uint32_t t = open.back();
      open.pop_back();
      for (const std::int32_t other : neighbours[t]) {
        if (other < 0 || component[static_cast<std::size_t>(other)] != unknown) continue;
        component[static_cast<std::size_t>(other)] = count;
        open.push_back(static_cast<std::uint32_t>(other));
      }
    }
    ++count;
  }
  return component;
}

}  // namespace cmb::mesh
