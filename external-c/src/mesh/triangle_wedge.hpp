// What lies behind a triangle of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/triangle_mesh.hpp"

namespace cmb::mesh {

// The part of space behind a triangle, between the planes that halve the angles to its neighbours, down to a depth. The
// wedges of neighbours share sides, so that they divide a body's surface among them. In the mesh's frame.
class TriangleWedge {
 public:
  // `deepest`: no depth counts beyond it, nor beyond the mesh's depth limit for the triangle.
  TriangleWedge(const TriangleMesh &mesh, std::uint32_t t, double deepest) { build(mesh, t, deepest, nullptr, 0.0); }

  // A wedge to be built later.
  TriangleWedge() = default;
  // The same, but gives up and returns false as soon as it shows that no point of the ball lies in the wedge.
  bool build_if_it_meets(const TriangleMesh &mesh, std::uint32_t t, double deepest, const Vec3 &center, double radius) {
    return build(mesh, t, deepest, &center, radius);
  }

  std::uint32_t triangle() const { return triangle_; }
  const Vec3 &normal() const { return normal_; }
  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }

  // False where no point of the triangle lies between the wedge's sides and behind its triangle; true where one may.
  bool may_meet(const Vec3 (&corner)[3]) const;

  // Keeps the part of the polygon in the wedge; `room` is overwritten. Returns the depth of what lies deeper than
  // `deepest`, but not than the mesh's own limit; 0 where nothing does.
  double clip(std::vector<Vec3> &polygon, std::vector<Vec3> &room) const;

 private:
  bool build(const TriangleMesh &mesh, std::uint32_t t, double deepest, const Vec3 *center, double radius);

  std::uint32_t triangle_ = 0;
  Vec3 normal_;
  double offset_ = 0.0, limit_ = 0.0;
  bool limited_ = false;  // by `deepest`
  Vec3 side_[3];          // inward, not unit
  double side_offset_[3] = {};
};

// Keeps the part of the polygon with normal . x >= offset; `room` is overwritten.
void clip_polygon(std::vector<Vec3> &polygon, const Vec3 &normal, double offset, std::vector<Vec3> &room);

}  // namespace cmb::mesh
