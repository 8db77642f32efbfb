// What lies behind a triangle of a mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/core/triangle_mesh.hpp"

namespace cmb::mesh {

// The plane that halves the angle between triangle t and the one beyond its side k; at a border upright on the triangle.
// The mesh keeps them (TriangleMesh::wedge_sides). The planes of the two triangles beside a side are each other's opposites
// to the bit.
WedgeSide make_wedge_side(const TriangleMesh &mesh, std::uint32_t t, std::size_t k);
// What lies in the plane counts for one of the two triangles: whether it is not t.
bool gives_side_away(const TriangleMesh &mesh, std::uint32_t t, std::size_t k);

// The part of space behind a triangle, between the planes that halve the angles to its neighbours, down to a depth. The
// wedges of neighbours share sides, so that they divide a body's surface among them. In the mesh's frame. Borrows the mesh.
class TriangleWedge {
 public:
  // `deepest`: no depth counts beyond it, nor beyond the mesh's depth limit for the triangle.
  TriangleWedge(const TriangleMesh &mesh, std::uint32_t t, double deepest);

  // False where all corners of a triangle lie beyond one of the wedge's planes.
  bool may_meet(const Vec3 (&corner)[3]) const;

  // Corners whose convex hull holds the wedge: the triangle's, and where the lines down from them end at the greatest depth.
  // False where there are none: a line runs level, or nearly.
  bool hull(Vec3 (&corner)[6]) const;

  std::uint32_t triangle() const { return triangle_; }
  const Vec3 &normal() const { return normal_; }
  double depth(const Vec3 &p) const { return offset_ - dot(normal_, p); }

  // Keeps the part of the polygon in the wedge; `room` is overwritten.
  void clip(std::vector<Vec3> &polygon, std::vector<Vec3> &room) const;
  // Of what clip() has left, keeps what is nearer to the plane of the triangle's flat face than to those beyond its sides. So
  // what is behind a flat face does not depend on its triangles.
  void clip_roof(std::vector<Vec3> &polygon, std::vector<Vec3> &room) const {
    const PlanarFaces::Roof roof = mesh_->faces().roof(triangle_);
    if (roof.begin != roof.end) clip_roof(roof, polygon, room);
  }

 private:
  void build_front(const TriangleMesh &mesh, std::uint32_t t, double deepest);
  void clip_roof(const PlanarFaces::Roof &roof, std::vector<Vec3> &polygon, std::vector<Vec3> &room) const;
  void build_side(const TriangleMesh &mesh, std::size_t k);

  const TriangleMesh *mesh_ = nullptr;
  std::uint32_t triangle_ = 0;
  Vec3 normal_;
  double offset_ = 0.0, limit_ = 0.0;
  Vec3 side_[3];          // inward, not unit
  double side_offset_[3] = {};
};

// Keeps the part of the polygon with normal . x >= offset; `room` is overwritten.
void clip_polygon(std::vector<Vec3> &polygon, const Vec3 &normal, double offset, std::vector<Vec3> &room);

}  // namespace cmb::mesh
