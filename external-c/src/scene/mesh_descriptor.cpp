#include "scene/mesh_descriptor.hpp"

#include <cmath>
#include <cstdint>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "mesh/core/height_field.hpp"
#include "mesh/core/mesh_check.hpp"
#include "mesh/core/triangle_mesh.hpp"
#include "scene/convex_mesh.hpp"
#include "shape/convex_hull.hpp"

namespace cmb {

namespace {

using mesh::MeshData;
using mesh::MeshError;
using mesh::MeshUse;
using mesh::TriangleMesh;

// Runs `work`, naming the column in what is wrong with a mesh.
template <typename Work>
decltype(auto) at_column(std::size_t column, Work &&work) {
  try {
    return work();
  } catch (const MeshError &error) {
    throw DescriptorError(column, error.what());
  }
}

// The factor of a file's coordinates, 1 where it is left out.
double parse_scale(Keys &keys) { return keys.has("scale") ? keys.require_lengths("scale", 1)[0] : 1.0; }

std::vector<Vec3> parse_points(Keys &keys, std::size_t &column) {
  const std::vector<Number> numbers = keys.require("vertices");
  column = numbers.front().column;
  if (numbers.size() % 3 != 0) {
    throw DescriptorError(column, "vertices has " + std::to_string(numbers.size()) +
                                      " numbers; give three a point: x,y,z,x,y,z,...");
  }
  std::vector<Vec3> points;
  points.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) check_coordinate(numbers[i + k], "vertices");
    points.push_back({numbers[i].value, numbers[i + 1].value, numbers[i + 2].value});
  }
  return points;
}

std::vector<mesh::Triangle> parse_triangles(Keys &keys, std::size_t vertices, std::size_t &column) {
  const std::vector<Number> numbers = keys.require("triangles");
  column = numbers.front().column;
  if (numbers.size() % 3 != 0) {
    throw DescriptorError(column, "triangles has " + std::to_string(numbers.size()) +
                                      " numbers; give three vertices a triangle, numbered from 1");
  }
  std::vector<mesh::Triangle> triangles(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double value = numbers[i].value;
    if (!(value >= 1.0 && value <= static_cast<double>(vertices)) || value != std::floor(value)) {
      throw DescriptorError(numbers[i].column, "triangle " + std::to_string(i / 3 + 1) + " names vertex " +
                                                   shortest(value) + "; vertices are numbered from 1 to " +
                                                   std::to_string(vertices));
    }
    triangles[i / 3][i % 3] = static_cast<std::uint32_t>(value) - 1;
  }
  return triangles;
}

void set_hull(std::shared_ptr<const ContactPolytope> polytope, Shape &shape) {
  shape.kind = ShapeKind::hull;
  shape.polytope = std::move(polytope);
  shape.body = convex::make_polytope(shape.polytope->geometry());
}

// A convex mesh is the hull that it encloses.
void set_solid(const GeometryFiles::Solid &solid, Shape &shape) {
  shape.kind = ShapeKind::mesh;
  shape.mesh = solid.mesh;
  if (solid.hull) set_hull(solid.hull, shape);
}

// Two whole numbers of at least 2.
std::pair<std::size_t, std::size_t> parse_grid(Keys &keys) {
  const std::vector<Number> numbers = keys.require("grid");
  Keys::check_count("grid", numbers, 2);
  for (const Number &number : numbers) {
    if (!(number.value >= 2.0 && number.value <= static_cast<double>(mesh::MeshLimits::triangles)) ||
        number.value != std::floor(number.value)) {
      throw DescriptorError(number.column, "grid has " + shortest(number.value) +
                                               "; give the numbers of columns and rows, each at least 2");
    }
  }
  return {static_cast<std::size_t>(numbers[0].value), static_cast<std::size_t>(numbers[1].value)};
}

}  // namespace

