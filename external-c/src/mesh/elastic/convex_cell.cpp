#include "mesh/elastic/convex_cell.hpp"

#include <cstddef>
#include <utility>

namespace cmb::mesh {

namespace {

std::size_t index(std::int32_t k) { return static_cast<std::size_t>(k); }
std::int32_t count_of(std::size_t size) { return static_cast<std::int32_t>(size); }

// Vertex v has the coordinate signs of v's bits.
struct CubeFace {
  Vec3 normal;
  std::int32_t vertex[4], edge[4];
};
constexpr CubeFace cube_faces[6] = {
    {{-1, 0, 0}, {0, 4, 6, 2}, {8, 6, 10, 4}}, {{1, 0, 0}, {1, 3, 7, 5}, {5, 11, 7, 9}},
    {{0, -1, 0}, {0, 1, 5, 4}, {0, 9, 2, 8}},  {{0, 1, 0}, {2, 6, 7, 3}, {10, 3, 11, 1}},
    {{0, 0, -1}, {0, 2, 3, 1}, {4, 1, 5, 0}},  {{0, 0, 1}, {4, 5, 7, 6}, {2, 7, 3, 6}}};
constexpr std::int32_t cube_edges[12][2] = {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3},
                                            {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};

}  // namespace

void ConvexCell::start(const Vec3 &center, double half) {
  vertices_.clear(), faces_.clear(), edges_.clear(), face_vertices_.clear(), face_edges_.clear();
  for (int v = 0; v < 8; ++v) {
    vertices_.push_back(center + Vec3{(v & 1) != 0 ? half : -half, (v & 2) != 0 ? half : -half, (v & 4) != 0 ? half : -half});
  }
  for (const auto &edge : cube_edges) {
    edges_.emplace_back();
    edges_.back().vertex[0] = edge[0], edges_.back().vertex[1] = edge[1];
  }
  for (const CubeFace &face : cube_faces) {
    faces_.push_back({face.normal, dot(face.normal, center) + half, count_of(face_vertices_.size()), 4});
    face_vertices_.insert(face_vertices_.end(), face.vertex, face.vertex + 4);
    face_edges_.insert(face_edges_.end(), face.edge, face.edge + 4);
  }
}

ConvexCell::Cut ConvexCell::keep_before(const Vec3 &normal, double offset) {
  above_.clear();
  std::size_t kept = 0;
  for (const Vec3 &v : vertices_) {
    above_.push_back(dot(normal, v) - offset);
    kept += above_.back() > 0.0 ? 1 : 0;
  }
  if (kept == vertices_.size()) return Cut::all;
  if (kept == 0) return Cut::none;
  new_vertices_.clear(), new_edges_.clear();
  vertex_of_.clear(), edge_of_.clear(), place_of_.clear();
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    vertex_of_.push_back(above_[v] > 0.0 ? count_of(new_vertices_.size()) : -1);
    if (above_[v] > 0.0) new_vertices_.push_back(vertices_[v]);
  }
  for (const Edge &edge : edges_) {
    const std::size_t v = index(edge.vertex[0]), w = index(edge.vertex[1]);
    Edge cut;
    cut.vertex[0] = vertex_of_[v], cut.vertex[1] = vertex_of_[w];
    std::int32_t place = -1;
    if ((cut.vertex[0] < 0) != (cut.vertex[1] < 0)) {
      place = count_of(new_vertices_.size());
      new_vertices_.push_back(vertices_[v] + (above_[v] / (above_[v] - above_[w])) * (vertices_[w] - vertices_[v]));
      cut.vertex[cut.vertex[0] < 0 ? 0 : 1] = place;
    }
    place_of_.push_back(place);
    edge_of_.push_back(cut.vertex[0] < 0 ? -1 : count_of(new_edges_.size()));
    if (cut.vertex[0] >= 0) new_edges_.push_back(cut);
  }
  if (!cut_faces()) return Cut::failed;
  new_faces_.push_back({-normal, -offset, count_of(new_face_vertices_.size()), count_of(cap_.size())});
  if (!close_cap()) return Cut::failed;
  vertices_.swap(new_vertices_), faces_.swap(new_faces_), edges_.swap(new_edges_);
  face_vertices_.swap(new_face_vertices_), face_edges_.swap(new_face_edges_);
  return Cut::part;
}

bool ConvexCell::cut_faces() {
  new_faces_.clear(), new_face_vertices_.clear(), new_face_edges_.clear(), cap_.clear();
  for (const Face &face : faces_) {
    const std::int32_t first = count_of(new_face_vertices_.size());
    std::int32_t leaves = -1, comes = -1, side_at = -1;
    for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
      const std::size_t edge = index(face_edges_[index(i)]);
      const std::int32_t here = vertex_of_[index(face_vertices_[index(i)])];
      if (here >= 0) new_face_vertices_.push_back(here), new_face_edges_.push_back(edge_of_[edge]);
      if (place_of_[edge] < 0) continue;
      std::int32_t &place = here >= 0 ? leaves : comes;
      if (place >= 0) return false;  // a second time
      place = place_of_[edge];
      if (here >= 0) side_at = count_of(new_face_edges_.size());
      new_face_vertices_.push_back(place);
      new_face_edges_.push_back(edge_of_[edge]);  // of the place where the border leaves: the new side, below
    }
    if ((leaves < 0) != (comes < 0)) return false;
    if (leaves >= 0) {
      const std::int32_t side = count_of(new_edges_.size());
      new_edges_.emplace_back();
      new_edges_.back().vertex[0] = leaves, new_edges_.back().vertex[1] = comes;
      new_face_edges_[index(side_at)] = side;
      cap_.push_back({comes, leaves, side});
    }
    const std::int32_t count = count_of(new_face_vertices_.size()) - first;
    if (count > 0) new_faces_.push_back({face.normal, face.offset, first, count});
  }
  return !cap_.empty();
}

bool ConvexCell::close_cap() {
  for (std::size_t k = 0; k < cap_.size(); ++k) {
    new_face_vertices_.push_back(cap_[k].from);
    new_face_edges_.push_back(cap_[k].edge);
    if (k + 1 == cap_.size()) break;
    std::size_t next = k + 1;
    while (next < cap_.size() && cap_[next].from != cap_[k].to) ++next;
    if (next == cap_.size()) return false;
    std::swap(cap_[k + 1], cap_[next]);
  }
  return cap_.back().to == cap_.front().from;
}

}  // namespace cmb::mesh
