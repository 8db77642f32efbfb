// Mesh files.
#pragma once

#include <string>
#include <string_view>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// The readers take a file's whole contents; `source` names it in messages. Numbers are taken as metres. They throw
// MeshError for anything that is not such a file, and std::bad_alloc. Polygons are cut into triangles, concave ones too
// (polygon_split.hpp). No size that a file claims is believed before the bytes are there. What
// they return has numbers in range, but no other check: see check_mesh.
MeshData read_stl(std::string_view contents, const std::string &source);  // ASCII and binary; vertices are not shared
MeshData read_obj(std::string_view contents, const std::string &source);  // v and f; all else is passed over
MeshData read_ply(std::string_view contents, const std::string &source);  // ASCII and binary of both byte orders

// The whole contents of a regular file. Files of more than MeshLimits::file_bytes are refused. Throws MeshError.
std::string read_whole_file(const std::string &path);

// Reads the file, by its name's ending (.stl, .obj, .ply, any case), and shares vertices at the same place.
MeshData read_mesh_file(const std::string &path);

}  // namespace cmb::mesh
