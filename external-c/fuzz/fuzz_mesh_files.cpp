// Fuzz target: any bytes are a mesh or are refused by name; a mesh that passes the check has finite measures and
// answers queries. The first byte chooses the reader.
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <utility>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/io/mesh_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view contents(reinterpret_cast<const char *>(data) + 1, size - 1);
  const std::string source = "input";
  try {
    const auto reader = data[0] % 3 == 0   ? cmb::mesh::read_stl
                        : data[0] % 3 == 1 ? cmb::mesh::read_obj
                                           : cmb::mesh::read_ply;
    cmb::mesh::MeshData read = reader(contents, source);
    for (const auto &triangle : read.triangles) {
      for (const std::uint32_t v : triangle) {
        if (v >= read.vertices.size()) std::abort();
      }
    }
    cmb::mesh::weld_vertices(read, source);
    const cmb::mesh::TriangleMesh mesh(std::move(read), cmb::mesh::MeshUse::any, source);
    if (!std::isfinite(mesh.area()) || !(mesh.mass_properties().volume >= 0.0)) std::abort();
    if (!std::isfinite(mesh.nearest({0.1, 0.2, 0.3}).distance)) std::abort();
  } catch (const cmb::mesh::MeshError &error) {
    if (std::string(error.what()).find("input: ") != 0) std::abort();
  }
  return 0;
}
