// The files that descriptors name.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh/core/mesh_data.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "shape/contact_polytope.hpp"

namespace cmb {

// Reads files within one folder, each once. One for each scene that is made; not shared by threads.
class GeometryFiles {
 public:
  // No folder: every file is refused.
  GeometryFiles() = default;
  // `folder`: what file names are relative to, and what no file may lie outside of, links resolved.
  explicit GeometryFiles(const std::string &folder) : folder_(folder), allowed_(!folder.empty()) {}

  // Vertices and triangles of an STL, OBJ or PLY file; nothing is checked but that numbers are in range. Throws
  // mesh::MeshError, std::bad_alloc. The reference lives as long as this.
  const mesh::MeshData &mesh_data(std::string_view name);

  // A checked mesh and, where it is closed and convex, its polytope (convex_mesh.hpp).
  struct Solid {
    std::shared_ptr<const mesh::TriangleMesh> mesh;
    std::shared_ptr<const ContactPolytope> hull;
  };
  // Of such a file, coordinates multiplied by `scale`; the same objects for the same file and scale.
  const Solid &solid(std::string_view name, double scale);

  // A text file of numbers: a line a row, numbers separated by blanks, tabs, commas or semicolons; empty lines, and
  // lines that begin with #, are passed over. Throws mesh::MeshError where rows differ in length.
  struct Table {
    std::size_t columns = 0, rows = 0;
    std::vector<double> values;  // row by row
  };
  const Table &table(std::string_view name);

 private:
  // The file's place, within the folder.
  std::string resolve(std::string_view name) const;

  std::filesystem::path folder_;
  bool allowed_ = false;
  std::map<std::string, mesh::MeshData> mesh_data_;
  std::map<std::pair<std::string, double>, Solid> solids_;
  std::map<std::string, Table> tables_;
};

}  // namespace cmb
