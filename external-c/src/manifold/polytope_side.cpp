#include "manifold/polytope_side.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

// Of polytopes with no more vertices all are looked at.
constexpr std::size_t few_vertices = 12;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// The extent of an edge's part beyond the limit; `from` is its end there.
inline void find_part_beyond(const Vec3 &from, const Vec3 &to, double limit, Extent &extent) {
  const double rise = from.z - limit, fall = from.z - to.z;
  const double way = rise / (fall > rise ? fall : rise);  // 1 where the other end is beyond the limit, too
  const double x = from.x + way * (to.x - from.x), y = from.y + way * (to.y - from.y);
  extent.low_x = from.x < x ? from.x : x, extent.high_x = from.x > x ? from.x : x;
  extent.low_y = from.y < y ? from.y : y, extent.high_y = from.y > y ? from.y : y;
}

}  // namespace

void PolytopeSide::place(const ContactPolytope &body, const Pose &to_side, const Shake &shake) {
  body_ = &body;
  to_side_ = to_side;
  shake_ = shake;
  summit_ = body.geometry().support_vertex(towards());
  reach_ = dot(towards(), body.geometry().vertices()[index(summit_)]) + to_side.translation.z;
}

void PolytopeSide::gather(double limit) {
  if (body_->geometry().vertices().size() <= few_vertices) {
    gather_from_all(limit);
  } else {
    gather_from_summit(limit);
  }
}

void PolytopeSide::gather_from_all(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  make_room();
  const Vec3 *const places = geometry.vertices().data();
  const convex::Polytope::Edge *const all_edges = geometry.edges().data();
  const Pose to_side = to_side_;
  Vertex *const vertices = vertices_.data();
  const std::size_t vertex_count = geometry.vertices().size(), all_edge_count = geometry.edges().size();
  std::size_t inside_count = 0, edge_count = 0;
  for (std::size_t v = 0; v < vertex_count; ++v) {
    Vertex &vertex = vertices[v];
    const Vec3 at = to_side(places[v]);
    vertex.at.x = at.x, vertex.at.y = at.y, vertex.at.z = at.z;
    vertex.number = static_cast<std::int32_t>(v);
    vertex.inside = at.z > limit;
    inside_[inside_count] = vertex.number;
    inside_count += static_cast<std::size_t>(vertex.inside);
  }
  // Which edges are kept cannot be foretold: all are put down, and kept or overwritten. Upright ones cross nothing at an angle.
  Edge *const edges = edges_.data();
  for (std::size_t e = 0; e < all_edge_count; ++e) {
    const std::int32_t first = all_edges[e].vertex[0], second = all_edges[e].vertex[1];
    const bool from_first = vertices[first].inside;
    const std::int32_t self = from_first ? first : second, other = from_first ? second : first;
    edges[edge_count].vertex[0] = self;
    edges[edge_count].vertex[1] = other;
    edges[edge_count].number = static_cast<std::int32_t>(e);
    const Vec3 way = vertices[second].at - vertices[first].at;
    const bool upright = way.x * way.x + way.y * way.y <= wall_cosine * wall_cosine * norm2(way);
    edge_count += static_cast<std::size_t>((from_first | vertices[second].inside) & !upright);
  }
  Extent extent;
  for (std::size_t k = 0; k < edge_count; ++k) {
    find_part_beyond(vertices[edges[k].vertex[0]].at, vertices[edges[k].vertex[1]].at, limit, edges[k].extent);
    extent.add(edges[k].extent);
  }
  vertex_count_ = vertex_count;
  edge_count_ = edge_count;
  inside_count_ = inside_count;
  extent_ = extent;
}

void PolytopeSide::make_room() {
  const convex::Polytope &geometry = body_->geometry();
  faces_gathered_ = false;
  // One place more than can be taken: what turns out not to be needed is overwritten.
  if (vertices_.size() <= geometry.vertices().size()) vertices_.resize(geometry.vertices().size() + 1);
  if (inside_.size() <= geometry.vertices().size()) inside_.resize(geometry.vertices().size() + 1);
  if (edges_.size() <= geometry.edges().size()) edges_.resize(geometry.edges().size() + 1);
  if (vertex_mark_.size() < geometry.vertices().size()) vertex_mark_.resize(geometry.vertices().size());
  if (face_mark_.size() < geometry.faces().size()) face_mark_.resize(geometry.faces().size());
  if (++gathering_ == 0) {
    std::fill(vertex_mark_.begin(), vertex_mark_.end(), Mark{});
    std::fill(face_mark_.begin(), face_mark_.end(), 0);
    gathering_ = 1;
  }
}

