// The part of a polytope near a contact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/contact_polytope.hpp"

namespace cmb {

using convex::Pose;

// A small motion that leaves no two edges parallel and no corner flush with an edge: which corners lie where is decided
// as if one body had been moved so. Depths and positions are those of the true pose.
struct Shake {
  Vec3 turn, shift;  // rad, m
  Vec3 operator()(const Vec3 &p) const { return p + cross(turn, p) + shift; }
  Vec3 direction(const Vec3 &d) const { return d + cross(turn, d); }
};

// A polytope's vertices that reach beyond a limit towards the other body, the edges and faces at them, and the edges'
// other ends; in the contact's axes, z along the contact normal.
class PolytopeSide {
 public:
  struct Vertex {
    Vec3 at, shaken;
    std::int32_t number = 0;  // in the polytope
    bool inside = false;      // beyond the limit; else the other end of an edge
  };
  struct Edge {
    std::int32_t vertex[2], face[2];  // into vertices() and faces()
    std::int32_t number;
  };
  struct Face {
    Vec3 normal, shaken_normal;
    double offset, shaken_offset;
    std::int32_t number;
  };

  // Gathers what of `body` lies beyond `limit`: sense * z > limit, `sense` being +1 where the other body lies above
  // and -1 where it lies below.
  void gather(const ContactPolytope &body, const Pose &to_contact, double sense, double limit, const Shake &shake);

  // How far the body reaches: the greatest sense * z.
  static double reach(const ContactPolytope &body, const Pose &to_contact, double sense);

  const ContactPolytope &body() const { return *body_; }
  const Pose &to_contact() const { return to_contact_; }
  double sense() const { return sense_; }
  const Shake &shake() const { return shake_; }
  const std::vector<Vertex> &vertices() const { return vertices_; }
  const std::vector<Edge> &edges() const { return edges_; }
  const std::vector<Face> &faces() const { return faces_; }

 private:
  std::int32_t add_vertex(std::int32_t number, double limit);
  std::int32_t add_face(std::int32_t number, std::int32_t corner);

  const ContactPolytope *body_ = nullptr;
  Pose to_contact_;
  double sense_ = 1.0;
  Shake shake_;
  std::vector<Vertex> vertices_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  // For each vertex, edge and face of the polytope the last gathering that met it, and where it is kept.
  struct Mark {
    std::uint32_t gathering = 0;
    std::int32_t place = 0;
  };
  std::vector<Mark> vertex_mark_, edge_mark_, face_mark_;
  std::uint32_t gathering_ = 0;
};

}  // namespace cmb
