// A polytope with what its vertices carry in a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "convex/polytope.hpp"

namespace cmb {

using convex::Vec3;

// Immutable; shared by threads.
//
// In a face that rests wholly, corner v carries the share theta / (2 pi), theta being the exterior
// angle of the face's polygon at v: the shares of a face sum to 1. A vertex belongs to several faces;
// between them its share changes smoothly with the direction the load comes from.
class ContactPolytope {
 public:
  explicit ContactPolytope(convex::Polytope geometry);
  // The convex bodies made of it borrow the geometry: it must not move.
  ContactPolytope(const ContactPolytope &) = delete;
  ContactPolytope &operator=(const ContactPolytope &) = delete;

  const convex::Polytope &geometry() const { return geometry_; }

  // Share of vertex v where the obstacle lies towards `down` (unit, in the polytope's frame);
  // in (0, 1/2). `gradient` (may be null) receives its derivative by `down` (of any length).
  double share(std::int32_t v, const Vec3 &down, Vec3 *gradient = nullptr) const;

  // Whether the share of vertex v is the same for all directions, as for every box.
  bool share_is_constant(std::int32_t v) const { return constant_[static_cast<std::size_t>(v)] >= 0.0; }

  // Whether that holds for all vertices.
  bool shares_are_constant() const { return all_constant_; }

  // The greatest cosine of the angle between `direction` (unit, in the polytope's frame) and a face's normal; found by
  // climbing from face to face from vertex `start`, the farthest one along that direction.
  double greatest_face_cosine(const Vec3 &direction, std::int32_t start) const;

  // Vertices for each metre of the polytope's width, 1/m: how finely it is tessellated.
  double fineness() const { return fineness_; }

  // The normals of the faces at vertex v, in turn: faces_at(v) of them.
  std::size_t faces_at(std::int32_t v) const {
    return static_cast<std::size_t>(corner_begin_[static_cast<std::size_t>(v) + 1] -
                                    corner_begin_[static_cast<std::size_t>(v)]);
  }
  const Vec3 &face_normal_at(std::int32_t v, std::size_t i) const {
    return corners_[static_cast<std::size_t>(corner_begin_[static_cast<std::size_t>(v)]) + i].normal;
  }

  // The solid angle of vertex v's whole normal cone.
  double normal_cone(std::int32_t v) const { return normal_cone_[static_cast<std::size_t>(v)]; }

 private:
  struct Corner {
    Vec3 normal;         // of the face
    double share = 0.0;  // of the vertex in this face
    std::int32_t face = 0;
  };
  convex::Polytope geometry_;
  std::vector<Corner> corners_;             // in turn round each vertex, counter-clockwise from outside
  std::vector<std::int32_t> corner_begin_;  // vertex -> first corner
  std::vector<double> constant_;            // share where it does not depend on the direction, else -1
  bool all_constant_ = true;
  double fineness_ = 0.0;
  std::vector<double> normal_cone_;         // solid angle of the whole cone
};

}  // namespace cmb
