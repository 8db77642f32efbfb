#include "mesh/core/mesh_check.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <tuple>

#include "mesh/core/mesh_topology.hpp"

namespace cmb::mesh {

namespace {

constexpr double largest_coordinate = 1e9;       // m
constexpr double smallest_extent = 1e-9;         // m, along some axis
constexpr double smallest_side = 1e-12;          // m, of a triangle's sides the longest
constexpr double degenerate_height = 1e-10;      // of a triangle, relative to its longest side
constexpr double smallest_relative_volume = 1e-12;  // relative to area^(3/2)

// Elements are numbered from 1 in messages.
std::string triangle_name(std::size_t t) { return "triangle " + std::to_string(t + 1); }
std::string vertex_name(std::size_t v) { return "vertex " + std::to_string(v + 1); }

std::string edge_name(const MeshData &data, const Side &side) {
  const Vec3 &a = data.vertices[side.low], &b = data.vertices[side.high];
  const auto text = [](const Vec3 &p) {
    return "(" + std::to_string(p.x) + ", " + std::to_string(p.y) + ", " + std::to_string(p.z) + ")";
  };
  return "the edge from " + text(a) + " to " + text(b);
}

void check_numbers(const MeshData &data, const std::string &source) {
  if (data.triangles.empty()) throw MeshError(source, "no triangles", "export the body's surface as triangles");
  if (data.triangles.size() > MeshLimits::triangles) {
    throw MeshError(source, std::to_string(data.triangles.size()) + " triangles, more than the " +
                                std::to_string(MeshLimits::triangles) + " allowed",
                    "export with a coarser tolerance");
  }
  if (data.vertices.size() > MeshLimits::vertices) {
    throw MeshError(source, "more than " + std::to_string(MeshLimits::vertices) + " vertices",
                    "export with a coarser tolerance");
  }
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    for (const std::uint32_t v : data.triangles[t]) {
      if (v >= data.vertices.size()) {
        throw MeshError(source, triangle_name(t) + " names vertex " + std::to_string(std::uint64_t{v} + 1) + " of " +
                                    std::to_string(data.vertices.size()),
                        "the file is damaged: export it again");
      }
    }
  }
}

void check_shapes(const MeshData &data, const std::string &source) {
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    const Triangle &corner = data.triangles[t];
    const Vec3 &a = data.vertices[corner[0]], &b = data.vertices[corner[1]], &c = data.vertices[corner[2]];
    const double longest2 = std::fmax(norm2(b - a), std::fmax(norm2(c - b), norm2(a - c)));
    const bool tiny = longest2 < smallest_side * smallest_side;  // squares of squares underflow, in the end
    if (tiny || !(norm(cross(b - a, c - a)) > degenerate_height * longest2)) {
      throw MeshError(source, triangle_name(t) + " is degenerate: its corners coincide or lie on a line",
                      "remove it, or repair the mesh in the program that made it");
    }
  }
}

void check_repetition(const MeshData &data, const std::string &source) {
  std::vector<std::pair<Triangle, std::uint32_t>> sorted;
  sorted.reserve(data.triangles.size());
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    Triangle corners = data.triangles[t];
    std::sort(corners.begin(), corners.end());
    sorted.emplace_back(corners, static_cast<std::uint32_t>(t));
  }
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 0; i + 1 < sorted.size(); ++i) {
    if (sorted[i].first == sorted[i + 1].first) {
      throw MeshError(source, triangle_name(sorted[i + 1].second) + " repeats " + triangle_name(sorted[i].second),
                      "remove one of them");
    }
  }
}

// Returns whether the surface is closed.
bool check_edges(const MeshData &data, const std::string &source) {
  const std::vector<Side> sides = sorted_sides(data.triangles);
  bool closed = true;
  for (std::size_t i = 0; i < sides.size();) {
    std::size_t end = i + 1;
    while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
    if (end - i > 2) {
      throw MeshError(source, edge_name(data, sides[i]) + " belongs to " + std::to_string(end - i) +
                                  " triangles (the third is " + triangle_name(sides[i + 2].triangle) + ")",
                      "split the mesh into bodies that share no edge");
    }
    if (end - i == 2 && sides[i].ascending == sides[i + 1].ascending) {
      throw MeshError(source, triangle_name(sides[i].triangle) + " and " + triangle_name(sides[i + 1].triangle) +
                                  " are neighbours of opposite orientation",
                      "reverse the corners of one of them, so that all are counter-clockwise seen from outside");
    }
    closed = closed && end - i == 2;
    i = end;
  }
  return closed;
}

