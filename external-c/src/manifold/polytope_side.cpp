#include "manifold/polytope_side.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

void PolytopeSide::place(const ContactPolytope &body, const Pose &to_side, const Shake &shake) {
  body_ = &body;
  to_side_ = to_side;
  shake_ = shake;
  summit_ = body.geometry().support_vertex(towards());
  reach_ = dot(towards(), body.geometry().vertices()[index(summit_)]) + to_side.translation.z;
}

void PolytopeSide::gather(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  const Vec3 *const places = geometry.vertices().data();
  const std::int32_t *const neighbours = geometry.neighbours().data(), *const numbers = geometry.neighbour_edges().data();
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
  // The vertices beyond a plane hang together: they are found from the farthest one along the edges.
  add_vertex(summit_);
  double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;
  for (std::size_t k = 0; k < inside_count; ++k) {
    const std::int32_t self = inside[k];
    const double x = vertices[self].at.x, y = vertices[self].at.y, z = vertices[self].at.z;
    const std::int32_t v = vertices[self].number, last_slot = geometry.neighbour_begin(v + 1);
    for (std::int32_t slot = geometry.neighbour_begin(v); slot < last_slot; ++slot) {
      const std::int32_t other = add_vertex(neighbours[slot]);
      const Vertex &end = vertices[other];
      const double rise = z - limit, fall = z - end.at.z;
      const double way = rise / (fall > rise ? fall : rise);  // 1 where the end is beyond the limit, too
      const double end_x = x + way * (end.at.x - x), end_y = y + way * (end.at.y - y);
      Edge *const edge = edges + edge_count;
      edge->vertex[0] = self;
      edge->vertex[1] = other;
      edge->number = numbers[slot];
      Extent &extent = edge->extent;
      extent.low_x = x < end_x ? x : end_x, extent.high_x = x > end_x ? x : end_x;
      extent.low_y = y < end_y ? y : end_y, extent.high_y = y > end_y ? y : end_y;
      low_x = extent.low_x < low_x ? extent.low_x : low_x, high_x = extent.high_x > high_x ? extent.high_x : high_x;
      low_y = extent.low_y < low_y ? extent.low_y : low_y, high_y = extent.high_y > high_y ? extent.high_y : high_y;
      // Of an edge with both ends beyond the limit the one that comes first keeps it.
      edge_count += 1 - (static_cast<std::size_t>(end.inside) & static_cast<std::size_t>(other < self));
    }
  }
  vertex_count_ = static_cast<std::size_t>(count);
  edge_count_ = edge_count;
  inside_count_ = inside_count;
  extent_ = {low_x, high_x, low_y, high_y};
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
