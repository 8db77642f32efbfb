#include "mesh/core/height_field.hpp"

#include <cmath>

namespace cmb::mesh {

MeshData height_field(std::size_t columns, std::size_t rows, double spacing_x, double spacing_y,
                      const std::vector<double> &heights, const std::string &source) {
  if (columns < 2 || rows < 2) throw MeshError(source, "fewer than 2 x 2 heights", "give at least one cell");
  // Each factor first, or the product might overflow.
  if (columns > MeshLimits::triangles || rows > MeshLimits::triangles ||
      2 * (columns - 1) > MeshLimits::triangles / (rows - 1)) {
    throw MeshError(source, "more than " + std::to_string(MeshLimits::triangles) + " triangles", "use a coarser grid");
  }
  if (heights.size() != columns * rows) {
    throw MeshError(source, std::to_string(heights.size()) + " heights where " + std::to_string(columns) + " x " +
                                std::to_string(rows) + " are " + std::to_string(columns * rows),
                    "give one height for each column and row, row by row");
  }
  if (!(spacing_x > 0.0 && spacing_y > 0.0 && std::isfinite(spacing_x) && std::isfinite(spacing_y))) {
    throw MeshError(source, "a spacing that is not positive", "give the distance of columns and of rows in metres");
  }
  MeshData data;
  data.vertices.reserve(heights.size());
  data.triangles.reserve(2 * (columns - 1) * (rows - 1));
  const double middle_x = 0.5 * static_cast<double>(columns - 1), middle_y = 0.5 * static_cast<double>(rows - 1);
  for (std::size_t j = 0; j < rows; ++j) {
    for (std::size_t i = 0; i < columns; ++i) {
      const double height = heights[j * columns + i];
      if (!std::isfinite(height)) {
        throw MeshError(source, "height " + std::to_string(j * columns + i + 1) + " is not a finite number",
                        "replace it by a height in metres");
      }
      data.vertices.push_back({(static_cast<double>(i) - middle_x) * spacing_x,
                               (static_cast<double>(j) - middle_y) * spacing_y, height});
    }
  }
  for (std::size_t j = 0; j + 1 < rows; ++j) {
    for (std::size_t i = 0; i + 1 < columns; ++i) {
      const auto a = static_cast<std::uint32_t>(j * columns + i), b = a + 1;
      const auto d = static_cast<std::uint32_t>((j + 1) * columns + i), c = d + 1;
      const double rise_ac = std::fabs(heights[a] - heights[c]), rise_bd = std::fabs(heights[b] - heights[d]);
      const bool along_ac = rise_ac != rise_bd ? rise_ac < rise_bd : heights[a] + heights[c] >= heights[b] + heights[d];
      if (along_ac) {
        data.triangles.push_back({a, b, c});
        data.triangles.push_back({a, c, d});
      } else {
        data.triangles.push_back({a, b, d});
        data.triangles.push_back({b, c, d});
      }
    }
  }
  return data;
}

}  // namespace cmb::mesh