void check_volume(const MeshData &data, const std::string &source) {
  const Vec3 &origin = data.vertices[data.triangles[0][0]];
  double volume = 0.0, area = 0.0;
  for (const Triangle &corner : data.triangles) {
    const Vec3 a = data.vertices[corner[0]] - origin, b = data.vertices[corner[1]] - origin,
               c = data.vertices[corner[2]] - origin;
    volume += dot(a, cross(b, c)) / 6.0;
    area += 0.5 * norm(cross(b - a, c - a));
  }
  const double least = smallest_relative_volume * area * std::sqrt(area);
  if (volume < -least) {
    throw MeshError(source, "the closed mesh is inside out (its volume is negative)",
                    "reverse the corners of all triangles, so that they are counter-clockwise seen from outside");
  }
  if (!(volume > least)) {
    throw MeshError(source, "the closed mesh encloses no volume", "use a sheet with a boundary, or give it thickness");
  }
}

}  // namespace

void check_coordinates(const std::vector<Vec3> &vertices, const std::string &source) {
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const Vec3 &p = vertices[v];
    if (!is_finite(p)) {
      throw MeshError(source, vertex_name(v) + " has a coordinate that is not a finite number",
                      "the file is damaged: export it again");
    }
    if (std::fmax(std::fabs(p.x), std::fmax(std::fabs(p.y), std::fabs(p.z))) > largest_coordinate) {
      throw MeshError(source, vertex_name(v) + " lies farther than 1e9 m from the origin", "check the unit of length");
    }
  }
}

void check_extent(const std::vector<Vec3> &vertices, const std::string &source) {
  Vec3 low = vertices.front(), high = low;
  for (const Vec3 &p : vertices) {
    low = {std::fmin(low.x, p.x), std::fmin(low.y, p.y), std::fmin(low.z, p.z)};
    high = {std::fmax(high.x, p.x), std::fmax(high.y, p.y), std::fmax(high.z, p.z)};
  }
  const Vec3 extent = high - low;
  if (std::fmax(extent.x, std::fmax(extent.y, extent.z)) < smallest_extent) {
    throw MeshError(source, "all vertices lie within 1e-9 m", "check the unit of length");
  }
}

void weld_vertices(MeshData &data, const std::string &source) {
  check_numbers(data, source);
  check_coordinates(data.vertices, source);  // an order of coordinates needs numbers
  constexpr std::uint32_t unused = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> order(data.vertices.size());
  std::iota(order.begin(), order.end(), 0u);
  const auto key = [&](std::uint32_t v) {
    const Vec3 &p = data.vertices[v];
    return std::make_tuple(p.x, p.y, p.z);
  };
  std::sort(order.begin(), order.end(), [&](std::uint32_t i, std::uint32_t j) {
    const auto a = key(i), b = key(j);
    return a != b ? a < b : i < j;
  });
  std::vector<std::uint32_t> first_at(data.vertices.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    const bool same = i > 0 && key(order[i]) == key(order[i - 1]);
    first_at[order[i]] = same ? first_at[order[i - 1]] : order[i];
  }
  std::vector<std::uint32_t> renumbered(data.vertices.size(), unused);
  std::vector<Vec3> vertices;
  for (Triangle &corners : data.triangles) {
    for (std::uint32_t &v : corners) {
      std::uint32_t &number = renumbered[first_at[v]];
      if (number == unused) {
        number = static_cast<std::uint32_t>(vertices.size());
        vertices.push_back(data.vertices[v]);
      }
      v = number;
    }
  }
  data.vertices = std::move(vertices);
}

void check_mesh(const MeshData &data, MeshUse use, const std::string &source) {
  check_numbers(data, source);
  check_coordinates(data.vertices, source);
  check_shapes(data, source);
  check_extent(data.vertices, source);
  check_repetition(data, source);
  if (check_edges(data, source)) {
    check_volume(data, source);
  } else if (use == MeshUse::solid) {
    throw MeshError(source, "the mesh has a boundary where a solid is asked for",
                    "close its holes in the program that made it");
  }
}

}  // namespace cmb::mesh
