#include "shape/polytope.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "math/index.hpp"
#include "shape/face_clusters.hpp"
#include "shape/point_groups.hpp"

namespace cmb::convex {

namespace {

// Candidates of a cell of the support table come in groups of so many.
constexpr std::size_t compared_at_once = 4;

bool fail(std::string *problem, std::string reason) {
  if (problem != nullptr) *problem = std::move(reason);
  return false;
}

// Cell of a cube's surface that the direction d points to. Written to be compiled without branches, and without a copy of d, which
// would wait for it to be stored.
inline int cube_cell(const Vec3 &d, int cells) {
  static constexpr double Vec3::*coordinate[3] = {&Vec3::x, &Vec3::y, &Vec3::z};
  static constexpr double Vec3::*first[3] = {&Vec3::y, &Vec3::x, &Vec3::x};
  static constexpr double Vec3::*second[3] = {&Vec3::z, &Vec3::z, &Vec3::y};
  const double ax = std::fabs(d.x), ay = std::fabs(d.y), az = std::fabs(d.z);
  const double higher = ax > ay ? ax : ay, along = higher > az ? higher : az;
  if (!(along > 0.0)) return 0;
  const int z_is_largest = az > higher ? 1 : 0, axis = 2 * z_is_largest + (static_cast<int>(ay > ax) & (1 - z_is_largest));
  const double scale = 0.5 * cells / along;
  const int i = static_cast<int>((d.*first[axis] + along) * scale);
  const int j = static_cast<int>((d.*second[axis] + along) * scale);
  const int side = 2 * axis + (d.*coordinate[axis] < 0.0 ? 0 : 1);
  return (side * cells + std::min(i, cells - 1)) * cells + std::min(j, cells - 1);
}

// The direction to the place (u, v), within -1 and 1, on a side of the cube.
Vec3 cube_direction(int side, double u, double v) {
  const double w = side % 2 == 0 ? -1.0 : 1.0;
  return side < 2 ? Vec3{w, u, v} : side < 4 ? Vec3{u, w, v} : Vec3{u, v, w};
}

}  // namespace

bool Polytope::build(const std::vector<Vec3> &vertices, const std::vector<std::vector<std::int32_t>> &faces,
                     Polytope &result, std::string *problem, double tolerance, const std::vector<Vec3> *inside) {
  if (vertices.size() < 4 || faces.size() < 4) return fail(problem, "a polytope has at least 4 vertices and 4 faces");
  Polytope built;
  built.vertices_ = vertices;
  Vec3 low = vertices[0], high = vertices[0];
  for (const Vec3 &p : vertices) {
    if (!is_finite(p)) return fail(problem, "a vertex is not finite");
    for (int axis = 0; axis < 3; ++axis) {
      low.set(axis, std::min(low[axis], p[axis]));
      high.set(axis, std::max(high[axis], p[axis]));
    }
    built.radius_ = std::max(built.radius_, norm(p));
    built.center_ = built.center_ + (1.0 / static_cast<double>(vertices.size())) * p;
  }
  const double extent = norm(high - low);
  const double slack = tolerance * extent;
  const PointGroups groups(inside == nullptr ? vertices : *inside);

  std::unordered_map<std::uint64_t, std::int32_t> edge_from;  // the edge of two vertices, by direction
  edge_from.reserve(6 * vertices.size());
  const auto direction = [](std::int32_t from, std::int32_t to) {
    return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint64_t>(to);
  };
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const std::vector<std::int32_t> &corner = faces[f];
    if (corner.size() < 3) return fail(problem, "a face has fewer than 3 corners");
    for (std::int32_t v : corner) {
      if (v < 0 || index(v) >= vertices.size()) return fail(problem, "a face names a vertex that does not exist");
    }
    Face face;
    face.first = static_cast<std::int32_t>(built.face_vertices_.size());
    face.count = static_cast<std::int32_t>(corner.size());
    Vec3 area;  // Newell's normal, about the first corner to keep the terms small
    const Vec3 &origin = vertices[index(corner[0])];
    Vec3 middle = origin;
    for (std::size_t k = 1; k + 1 < corner.size(); ++k) {
      area = area + cross(vertices[index(corner[k])] - origin, vertices[index(corner[k + 1])] - origin);
    }
    for (std::size_t k = 1; k < corner.size(); ++k) middle = middle + vertices[index(corner[k])];
    middle = (1.0 / static_cast<double>(corner.size())) * middle;
    const double length = norm(area);
    if (!(length > 0.0)) return fail(problem, "a face has no area");
    face.normal = (1.0 / length) * area;
    face.offset = dot(face.normal, middle);
    built.faces_.push_back(face);
    built.face_vertices_.insert(built.face_vertices_.end(), corner.begin(), corner.end());
    for (std::int32_t v : corner) {
      if (std::fabs(dot(face.normal, vertices[index(v)]) - face.offset) > slack) {
        return fail(problem, "a face is not plane");
      }
    }
    if (groups.any_beyond(face.normal, face.offset + slack)) {
      return fail(problem, inside == nullptr ? "the faces are not those of a convex solid"
                                             : "a point is left outside by rounding");
    }
    for (std::size_t k = 0; k < corner.size(); ++k) {
      const std::int32_t a = corner[k], b = corner[(k + 1) % corner.size()];
      const auto twin = edge_from.find(direction(b, a));
      const bool is_new = twin == edge_from.end();
      const std::int32_t edge_index = is_new ? static_cast<std::int32_t>(built.edges_.size()) : twin->second;
      if (a == b || !edge_from.emplace(direction(a, b), edge_index).second) {
        return fail(problem, "an edge is used twice in the same sense");
      }
      const std::int32_t face_index = static_cast<std::int32_t>(f);
      built.face_edges_.push_back(edge_index);
      if (!is_new) {
        built.edges_[index(edge_index)].face[1] = face_index;
        continue;
      }
      Edge edge;
      edge.vertex[0] = a;
      edge.vertex[1] = b;
      edge.face[0] = face_index;
      edge.face[1] = -1;
      built.edges_.push_back(edge);
      built.edge_directions_.push_back(normalized(vertices[index(b)] - vertices[index(a)]));
    }
  }
  if (std::any_of(built.edges_.begin(), built.edges_.end(), [](const Edge &e) { return e.face[1] < 0; })) {
    return fail(problem, "the faces do not close a surface");
  }
  if (vertices.size() + faces.size() != built.edges_.size() + 2) {
    return fail(problem, "vertices, edges and faces do not satisfy Euler's formula (an unused vertex?)");
  }