void PolytopeSide::gather_from_summit(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  const Vec3 *const places = geometry.vertices().data();
  const std::int32_t *const neighbours = geometry.neighbours().data(), *const numbers = geometry.neighbour_edges().data();
  make_room();
  const Pose to_side = to_side_;
  const std::uint32_t gathering = gathering_;
  Mark *const marks = vertex_mark_.data();
  Vertex *const vertices = vertices_.data();
  std::int32_t *const inside = inside_.data();
  Edge *const edges = edges_.data();
  std::int32_t count = 0;
  std::size_t inside_count = 0, edge_count = 0;
  // Whether a vertex is new, beyond the limit or an edge kept already cannot be foretold: everything is computed, and kept
  // or overwritten. Written member by member: objects put together on the stack and copied as a whole would wait.
  const auto add_vertex = [&](std::int32_t number) {
    Vertex &vertex = vertices[count];
    const Vec3 at = to_side(places[number]);
    vertex.at.x = at.x, vertex.at.y = at.y, vertex.at.z = at.z;
    vertex.number = number;
    vertex.inside = at.z > limit;
    Mark &mark = marks[number];
    const bool met = mark.gathering == gathering;
    mark.place = met ? mark.place : count;
    mark.gathering = gathering;
    inside[inside_count] = count;
    inside_count += static_cast<std::size_t>(!met & vertex.inside);
    count += static_cast<std::int32_t>(!met);
    return mark.place;
  };
  add_vertex(summit_);
  Extent extent;
  for (std::size_t k = 0; k < inside_count; ++k) {
    const std::int32_t self = inside[k];
    const Vec3 at = vertices[self].at;
    const std::int32_t v = vertices[self].number, last_slot = geometry.neighbour_begin(v + 1);
    for (std::int32_t slot = geometry.neighbour_begin(v); slot < last_slot; ++slot) {
      const std::int32_t other = add_vertex(neighbours[slot]);
      const Vertex &end = vertices[other];
      Edge *const edge = edges + edge_count;
      edge->vertex[0] = self;
      edge->vertex[1] = other;
      edge->number = numbers[slot];
      find_part_beyond(at, end.at, limit, edge->extent);
      extent.add(edge->extent);
      // Of an edge with both ends beyond the limit the one that comes first keeps it.
      edge_count += 1 - (static_cast<std::size_t>(end.inside) & static_cast<std::size_t>(other < self));
    }
  }
  vertex_count_ = static_cast<std::size_t>(count);
  edge_count_ = edge_count;
  inside_count_ = inside_count;
  extent_ = extent;
}

void PolytopeSide::gather_faces() {
  const Vec3 *const row = to_side_.rotation.row, turn = shake_.turn;
  shaken_to_side_.rotation = {{row[0] + turn.y * row[2] - turn.z * row[1], row[1] + turn.z * row[0] - turn.x * row[2],
                               row[2] + turn.x * row[1] - turn.y * row[0]}};
  shaken_to_side_.translation = shake_(to_side_.translation);
  const Vec3 up = shaken_to_side_.rotation.row[2];
  const std::size_t most = body_->geometry().faces().size();
  if (up_faces_.size() < most) up_faces_.resize(most), walls_.resize(most);
  std::uint32_t *const marks = face_mark_.data();
  const std::uint32_t gathering = gathering_;
  UpFace *up_face = up_faces_.data();
  Wall *wall = walls_.data();
  for (std::size_t k = 0; k < inside_count_; ++k) {
    const std::int32_t v = vertices_[index(inside_[k])].number;
    const auto *const last = body_->corners(v + 1);
    for (const auto *corner = body_->corners(v); corner != last; ++corner) {
      if (marks[corner->face] == gathering) continue;
      marks[corner->face] = gathering;
      const double x = corner->normal.x, y = corner->normal.y, z = corner->normal.z;
      const double cosine = x * up.x + y * up.y + z * up.z;
      if (cosine > wall_cosine) {
        const double part = 1.0 / cosine;
        up_face->normal.x = part * x, up_face->normal.y = part * y, up_face->normal.z = part * z;
        up_face->offset = part * corner->offset, up_face->part = part, up_face->corner = corner;
        ++up_face;
      } else {
        wall->normal.x = x, wall->normal.y = y, wall->normal.z = z;
        wall->offset = corner->offset, wall->cosine = cosine;
        ++wall;
      }
    }
  }
  up_face_count_ = static_cast<std::size_t>(up_face - up_faces_.data());
  wall_count_ = static_cast<std::size_t>(wall - walls_.data());
  faces_gathered_ = true;
}

bool PolytopeSide::face_over(const Vertex &vertex, const Vec3 &seen, double level, double slack, Plane &plane) {
  if (!faces_gathered_) gather_faces();
  const Pose &pose = shaken_to_side_;
  const Vec3 ground = transposed_times(
      pose.rotation, Vec3{seen.x - pose.translation.x, seen.y - pose.translation.y, -pose.translation.z});
  const UpFace *best = nullptr;
  double least = HUGE_VAL;
  for (std::size_t k = 0; k < up_face_count_; ++k) {
    const UpFace &face = up_faces_[k];
    const double height = face.offset - dot(face.normal, ground);
    best = height < least ? &face : best;  // which is lowest cannot be foretold: no branch
    least = height < least ? height : least;
  }
  // What is far from deep enough, however the body is seen, need not be looked at further.
  if (best == nullptr || vertex.at.z + least <= level - slack * best->part) return false;
  for (std::size_t k = 0; k < wall_count_; ++k) {
    const Wall &wall = walls_[k];
    if (dot(wall.normal, ground) + least * wall.cosine > wall.offset) return false;
  }
  const Vec3 normal = to_side_.rotation * best->corner->normal;
  const double part = 1.0 / normal.z;
  plane.slope_x = normal.x * part, plane.slope_y = normal.y * part;
  plane.height = (best->corner->offset + dot(normal, to_side_.translation)) * part;
  return true;
}

}  // namespace cmb
