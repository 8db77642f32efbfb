// The part of a polytope near a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shape/contact_polytope.hpp"

namespace cmb {

using convex::Pose;

// A polytope's vertices that reach beyond a limit towards the other body. All in the side's axes: x and y in the contact plane, z towards
// the other body.
class ContactSide {
 public:
  // `to_side` maps the body's frame to the side's axes, which mirrors the body where the other one lies below.
  void place(const ContactPolytope &body, const Pose &to_side);
  // Gathers the vertices beyond `limit`: z > limit.
  void gather(double limit);
  // After that: the first ones of `outline`, so many as are returned, become the corners of the part beyond the limit, z times `sense`
  // (1 or -1).
  std::size_t outline(double sense, std::vector<Vec3> &outline) const;

  // The faces that reach beyond the limit.
  void near_faces(std::vector<std::int32_t> &faces);

  // How far the body reaches: its greatest z.
  double reach() const { return reach_; }
  // The direction towards the other body, in the body's frame.
  const Vec3 &towards() const { return to_side_.rotation.row[2]; }
  const ContactPolytope &body() const { return *body_; }
  std::size_t vertex_count() const { return vertex_count_; }
  // Of vertex k: where it is.
  Vec3 at(std::size_t k) const { return {x_[k], y_[k], z_[k]}; }
  double height(std::size_t k) const { return z_[k]; }
  const double *places_x() const { return x_.data(); }
  const double *places_y() const { return y_.data(); }
  const double *heights() const { return z_.data(); }
  // The vertices beyond the limit among them.
  std::size_t inside_count() const { return inside_count_; }
  std::int32_t inside(std::size_t k) const { return inside_[k]; }

 private:
  void make_room();
  void start_gathering();
  // Of polytopes that have sets: by looking at all vertices.
  void find_inside(double limit);
  // The vertices beyond a plane hang together: they are found from the farthest one along the edges.
  void find_inside_from_summit(double limit);

  const ContactPolytope *body_ = nullptr;
  Pose to_side_;
  std::int32_t summit_ = 0;  // of polytopes without sets: the vertex that reaches farthest
  double reach_ = 0.0, limit_ = 0.0;
  // Room for the largest polytope so far; the first ones count.
  std::vector<double> x_, y_, z_;
  std::vector<std::int32_t> number_;
  std::vector<std::int32_t> inside_;
  std::size_t vertex_count_ = 0, inside_count_ = 0;
  // Of polytopes that have sets: the vertices beyond the limit, and edges and faces at them.
  std::uint64_t inside_set_ = 0, edge_set_ = 0, face_set_ = 0;
  // For each vertex and face of the polytope the last gathering, of its kind, that met it, and where the vertex is kept.
  struct Mark {
    std::uint32_t gathering = 0;
    std::int32_t place = 0;
  };
  std::vector<Mark> vertex_mark_;
  std::vector<std::uint32_t> face_mark_;
  std::uint32_t gathering_ = 0, face_gathering_ = 0;
};

}  // namespace cmb