void parse_hull(Keys &keys, GeometryFiles &files, Shape &shape) {
  std::vector<Vec3> points;
  std::size_t column = 0;
  std::string source = "vertices";
  if (const auto name = keys.take_text("file")) {
    column = name->column;
    const double scale = parse_scale(keys);
    source = std::string(name->text);
    points = at_column(column, [&] { return files.mesh_data(name->text).vertices; });
    for (Vec3 &p : points) p = scale * p;
  } else {
    points = parse_points(keys, column);
  }
  if (points.size() < 4) {
    throw DescriptorError(column, source + " has " + std::to_string(points.size()) +
                                      " points; a hull needs at least 4 that do not lie in a plane");
  }
  if (points.size() > DescriptorLimits::hull_points) {
    throw DescriptorError(column, source + " has " + std::to_string(points.size()) + " points; at most " +
                                      std::to_string(DescriptorLimits::hull_points) +
                                      " are accepted: simplify the mesh");
  }
  at_column(column, [&] { mesh::check_coordinates(points, source); });
  convex::Polytope polytope;
  std::string problem;
  if (!convex::build_convex_hull(points, polytope, nullptr, &problem)) {
    throw DescriptorError(column,
                          source + ": " + problem + "; give at least 4 points that do not lie in a plane");
  }
  at_column(column, [&] { mesh::check_extent(polytope.vertices(), source); });
  set_hull(std::make_shared<const ContactPolytope>(std::move(polytope)), shape);
}

void parse_mesh(Keys &keys, GeometryFiles &files, Shape &shape) {
  if (const auto name = keys.take_text("file")) {
    const double scale = parse_scale(keys);
    set_solid(at_column(name->column, [&] { return files.solid(name->text, scale); }), shape);
    return;
  }
  if (!keys.has("vertices")) {
    throw DescriptorError(keys.kind().column,
                          "mesh lacks its geometry; add file=NAME, or vertices=... and triangles=...");
  }
  MeshData data;
  std::size_t column = 0;
  data.vertices = parse_points(keys, column);
  data.triangles = parse_triangles(keys, data.vertices.size(), column);
  GeometryFiles::Solid solid;
  solid.mesh = at_column(column, [&] {
    mesh::weld_vertices(data, "mesh");
    return std::make_shared<const TriangleMesh>(std::move(data), MeshUse::any, "mesh");
  });
  solid.hull = make_convex_mesh_hull(*solid.mesh);
  set_solid(solid, shape);
}

void parse_height_field(Keys &keys, GeometryFiles &files, Shape &shape) {
  shape.kind = ShapeKind::mesh;
  const std::vector<double> size = keys.require_lengths("size", 2);
  std::size_t columns = 0, rows = 0, column = 0;
  std::vector<double> heights;
  std::string source = "heightfield";
  if (const auto name = keys.take_text("file")) {
    column = name->column;
    source = std::string(name->text);
    const double scale = parse_scale(keys);
    const GeometryFiles::Table &table = at_column(column, [&]() -> const GeometryFiles::Table & {
      return files.table(name->text);
    });
    columns = table.columns;
    rows = table.rows;
    heights = table.values;
    for (double &height : heights) height *= scale;
  } else {
    std::tie(columns, rows) = parse_grid(keys);
    const std::vector<Number> numbers = keys.require("heights");
    column = numbers.front().column;
    for (const Number &number : numbers) {
      check_coordinate(number, "heights");
      heights.push_back(number.value);
    }
  }
  shape.mesh = at_column(column, [&] {
    if (columns < 2 || rows < 2) throw MeshError(source, "fewer than 2 x 2 heights", "give at least one cell");
    MeshData data = mesh::height_field(columns, rows, size[0] / static_cast<double>(columns - 1),
                                       size[1] / static_cast<double>(rows - 1), heights, source);
    return std::make_shared<const TriangleMesh>(std::move(data), MeshUse::any, source);
  });
}

}  // namespace cmb
