// Meshes as descriptor text.
#pragma once

#include <cstdio>
#include <string>

#include "mesh_samples.hpp"

namespace mesh_samples {

// The descriptor of the mesh, coordinates with all their digits.
inline std::string mesh_text(const MeshData &data) {
  std::string text = "cmb/1 mesh vertices=";
  char number[32];
  for (std::size_t v = 0; v < data.vertices.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      std::snprintf(number, sizeof number, "%s%.17g", v + static_cast<std::size_t>(k) > 0 ? "," : "", data.vertices[v][k]);
      text += number;
    }
  }
  text += " triangles=";
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) text += (t + k > 0 ? "," : "") + std::to_string(data.triangles[t][k] + 1);
  }
  return text;
}

// A height field of full lengths `size`, z = height(x, y).
template <typename Height>
std::string height_field_text(double size, std::size_t n, Height &&height) {
  std::string text = "cmb/1 heightfield size=" + std::to_string(size) + "," + std::to_string(size) +
                     " grid=" + std::to_string(n) + "," + std::to_string(n) + " heights=";
  char number[32];
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const auto place = [&](std::size_t k) { return size * (static_cast<double>(k) / static_cast<double>(n - 1) - 0.5); };
      std::snprintf(number, sizeof number, "%s%.17g", i + j > 0 ? "," : "", height(place(i), place(j)));
      text += number;
    }
  }
  return text;
}

}  // namespace mesh_samples
