// A polytope with what its vertices carry in a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "shape/face_clusters.hpp"
#include "shape/polytope.hpp"

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

  // The faces at vertex v, in turn counter-clockwise from outside: [faces_at(v), faces_at(v + 1)).
  const std::int32_t *faces_at(std::int32_t v) const { return vertex_faces_.data() + faces_begin_[static_cast<std::size_t>(v)]; }

  struct Share {
    double value;
    Vec3 gradient;  // the derivative by the direction (of any length)
  };
  // The share of vertex v where the obstacle lies towards `down` (unit, in the polytope's frame); in (0, 1/2).
  Share share(std::int32_t v, const Vec3 &down) const;

  // Whether the share of every vertex is the same for all directions, as for a box.
  bool shares_are_constant() const { return all_constant_; }

  // The greatest cosine of the angle between `direction` (unit, in the polytope's frame) and a face's normal; to 1e-9, where
  // faces are that nearly in one plane.
  double greatest_face_cosine(const Vec3 &direction) const;

  // Corners of the polar body about the center, one for each face: the face's normal divided by its distance from there. Of all faces
  // the one whose corner is farthest along a place's direction from the center is the one beyond which that place is first.
  const std::vector<Vec3> &polar_corners() const { return polar_corners_; }
  // How far all faces' planes are from the center, at least.
  double inner_radius() const { return inner_radius_; }
  // In step with the geometry's face_edges(): the face across with its corner, and where its own edges are, so that who goes on
  // there looks nowhere else.
  struct FaceAcross {
    Vec3 polar_corner;
    std::int32_t face, first, count;
  };
  const std::vector<FaceAcross> &faces_across() const { return faces_across_; }

  // Vertices for each metre of the polytope's width, 1/m: how finely it is tessellated.
  double fineness() const { return fineness_; }

  // The edges and faces at a vertex as sets, a bit each; only where the polytope has no more edges than `most_in_set`, so
  // that its vertices and faces are sets as well.
  static constexpr std::size_t most_in_set = 64;
  struct Incidence {
    std::uint64_t edges = 0, faces = 0;
  };
  bool has_sets() const { return !incidence_.empty(); }
  // Where it has sets: the vertices' coordinates along an axis (0 to 2).
  const double *coordinates(std::size_t axis) const { return coordinates_.data() + axis * geometry_.vertices().size(); }
  const Incidence &incidence(std::int32_t v) const { return incidence_[static_cast<std::size_t>(v)]; }

  // Its planes.
  const FaceClusters &clusters() const { return geometry_.clusters(); }

 private:
  void build_sets();
  void build_polar();

  // A face as one of its vertices sees it: its normal, so that those of a vertex stand together, and the vertex' share in it.
  struct FaceShare {
    Vec3 normal;
    double share;
  };

  convex::Polytope geometry_;
  std::vector<std::int32_t> vertex_faces_;
  std::vector<FaceShare> face_shares_;      // in step
  std::vector<std::int32_t> faces_begin_;   // vertex -> its first face among them
  std::vector<double> constant_;            // share where it does not depend on the direction, else -1
  bool all_constant_ = true;
  double fineness_ = 0.0, inner_radius_ = 0.0;
  std::vector<Incidence> incidence_;
  std::vector<double> coordinates_, normal_coordinates_;  // of vertices and of faces, axis by axis
  // Of others: the hull of the faces' normals, whose vertex that is farthest along a direction is the nearest normal. Without
  // vertices where it could not be made.
  convex::Polytope normals_;
  std::vector<Vec3> polar_corners_;
  std::vector<FaceAcross> faces_across_;
};

}  // namespace cmb
