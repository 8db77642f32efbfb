// Refusal of triangles that are not the surface of a body.
#pragma once

#include <string>
#include <vector>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

enum class MeshUse {
  any,    // closed meshes and open sheets
  solid,  // closed meshes with volume only
};

// Throw MeshError for a coordinate that is not finite or farther than 1e9 m away, and for points (one at least) that all lie
// within 1e-9 m: where squares of squares of lengths underflow, contacts are not told apart any more.
void check_coordinates(const std::vector<Vec3> &vertices, const std::string &source);
void check_extent(const std::vector<Vec3> &vertices, const std::string &source);

// Makes one of vertices at the same place, in the order of first use; vertices no triangle uses are dropped. Files
// without shared vertices (STL) need it. Corner numbers must be in range (checked: MeshError).
void weld_vertices(MeshData &data, const std::string &source);

// Throws MeshError unless `data` is an oriented manifold surface with or without boundary: finite coordinates, sizes
// and numbers in range, no degenerate triangle (of sides below 1e-12 m, or nearly on a line) and no repeated one, at most
// two triangles an edge, in opposite sense, and, where it is closed, a positive volume. Self-intersection is not looked
// for. `source` names the mesh in messages.
void check_mesh(const MeshData &data, MeshUse use, const std::string &source);

}  // namespace cmb::mesh
