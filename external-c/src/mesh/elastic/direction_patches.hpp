// Patches that push in many directions, as few places with the same moments.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "math/lanes.hpp"
#include "math/tetrahedron.hpp"
#include "math/vector3.hpp"

namespace cmb::mesh {

using convex::Mat3;
using convex::Vec3;

// Integrals over one triangle's patches, by area as seen along its normal. Places are relative to an origin of the caller's.
struct PatchSums {
  double area = 0.0;
  double load = 0.0, energy = 0.0;  // of depth and its square
  Vec3 moment;                      // of depth * place
  double second[6] = {};            // of depth * place * place: xx, yy, zz, yz, zx, xy

  void add_triangle(double area, const Vec3 &p, double dp, const Vec3 &q, double dq, const Vec3 &r, double dr);
  // Takes a part of the load, of the same area.
  void scale(double part);
  void add(double part, const PatchSums &other);
  // Where loads of both signs cancel, their places may be anywhere: moments become those of a load in a ball, and stay where they are.
  void keep_within(const Vec3 &center, double radius);
};

// The same of places that stand for an area each, two at once.
class LanePatchSums {
 public:
  void add_places(convex::Lanes area, const convex::LaneVec3 &at, convex::Lanes depth) {
    const convex::Lanes part = area * depth;
    area_ += area, load_ += part, energy_ += part * depth;
    const convex::LaneVec3 first = part * at;
    moment_ = moment_ + first;
    second_[0] += first.x * at.x, second_[1] += first.y * at.y, second_[2] += first.z * at.z;
    second_[3] += first.y * at.z, second_[4] += first.z * at.x, second_[5] += first.x * at.y;
  }
  PatchSums sums() const;

 private:
  convex::Lanes area_ = {}, load_ = {}, energy_ = {};
  convex::LaneVec3 moment_;
  convex::Lanes second_[6] = {};
};

// A part of a contact's load.
struct LoadPoint {
  Vec3 force;  // its length a load
  Vec3 place;
  double depth = 0.0;
};

// Sums of patches by the six directions of the mesh's axes, to which a patch gives the squares of its normal's components. Each
// becomes four points with equal loads whose first and second moments are those of its patches.
class DirectionPatches {
 public:
  static constexpr std::size_t directions = 6, points_each = convex::tetrahedron_corner_count;

  // Takes a part of the load.
  void add(double part, const PatchSums &patch, const Vec3 &normal);
  void add(double part, const DirectionPatches &patches);

  // Appends the points to `points`.
  void append(std::vector<LoadPoint> &points) const;

 private:
  struct Sum {
    PatchSums patch;
    Vec3 force;
  };

  Sum sums_[directions];
};

}  // namespace cmb::mesh
