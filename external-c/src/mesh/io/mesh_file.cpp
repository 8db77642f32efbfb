#include "mesh/io/mesh_file.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "mesh/core/mesh_check.hpp"

namespace cmb::mesh {

std::string read_whole_file(const std::string &path) {
  std::error_code error;
  const std::filesystem::file_type type = std::filesystem::status(path, error).type();
  if (type == std::filesystem::file_type::not_found) throw MeshError(path, "no such file", "check the path");
  if (type == std::filesystem::file_type::none) {
    throw MeshError(path, "cannot be read: " + error.message(), "check its name and its permissions");
  }
  if (type == std::filesystem::file_type::directory) throw MeshError(path, "a folder", "name a file in it");
  // Devices and pipes may never end.
  if (type != std::filesystem::file_type::regular) throw MeshError(path, "no regular file", "name a file on a disk");
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) throw MeshError(path, "cannot be read: " + error.message(), "check its permissions");
  if (size > MeshLimits::file_bytes) {
    throw MeshError(path, "larger than 1 GiB", "export with a coarser tolerance, or in a binary format");
  }
  std::ifstream file(path, std::ios::binary);
  std::string contents(static_cast<std::size_t>(size), '\0');
  if (!file.read(contents.data(), static_cast<std::streamsize>(contents.size()))) {
    throw MeshError(path, "cannot be read", "check its permissions");
  }
  return contents;
}

MeshData read_mesh_file(const std::string &path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  const auto reader = ending == ".stl" ? read_stl : ending == ".obj" ? read_obj : ending == ".ply" ? read_ply : nullptr;
  if (reader == nullptr) {
    throw MeshError(path, "the name does not end in .stl, .obj or .ply", "export the mesh in one of these formats");
  }
  MeshData data = reader(read_whole_file(path), path);
  weld_vertices(data, path);
  return data;
}

}  // namespace cmb::mesh
