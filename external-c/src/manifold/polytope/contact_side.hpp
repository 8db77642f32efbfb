// The part of a polytope near a contact.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shape/contact_polytope.hpp"

namespace cmb {

using convex::Pose;

// A small motion: a turn about the origin and a shift. Any but none turns about all three axes.
struct Perturbation {
  Vec3 turn, shift;  // rad, m
  Vec3 operator()(const Vec3 &p) const { return p + cross(turn, p) + shift; }
  bool is_none() const { return turn.x == 0.0; }
};

// A rectangle in the contact plane.
struct Extent {
  double low_x = HUGE_VAL, high_x = -HUGE_VAL, low_y = HUGE_VAL, high_y = -HUGE_VAL;

  void add(const Vec3 &p) {
    low_x = p.x < low_x ? p.x : low_x;
    high_x = p.x > high_x ? p.x : high_x;
    low_y = p.y < low_y ? p.y : low_y;
    high_y = p.y > high_y ? p.y : high_y;
  }
  void add(const Extent &other) {
    low_x = other.low_x < low_x ? other.low_x : low_x;
    high_x = other.high_x > high_x ? other.high_x : high_x;
    low_y = other.low_y < low_y ? other.low_y : low_y;
    high_y = other.high_y > high_y ? other.high_y : high_y;
  }
  static Extent of(const Vec3 &p, const Vec3 &q) {
    return {p.x < q.x ? p.x : q.x, p.x > q.x ? p.x : q.x, p.y < q.y ? p.y : q.y, p.y > q.y ? p.y : q.y};
  }
  bool holds(const Vec3 &p) const { return (p.x >= low_x) & (p.x <= high_x) & (p.y >= low_y) & (p.y <= high_y); }
  bool meets(const Extent &other) const {
    return (low_x <= other.high_x) & (other.low_x <= high_x) & (low_y <= other.high_y) & (other.low_y <= high_y);
  }
};

// A polytope's vertices that reach beyond a limit towards the other body, the edges at them and the edges' other ends. All in
// the side's axes: x and y in the contact plane, z towards the other body.
class ContactSide {
 public:
  struct Edge {
    std::int32_t vertex[2];  // the numbers of gathered ones
    std::int32_t number;     // in the polytope
    Extent extent;           // of its part beyond the limit
  };
  // A face's plane over the contact plane: z = height - slope_x x - slope_y y.
  struct Plane {
    double slope_x, slope_y, height;
    double over(const Vec3 &p) const { return height - slope_x * p.x - slope_y * p.y; }
  };

  // `to_side` maps the body's frame to the side's axes, which mirrors the body where the other one lies below. The body is
  // seen as if it had been perturbed.
  void place(const ContactPolytope &body, const Pose &to_side, const Perturbation &perturbation);
  // Gathers what lies beyond `limit`: z > limit.
  void gather(double limit);
  // The same but for edges, and but for vertices at the limit or before it; of bodies that are not perturbed.
  void gather_inside(double limit);
  // After that: the first ones of `outline`, so many as are returned, become the corners of the part beyond the limit, z times `sense`
  // (1 or -1).
  std::size_t outline(double sense, std::vector<Vec3> &outline) const;

  double limit() const { return limit_; }
  // The faces that reach beyond the limit.
  void near_faces(std::vector<std::int32_t> &faces);

  // How far the body reaches: its greatest z.
  double reach() const { return reach_; }
  // The direction towards the other body, in the body's frame.
  const Vec3 &towards() const { return to_side_.rotation.row[2]; }
  // 1 less the cosine of the angle between the contact plane and the face that is most level.
  double lean() const { return std::fmax(0.0, 1.0 - body_->greatest_face_cosine(towards())); }

  const ContactPolytope &body() const { return *body_; }
  const Pose &to_side() const { return to_side_; }
  std::size_t vertex_count() const { return vertex_count_; }
  // Of vertex k: its number in the polytope and where it is; of all, where in the contact plane they are seen.
  std::int32_t number(std::size_t k) const { return number_[k]; }
  Vec3 at(std::size_t k) const { return {x_[k], y_[k], z_[k]}; }
  double height(std::size_t k) const { return z_[k]; }
  const double *heights() const { return z_.data(); }
  const double *seen_x() const { return perturbation_.is_none() ? x_.data() : perturbed_x_.data(); }
  const double *seen_y() const { return perturbation_.is_none() ? y_.data() : perturbed_y_.data(); }
  // The vertices beyond the limit among them.
  std::size_t inside_count() const { return inside_count_; }
  std::int32_t inside(std::size_t k) const { return inside_[k]; }
  std::size_t edge_count() const { return edge_count_; }
  const Edge &edge(std::size_t k) const { return edges_[k]; }
  // Of what lies beyond the limit.
  const Extent &extent() const { return extent_; }
  // The plane of the face that is seen over a place of the contact plane; false where there is none beyond the limit of the
  // gathering, or where what is at that place as high as `height` is not deeper than `level`, all faces but level ones
  // being taken for steeper by `slack` (m) than they are, beside what the body is seen moved.
  bool face_over(double seen_x, double seen_y, double height, double level, double slack, Plane &plane);

 private:
  void make_room();
  void start_gathering();
  // Of polytopes that have sets: by looking at all vertices.
  void find_inside(double limit);
  void gather_by_sets(double limit);
  // The vertices beyond a plane hang together: they are found from the farthest one along the edges.
  void find_inside_from_summit(double limit);
  void gather_from_summit(double limit);
  void find_seen();

  const ContactPolytope *body_ = nullptr;
  Pose to_side_;
  Perturbation perturbation_;
  std::int32_t summit_ = 0;  // of polytopes without sets: the vertex that reaches farthest
  double reach_ = 0.0, limit_ = 0.0;
  // Room for the largest polytope so far; the first ones count.
  std::vector<double> x_, y_, z_, perturbed_x_, perturbed_y_;
  std::vector<std::int32_t> number_;
  std::vector<Edge> edges_;
  std::vector<std::int32_t> inside_;
  std::size_t vertex_count_ = 0, inside_count_ = 0, edge_count_ = 0;
  Extent extent_;
  // The faces at the vertices beyond the limit, gathered where asked for: those towards the other body, with the inverse
  // cosine of their inclination, and the others, of which only the border counts. In the body's frame, so that no face
  // need be turned.
  struct UpFace {
    const Vec3 *normal;
    double offset, inverse_cosine;
  };
  struct Wall {
    const Vec3 *normal;
    double offset, cosine;
  };
  void gather_faces();
  template <typename Take>
  void each_near_face(const Take &take);
  bool faces_gathered_ = false;
  Pose perturbed_to_side_;
  std::vector<UpFace> up_faces_;
  std::vector<Wall> walls_;
  std::size_t up_face_count_ = 0, wall_count_ = 0;
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
