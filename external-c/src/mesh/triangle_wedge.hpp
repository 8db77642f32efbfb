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
  TriangleWedge(const TriangleMesh &mesh, std::uint32_t t, double deepest);

  std::uint32_t triangle() const { return triangle_; }
  const Vec3 &normal() const { return normal_; }
  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }

  // False where no point of the ball lies in the wedge; true where one may.
  bool may_meet(const Vec3 &center, double radius) const;

  // Keeps the part of the polygon in the wedge; `room` is overwritten.
  void clip(std::vector<Vec3> &polygon, std::vector<Vec3> &room) const;

 private:
  std::uint32_t triangle_;
  Vec3 normal_;
  double offset_, limit_;
  Vec3 side_[3];  // inward, not unit
  double side_offset_[3];
};

// Keeps the part of the polygon with normal . x >= offset; `room` is overwritten.
void clip_polygon(std::vector<Vec3> &polygon, const Vec3 &normal, double offset, std::vector<Vec3> &room);

}  // namespace cmb::mesh
