// Refusal of triangles that are not the surface of a body.
#pragma once

#include <string>

#include "mesh/mesh_data.hpp"

namespace cmb::mesh {

enum class MeshUse {
  any,    // closed meshes and open sheets
  solid,  // closed meshes with volume only
};

// Makes one of vertices at the same place, in the order of first use; vertices no triangle uses are dropped. Files
// without shared vertices (STL) need it. Corner numbers must be in range (checked: MeshError).
void weld_vertices(MeshData &data, const std::string &source);

// Throws MeshError unless `data` is an oriented manifold surface with or without boundary: finite coordinates, numbers
// in range, no degenerate and no repeated triangle, at most two triangles an edge, in opposite sense, and, where it
// is closed, a positive volume. Self-intersection is not looked for. `source` names the mesh in messages.
void check_mesh(const MeshData &data, MeshUse use, const std::string &source);

}  // namespace cmb::mesh
