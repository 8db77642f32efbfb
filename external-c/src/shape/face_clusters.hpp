// A polytope's planes in groups that look much the same way.
#pragma once

#include <cstddef>
#include <vector>

#include "shape/polytope.hpp"

namespace cmb {

using convex::Vec3;

// How far a place is below planes is found group by group, and a group's bound tells where that is not worth it. Immutable.
class FaceClusters {
 public:
  // Faces in a group; the last one is filled up with planes that everything is far below.
  static constexpr std::size_t size = 8;

  explicit FaceClusters(const convex::Polytope &polytope);

  std::size_t count() const { return radius_.size(); }
  // Of the planes, group by group: their normals' coordinates along an axis (0 to 2), and their offsets.
  const double *normals(std::size_t axis) const { return planes_.data() + axis * size * count(); }
  const double *offsets() const { return normals(3); }

  // How far the place is below the planes of each group at least; `bounds` has room for count().
  void find_bounds(const Vec3 &place, double *bounds) const;

 private:
  Vec3 center_;
  std::vector<double> planes_;
  // By group: the middle of its normals, axis by axis, their greatest distance from there, the planes' least one from the center.
  std::vector<double> middles_, radius_, nearest_;
};

}  // namespace cmb