  for (const Edge &edge : built.edges_) {
    const Vec3 &a = built.faces_[index(edge.face[0])].normal, &b = built.faces_[index(edge.face[1])].normal;
    built.edge_sharpness_.push_back(norm(a - b) / norm(a + b));
    built.sharpest_edge_ = std::max(built.sharpest_edge_, built.edge_sharpness_.back());
  }

  std::vector<std::int32_t> degree(vertices.size() + 1, 0);
  for (const Edge &edge : built.edges_) {
    for (std::int32_t v : edge.vertex) ++degree[index(v) + 1];
  }
  for (std::size_t v = 0; v < vertices.size(); ++v) degree[v + 1] += degree[v];
  built.neighbour_begin_ = degree;
  built.neighbours_.resize(2 * built.edges_.size());
  built.neighbour_edges_.resize(2 * built.edges_.size());
  built.neighbour_ways_.resize(2 * built.edges_.size());
  for (std::size_t e = 0; e < built.edges_.size(); ++e) {
    for (int side = 0; side < 2; ++side) {
      const std::int32_t slot = degree[index(built.edges_[e].vertex[side])]++;
      const std::int32_t neighbour = built.edges_[e].vertex[1 - side];
      built.neighbours_[index(slot)] = neighbour;
      built.neighbour_ways_[index(slot)] = vertices[index(neighbour)] - vertices[index(built.edges_[e].vertex[side])];
      built.neighbour_edges_[index(slot)] = static_cast<std::int32_t>(e);
    }
  }
  built.build_support_table();
  if (vertices.size() <= few_vertices) built.build_few_places();
  built.clusters_ = std::make_shared<const FaceClusters>(built);
  result = std::move(built);
  return true;
}

Polytope Polytope::box(const Vec3 &size) {
  std::vector<Vec3> vertices;
  for (int v = 0; v < 8; ++v) {
    vertices.push_back({(v & 1 ? 0.5 : -0.5) * size.x, (v & 2 ? 0.5 : -0.5) * size.y, (v & 4 ? 0.5 : -0.5) * size.z});
  }
  Polytope result;
  build(vertices, {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}, result,
        nullptr);
  return result;
}

