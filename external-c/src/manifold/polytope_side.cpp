#include "manifold/polytope_side.hpp"

#include <algorithm>

namespace cmb {

namespace {

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

}  // namespace

double PolytopeSide::reach(const ContactPolytope &body, const Pose &to_contact, double sense) {
  const Vec3 towards = sense * to_contact.rotation.row[2];
  const convex::Polytope &geometry = body.geometry();
  return dot(towards, geometry.vertices()[index(geometry.support_vertex(towards))]) + sense * to_contact.translation.z;
}

std::int32_t PolytopeSide::add_vertex(std::int32_t number, double limit) {
  Mark &mark = vertex_mark_[index(number)];
  if (mark.gathering != gathering_) {
    Vertex vertex;
    vertex.at = to_contact_(body_->geometry().vertices()[index(number)]);
    vertex.shaken = shake_(vertex.at);
    vertex.number = number;
    vertex.inside = sense_ * vertex.at.z > limit;
    mark = {gathering_, static_cast<std::int32_t>(vertices_.size())};
    vertices_.push_back(vertex);
  }
  return mark.place;
}

std::int32_t PolytopeSide::add_face(std::int32_t number, std::int32_t corner) {
  Mark &mark = face_mark_[index(number)];
  if (mark.gathering != gathering_) {
    Face face;
    face.normal = to_contact_.rotation * body_->geometry().faces()[index(number)].normal;
    face.shaken_normal = shake_.direction(face.normal);
    face.offset = body_->geometry().faces()[index(number)].offset + dot(face.normal, to_contact_.translation);
    face.shaken_offset = dot(face.shaken_normal, vertices_[index(corner)].shaken);
    face.number = number;
    mark = {gathering_, static_cast<std::int32_t>(faces_.size())};
    faces_.push_back(face);
  }
  return mark.place;
}

void PolytopeSide::gather(const ContactPolytope &body, const Pose &to_contact, double sense, double limit,
                          const Shake &shake) {
  const convex::Polytope &geometry = body.geometry();
  body_ = &body;
  to_contact_ = to_contact;
  sense_ = sense;
  shake_ = shake;
  vertices_.clear();
  edges_.clear();
  faces_.clear();
  if (vertex_mark_.size() < geometry.vertices().size()) vertex_mark_.resize(geometry.vertices().size());
  if (edge_mark_.size() < geometry.edges().size()) edge_mark_.resize(geometry.edges().size());
  if (face_mark_.size() < geometry.faces().size()) face_mark_.resize(geometry.faces().size());
  if (++gathering_ == 0) {
    for (std::vector<Mark> *marks : {&vertex_mark_, &edge_mark_, &face_mark_}) {
      std::fill(marks->begin(), marks->end(), Mark{});
    }
    gathering_ = 1;
  }
  // The vertices beyond a plane hang together: they are found from the farthest one along the edges.
  add_vertex(geometry.support_vertex(sense * to_contact.rotation.row[2]), limit);
  for (std::size_t k = 0; k < vertices_.size(); ++k) {
    if (!vertices_[k].inside) continue;
    const std::int32_t v = vertices_[k].number;
    for (std::int32_t slot = geometry.neighbour_begin(v); slot < geometry.neighbour_begin(v + 1); ++slot) {
      const std::int32_t e = geometry.neighbour_edges()[index(slot)];
      Mark &mark = edge_mark_[index(e)];
      if (mark.gathering == gathering_) continue;
      mark.gathering = gathering_;
      const convex::Polytope::Edge &edge = geometry.edges()[index(e)];
      Edge kept;
      for (int end = 0; end < 2; ++end) kept.vertex[end] = add_vertex(edge.vertex[end], limit);
      for (int side = 0; side < 2; ++side) kept.face[side] = add_face(edge.face[side], kept.vertex[0]);
      kept.number = e;
      edges_.push_back(kept);
    }
  }
}

}  // namespace cmb
