#include "manifold/polytope_side.hpp"

#include <algorithm>

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
  faces_.clear();
  if (vertices_.size() < geometry.vertices().size()) vertices_.resize(geometry.vertices().size());
  if (edges_.size() < geometry.edges().size()) edges_.resize(geometry.edges().size());
  if (vertex_mark_.size() < geometry.vertices().size()) vertex_mark_.resize(geometry.vertices().size());
  if (face_mark_.size() < geometry.faces().size()) face_mark_.resize(geometry.faces().size());
  if (++gathering_ == 0) {
    for (std::vector<Mark> *marks : {&vertex_mark_, &face_mark_}) std::fill(marks->begin(), marks->end(), Mark{});
    gathering_ = 1;
  }
  const Pose to_side = to_side_;
  const std::uint32_t gathering = gathering_;
  Mark *const marks = vertex_mark_.data();
  Vertex *const vertices = vertices_.data();
  Edge *edge = edges_.data();
  std::int32_t count = 0;
  // Written member by member: objects put together on the stack and copied as a whole would wait for the store.
  const auto add_vertex = [&](std::int32_t number) {
    marks[number].gathering = gathering;
    marks[number].place = count;
    Vertex &vertex = vertices[count++];
    vertex.at = to_side(places[number]);
    vertex.number = number;
    vertex.inside = vertex.at.z > limit;
  };
  // The vertices beyond a plane hang together: they are found from the farthest one along the edges.
  add_vertex(summit_);
  Extent extent;
  for (std::int32_t self = 0; self < count; ++self) {
    if (!vertices[self].inside) continue;
    const Vec3 at = vertices[self].at;
    const std::int32_t v = vertices[self].number, last_slot = geometry.neighbour_begin(v + 1);
    extent.add(at);
    for (std::int32_t slot = geometry.neighbour_begin(v); slot < last_slot; ++slot) {
      const std::int32_t neighbour = neighbours[slot];
      if (marks[neighbour].gathering != gathering) add_vertex(neighbour);
      const std::int32_t other = marks[neighbour].place;
      const Vertex &end = vertices[other];
      if (end.inside && other < self) continue;  // kept when the other end was looked at
      Vec3 last = end.at;
      if (!end.inside) {
        last = at + ((at.z - limit) / (at.z - last.z)) * (last - at);
        extent.add(last);
      }
      edge->vertex[0] = self;
      edge->vertex[1] = other;
      edge->number = numbers[slot];
      edge->extent.low_x = at.x < last.x ? at.x : last.x;
      edge->extent.high_x = at.x > last.x ? at.x : last.x;
      edge->extent.low_y = at.y < last.y ? at.y : last.y;
      edge->extent.high_y = at.y > last.y ? at.y : last.y;
      ++edge;
    }
  }
  vertex_count_ = static_cast<std::size_t>(count);
  edge_count_ = static_cast<std::size_t>(edge - edges_.data());
  extent_ = extent;
}

const std::vector<std::int32_t> &PolytopeSide::faces() {
  if (!faces_.empty()) return faces_;
  for (std::size_t k = 0; k < edge_count_; ++k) {
    for (const std::int32_t face : body_->geometry().edges()[index(edges_[k].number)].face) {
      Mark &mark = face_mark_[index(face)];
      if (mark.gathering == gathering_) continue;
      mark.gathering = gathering_;
      faces_.push_back(face);
    }
  }
  return faces_;
}

}  // namespace cmb