void Polytope::build_support_table() {
  // About eight cells for each vertex: most have no more candidates than are compared at once.
  cells_ = std::clamp(static_cast<int>(std::ceil(std::sqrt(static_cast<double>(vertices_.size()) * 4.0 / 3.0))), 2, 40);
  const double slack = 1e-12 * radius_;
  std::vector<std::int32_t> last_cell(vertices_.size(), -1), kept;
  std::int32_t start = 0;
  candidates_.clear();
  cell_begin_.assign(1, 0);
  for (std::int32_t cell = 0; cell < 6 * cells_ * cells_; ++cell) {
    const int side = cell / (cells_ * cells_), i = cell / cells_ % cells_, j = cell % cells_;
    kept.clear();
    const auto direction = [&](double u, double v) {
      return cube_direction(side, 2.0 * (i + u) / cells_ - 1.0, 2.0 * (j + v) / cells_ - 1.0);
    };
    const auto keep_farthest = [&](const Vec3 &d) {
      start = climb(d, start);
      if (last_cell[index(start)] != cell) kept.push_back(start);
      last_cell[index(start)] = cell;
    };
    keep_farthest(direction(0.5, 0.5));  // the first one: that of outer_vertex()
    Vec3 corner[4];
    for (int k = 0; k < 4; ++k) keep_farthest(corner[k] = direction(k & 1, k >> 1));
    // A vertex that another one surpasses along all four corners is surpassed along all that lies between. Those that are
    // not hang together along edges, as their normal cones do.
    const auto surpassed = [&](const Vec3 &p) {
      return std::any_of(kept.begin(), kept.end(), [&](std::int32_t other) {
        const Vec3 lead = vertices_[index(other)] - p;
        return std::all_of(corner, corner + 4, [&](const Vec3 &d) { return dot(d, lead) > slack; });
      });
    };
    for (std::size_t k = 0; k < kept.size(); ++k) {
      for (std::int32_t slot = neighbour_begin(kept[k]); slot < neighbour_begin(kept[k] + 1); ++slot) {
        const std::int32_t next = neighbours_[index(slot)];
        if (last_cell[index(next)] == cell) continue;
        last_cell[index(next)] = cell;
        if (!surpassed(vertices_[index(next)])) kept.push_back(next);
      }
    }
    while (kept.size() % compared_at_once != 0) kept.push_back(kept.back());
    candidates_.insert(candidates_.end(), kept.begin(), kept.end());
    cell_begin_.push_back(static_cast<std::int32_t>(candidates_.size()));
  }
}

void Polytope::build_few_places() {
  for (int axis = 0; axis < 3; ++axis) {
    for (std::size_t k = 0; k < few_vertices; ++k) few_places_.push_back(vertices_[std::min(k, vertices_.size() - 1)][axis]);
  }
}

// By a knock-out tournament without branches: directions are unpredictable.
std::int32_t Polytope::support_of_few(const Vec3 &d) const {
  const double *const x = few_places_.data(), *const y = x + few_vertices, *const z = y + few_vertices;
  double height[few_vertices];
  std::int32_t best[few_vertices / 2];
  for (std::size_t k = 0; k < few_vertices; ++k) height[k] = d.x * x[k] + d.y * y[k] + d.z * z[k];
  for (std::int32_t k = 0; k < 4; ++k) {
    const bool second = height[2 * k + 1] > height[2 * k];
    best[k] = 2 * k + static_cast<std::int32_t>(second);
    height[k] = second ? height[2 * k + 1] : height[2 * k];
  }
  for (std::int32_t k = 0; k < 2; ++k) {
    const bool second = height[2 * k + 1] > height[2 * k];
    best[k] = second ? best[2 * k + 1] : best[2 * k];
    height[k] = second ? height[2 * k + 1] : height[2 * k];
  }
  return height[1] > height[0] ? best[1] : best[0];
}

std::int32_t Polytope::support_vertex(const Vec3 &d) const {
  if (!few_places_.empty()) return support_of_few(d);
  const int cell = cube_cell(d, cells_);
  const std::int32_t *candidate = candidates_.data() + cell_begin_[index(cell)];
  const std::int32_t *const end = candidates_.data() + cell_begin_[index(cell) + 1];
  const Vec3 *const places = vertices_.data();
  std::int32_t best = *candidate;
  double height = -HUGE_VAL;
  do {
    for (std::size_t k = 0; k < compared_at_once; ++k) {
      const std::int32_t vertex = candidate[k];
      const double here = dot(d, places[vertex]);
      best = here > height ? vertex : best;
      height = here > height ? here : height;
    }
    candidate += compared_at_once;
  } while (candidate != end);
  return best;
}

std::int32_t Polytope::outer_vertex(const Vec3 &d) const {
  return candidates_[index(cell_begin_[index(cube_cell(d, cells_))])];
}

std::int32_t Polytope::climb(const Vec3 &d, std::int32_t start) const {
  std::int32_t best = start;
  double height = dot(d, vertices_[index(best)]);
  for (;;) {  // heights rise strictly, so this ends
    const std::int32_t from = best;
    for (std::int32_t k = neighbour_begin(from); k < neighbour_begin(from + 1); ++k) {
      const std::int32_t candidate = neighbours_[index(k)];
      const double here = dot(d, vertices_[index(candidate)]);
      if (here > height) height = here, best = candidate;
    }
    if (best == from) return best;
  }
}

}  // namespace cmb::convex
