#include "scene/geometry_files.hpp"

#include <algorithm>
#include <cmath>
#include <system_error>
#include <utility>

#include "mesh/io/mesh_file.hpp"
#include "mesh/io/number_text.hpp"
#include "scene/convex_mesh.hpp"

namespace cmb {

using convex::Vec3;
using mesh::MeshError;

std::string GeometryFiles::resolve(std::string_view name) const {
  const std::string shown(name);
  if (name.empty()) throw MeshError("file", "the name is empty", "give the file's name");
  if (!allowed_) {
    throw MeshError(shown, "no folder is given that files may be read from",
                    "name a folder where the scene is interned, or give vertices and triangles");
  }
  if (name.substr(0, 11) == "modelica://") {
    throw MeshError(shown, "a name that only Modelica tools resolve",
                    "give the file by Modelica.Utilities.Files.loadResource");
  }
  std::error_code error;
  const std::filesystem::path folder = std::filesystem::canonical(folder_, error);
  if (error) throw MeshError(shown, "the folder " + folder_.string() + " cannot be read", "check the folder's name");
  const std::filesystem::path path = std::filesystem::weakly_canonical(folder / std::filesystem::path(shown), error);
  if (error) throw MeshError(shown, "not a file name", "check the name");
  const auto [folder_end, path_end] = std::mismatch(folder.begin(), folder.end(), path.begin(), path.end());
  if (folder_end != folder.end() || path_end == path.end()) {
    throw MeshError(shown, "lies outside of the folder " + folder.string(), "copy it into that folder");
  }
  return path.string();
}

const mesh::MeshData &GeometryFiles::mesh_data(std::string_view name) {
  const std::string path = resolve(name);
  const auto known = mesh_data_.find(path);
  if (known != mesh_data_.end()) return known->second;
  return mesh_data_.emplace(path, mesh::read_mesh_file(path)).first->second;
}

const GeometryFiles::Solid &GeometryFiles::solid(std::string_view name, double scale) {
  const std::string path = resolve(name);
  Solid &known = solids_[{path, scale}];
  if (!known.mesh) {
    mesh::MeshData data = mesh_data(name);
    for (Vec3 &p : data.vertices) p = scale * p;
    known.mesh = std::make_shared<const mesh::TriangleMesh>(std::move(data), mesh::MeshUse::any, path);
    known.hull = make_convex_mesh_hull(*known.mesh);
  }
  return known;
}

namespace {

GeometryFiles::Table parse_table(std::string_view text, const std::string &source) {
  const auto separates = [](char c) { return c == ' ' || c == '\t' || c == ',' || c == ';' || c == '\r'; };
  GeometryFiles::Table table;
  std::size_t line = 0, position = 0;
  while (position < text.size()) {
    const std::size_t end = std::min(text.find('\n', position), text.size());
    ++line;
    const std::string place = source + ", line " + std::to_string(line);
    std::size_t count = 0, i = position;
    const bool comment = text[position] == '#';
    while (i < end && !comment) {
      if (separates(text[i])) {
        ++i;
        continue;
      }
      std::size_t stop = i;
      while (stop < end && !separates(text[stop])) ++stop;
      double value = 0.0;
      if (mesh::parse_number(text.substr(i, stop - i), value) != std::errc() || !std::isfinite(value)) {
        throw MeshError(place, "number " + std::to_string(count + 1) + " is not a finite number",
                        "write heights in metres, separated by blanks or commas");
      }
      if (table.values.size() >= mesh::MeshLimits::vertices) {
        throw MeshError(place, "more than " + std::to_string(mesh::MeshLimits::vertices) + " heights",
                        "use a coarser grid");
      }
      table.values.push_back(value);
      ++count;
      i = stop;
    }
    if (count > 0) {
      if (table.rows > 0 && count != table.columns) {
        throw MeshError(place, std::to_string(count) + " heights where the rows before have " +
                                   std::to_string(table.columns),
                        "give every row as many heights");
      }
      table.columns = count;
      ++table.rows;
    }
    position = end + 1;
  }
  if (table.rows == 0) throw MeshError(source, "no heights", "write a line of heights for each row of the grid");
  return table;
}

}  // namespace

const GeometryFiles::Table &GeometryFiles::table(std::string_view name) {
  const std::string path = resolve(name);
  const auto known = tables_.find(path);
  if (known != tables_.end()) return known->second;
  return tables_.emplace(path, parse_table(mesh::read_whole_file(path), path)).first->second;
}

}  // namespace cmb
