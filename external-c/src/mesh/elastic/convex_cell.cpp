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

// What a cut leaves is written to room for as much as there may be, which is shortened then.
ConvexCell::Cut ConvexCell::keep_before(const Vec3 &normal, double offset) {
  const std::size_t vertex_count = vertices_.size(), edge_count = edges_.size();
  if (above_.size() < vertex_count) above_.resize(vertex_count), vertex_of_.resize(vertex_count);
  double *const above = above_.data();
  std::size_t kept = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    above[v] = dot(normal, vertices_[v]) - offset;
    kept += above[v] > 0.0 ? 1 : 0;
  }
  if (kept == vertex_count) return Cut::all;
  if (kept == 0) return Cut::none;
  if (edge_of_.size() < edge_count) edge_of_.resize(edge_count), place_of_.resize(edge_count);
  new_vertices_.resize(kept + edge_count);
  new_edges_.resize(edge_count + faces_.size());
  std::int32_t *const vertex_of = vertex_of_.data();
  std::int32_t new_vertex = 0, new_edge = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    vertex_of[v] = above[v] > 0.0 ? new_vertex : -1;
    if (above[v] > 0.0) new_vertices_[index(new_vertex++)] = vertices_[v];
  }
  for (std::size_t e = 0; e < edge_count; ++e) {
    const std::size_t v = index(edges_[e].vertex[0]), w = index(edges_[e].vertex[1]);
    Edge cut;
    cut.vertex[0] = vertex_of[v], cut.vertex[1] = vertex_of[w];
    std::int32_t place = -1;
    if ((cut.vertex[0] < 0) != (cut.vertex[1] < 0)) {
      place = new_vertex++;
      new_vertices_[index(place)] = vertices_[v] + (above[v] / (above[v] - above[w])) * (vertices_[w] - vertices_[v]);
      cut.vertex[cut.vertex[0] < 0 ? 0 : 1] = place;
    }
    place_of_[e] = place;
    edge_of_[e] = cut.vertex[0] < 0 ? -1 : new_edge;
    if (cut.vertex[0] >= 0) new_edges_[index(new_edge++)] = cut;
  }
  new_vertices_.resize(index(new_vertex));
  if (!cut_faces(new_edge)) return Cut::failed;
  new_faces_.push_back({-normal, -offset, count_of(new_face_vertices_.size()), count_of(cap_.size())});
  if (!close_cap()) return Cut::failed;
  vertices_.swap(new_vertices_), faces_.swap(new_faces_), edges_.swap(new_edges_);
  face_vertices_.swap(new_face_vertices_), face_edges_.swap(new_face_edges_);
  return Cut::part;
}

bool ConvexCell::cut_faces(std::int32_t new_edge) {
  // No more than two places come to a face, and no more corners to the cap than there are faces.
  const std::size_t most = face_vertices_.size() + 3 * faces_.size();
  new_face_vertices_.resize(most), new_face_edges_.resize(most);
  new_faces_.clear(), cap_.clear();
  const std::int32_t *const vertices = face_vertices_.data(), *const edges = face_edges_.data(), *const vertex_of = vertex_of_.data(),
                            *const edge_of = edge_of_.data(), *const place_of = place_of_.data();
  std::int32_t *const new_vertices = new_face_vertices_.data(), *const new_edges = new_face_edges_.data();
  std::size_t at = 0;
  for (const Face &face : faces_) {
    const std::size_t first = at;
    std::int32_t leaves = -1, comes = -1;
    std::size_t side_at = 0;
    for (std::int32_t i = face.first; i < face.first + face.count; ++i) {
      const std::size_t edge = index(edges[i]);
      const std::int32_t here = vertex_of[vertices[i]];
      new_vertices[at] = here, new_edges[at] = edge_of[edge];
      at += here >= 0 ? 1 : 0;
      if (place_of[edge] < 0) continue;
      std::int32_t &place = here >= 0 ? leaves : comes;
      if (place >= 0) return false;  // a second time
      place = place_of[edge];
      if (here >= 0) side_at = at;
      new_vertices[at] = place, new_edges[at] = edge_of[edge];  // of the place where the border leaves: the new side, below
      ++at;
    }
    if ((leaves < 0) != (comes < 0)) return false;
    if (leaves >= 0) {
      Edge &side = new_edges_[index(new_edge)];
      side = {};
      side.vertex[0] = leaves, side.vertex[1] = comes;
      new_edges[side_at] = new_edge;
      cap_.push_back({comes, leaves, new_edge++});
    }
    if (at > first) new_faces_.push_back({face.normal, face.offset, count_of(first), count_of(at - first)});
  }
  new_edges_.resize(index(new_edge));
  new_face_vertices_.resize(at), new_face_edges_.resize(at);
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
