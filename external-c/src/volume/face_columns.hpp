// The common part of two closed polyhedra, convex or not.
#pragma once

#include <cstdint>
#include <vector>

#include "shape/shape.hpp"
#include "volume/solid_sums.hpp"

namespace cmb::overlap {

// A rectangle of x and y, and z from `low` upwards.
struct Columns {
  double x[2], y[2];
  double low;
};

// The faces of a closed polyhedron that matter above a rectangle, in axes whose z is up.
class FaceSet {
 public:
  struct Face {
    std::int32_t first, count;   // into corners
    double sign;                 // 1 where it looks up, -1 where down
    double z0, zx, zy;           // its plane, z = z0 + zx x + zy y
    double x[2], y[2], z[2];     // bounds
    double height(const Vec3 &p) const;
  };
  void clear() { faces_.clear(), corners_.clear(); }
  // Adds the face with these corners, counter-clockwise seen from outside, unless it is upright, below the columns or beside.
  void add(const Vec3 *corner, std::int32_t count, const Columns &columns);

  const std::vector<Face> &faces() const { return faces_; }
  const std::vector<Vec3> &corners() const { return corners_; }  // counter-clockwise seen from above

 private:
  std::vector<Face> faces_;
  std::vector<Vec3> corners_;
};

// Room to work in; one for each thread. Grows in the first calls.
//
// What lies below a face and above columns.low counts positive where the face looks up and negative where it looks down;
// the common part of two polyhedra is the sum over all pairs of faces of what lies below both. Nothing is looked up
// that rounding could get wrong: what fits badly is off by as much and no more.
class FaceColumns {
 public:
  SolidSums common_part(const FaceSet &a, const FaceSet &b, const Columns &columns);

 private:
  void add_pair(const FaceSet &a, const FaceSet::Face &face_a, const FaceSet &b, const FaceSet::Face &face_b);
  void add_below(const FaceSet::Face &top, const FaceSet::Face &other);
  // Keeps of polygon_ where height(corner) <= 0.
  template <typename Height>
  void keep(Height &&height);

  double low_ = 0.0;
  SolidSums sums_;
  std::vector<Vec3> polygon_, next_, both_;
  std::vector<std::uint32_t> cell_begin_, cell_faces_;
};

}  // namespace cmb::overlap
