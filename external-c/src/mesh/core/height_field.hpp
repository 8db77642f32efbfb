// Ground given by heights over a grid.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// The open mesh of a grid centred at the origin, front towards +z: vertex (column i, row j) lies at
// x = (i - (columns - 1)/2) spacing_x, y likewise, z = heights[j columns + i]. Each cell is cut along the diagonal
// whose ends differ less in height, so that ridges and valleys stay whole, or the higher one. MeshError, naming `source`, where there are
// fewer than 2 x 2 heights or too many, where their number is not columns * rows, or where a number is not finite or a
// spacing not positive.
MeshData height_field(std::size_t columns, std::size_t rows, double spacing_x, double spacing_y,
                      const std::vector<double> &heights, const std::string &source);

}  // namespace cmb::mesh
