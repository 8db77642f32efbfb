// The triangle of a mesh that a body apart from it is nearest to.
#pragma once

#include <cstdint>
#include <limits>

#include "manifold/contact_set.hpp"
#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// Between a triangle and a body; in the mesh's frame.
struct TriangleGap {
  double distance = 0.0;  // m, 0 where they meet
  Vec3 on_triangle, on_body;
};

// The least of the gaps offered. Of equal ones the triangle with the smallest number has it, so that their order does not
// matter. Borrows the mesh.
class NearestTriangle {
 public:
  explicit NearestTriangle(const TriangleMesh &mesh) : mesh_(mesh) {}

  double distance() const { return gap_.distance; }
  // Returns whether this is the least so far.
  bool offer(const TriangleGap &gap, std::uint32_t t) {
    const bool least = gap.distance < gap_.distance || (gap.distance == gap_.distance && t < triangle_);
    if (least) {
      gap_ = gap;
      triangle_ = t;
    }
    return least;
  }
  // Asks offer(t) for each triangle that may be nearer than those offered so far to a body in the box, beginning with `first`, until
  // one meets it. Returns whether none does.
  template <typename Offer>
  bool search(const Bounds &box, std::uint32_t first, Offer &&offer) const {
    return search(box, first, [](const Bounds &) { return false; }, offer);
  }
  // The same, but leaves out triangles in boxes that is_farther(box) says are farther than those offered so far.
  template <typename IsFarther, typename Offer>
  bool search(const Bounds &box, std::uint32_t first, IsFarther &&is_farther, Offer &&offer) const {
    offer(first);
    mesh_.hierarchy().visit_near_unless(
        box, [&] { return distance() > 0.0 ? distance() * distance() : -1.0; }, is_farther,
        [&](std::uint32_t t) {
          if (distance() > 0.0) offer(t);
        });
    return distance() > 0.0;
  }
  // Unit, from the mesh to the body: the triangle's normal where they meet.
  Vec3 direction() const { return normalized(gap_.on_body - gap_.on_triangle, mesh_.face_normal(triangle_)); }
  // Sets distance, normal and witness; `pose` is the mesh's.
  void write(const Pose &pose, ContactSet &result) const {
    result.distance = gap_.distance;
    result.normal = pose.rotation * direction();
    result.witness = pose(0.5 * (gap_.on_body + gap_.on_triangle));
  }

 private:
  const TriangleMesh &mesh_;
  TriangleGap gap_{std::numeric_limits<double>::infinity(), {}, {}};
  std::uint32_t triangle_ = 0;
};

}  // namespace cmb::mesh
