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

std::int32_t PolytopeSide::add_vertex(std::int32_t number, double limit) {
  Mark &mark = vertex_mark_[index(number)];
  if (mark.gathering != gathering_) {
    mark = {gathering_, static_cast<std::int32_t>(vertices_.size())};
    const Vec3 at = to_side_(body_->geometry().vertices()[index(number)]);
    vertices_.push_back({at, shake_(at), number, at.z > limit});
  }
  return mark.place;
}

void PolytopeSide::gather(double limit) {
  const convex::Polytope &geometry = body_->geometry();
  vertices_.clear();
  edges_.clear();
  faces_.clear();
  extent_ = {};
  if (vertex_mark_.size() < geometry.vertices().size()) vertex_mark_.resize(geometry.vertices().size());
  if (face_mark_.size() < geometry.faces().size()) face_mark_.resize(geometry.faces().size());
  if (++gathering_ == 0) {
    for (std::vector<Mark> *marks : {&vertex_mark_, &face_mark_}) std::fill(marks->begin(), marks->end(), Mark{});
    gathering_ = 1;
  }
  // The vertices beyond a plane hang together: they are found from the farthest one along the edges.
  add_vertex(summit_, limit);
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    if (!vertices_[k].inside) continue;
    const Vec3 at = vertices_[k].at;
    const std::int32_t self = static_cast<std::int32_t>(k), v = vertices_[k].number;
    extent_.add(at);
    for (std::int32_t slot = geometry.neighbour_begin(v); slot < geometry.neighbour_begin(v + 1); ++slot) {
      const std::int32_t other = add_vertex(geometry.neighbours()[index(slot)], limit);
      const Vertex &end = vertices_[index(other)];
      if (end.inside && other < self) continue;  // kept when the other end was looked at
      Edge edge;
      edge.vertex[0] = self, edge.vertex[1] = other;
      edge.number = geometry.neighbour_edges()[index(slot)];
      edge.extent.add(at);
      const Vec3 last = end.inside ? end.at : at + ((at.z - limit) / (at.z - end.at.z)) * (end.at - at);
      edge.extent.add(last);
      if (!end.inside) extent_.add(last);
      edges_.push_back(edge);
    }
  }
}

const std::vector<std::int32_t> &PolytopeSide::faces() {
  if (!faces_.empty()) return faces_;
  for (const Edge &edge : edges_) {
    for (const std::int32_t face : body_->geometry().edges()[index(edge.number)].face) {
      Mark &mark = face_mark_[index(face)];
      if (mark.gathering == gathering_) continue;
      mark.gathering = gathering_;
      faces_.push_back(face);
    }
  }
  return faces_;
}

}  // namespace cmb
