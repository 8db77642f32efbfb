// A polytope's planes in groups that look much the same way.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

  // The numbers of a group's faces.
  struct Faces {
    const std::int32_t *first, *last;
    const std::int32_t *begin() const { return first; }
    const std::int32_t *end() const { return last; }
  };
  Faces faces(std::size_t g) const { return {order_.data() + begin_[g], order_.data() + begin_[g + 1]}; }
  // By group: of balls that hold the faces the centers' coordinates along an axis (0 to 2), and the radii.
  const double *ball_centers(std::size_t axis) const { return balls_.data() + axis * count(); }
  const double *ball_radii() const { return ball_centers(3); }

  // Visits the groups below whose planes the place may be no farther than depth(), which is asked anew at each. Stops, and returns false,
  // where visit(group) does.
  template <typename Depth, typename Visit>
  bool visit_groups_near(const Vec3 &place, Depth &&depth, Visit &&visit) const {
    constexpr double rounding = 1e-12;
    const std::size_t groups = count();
    const Vec3 way = place - center_;
    const double length = norm(way);
    const double *const x = middles_.data(), *const y = x + groups, *const z = y + groups;
    for (std::size_t g = 0; g < groups; ++g) {
      const double bound = nearest_[g] - (x[g] * way.x + y[g] * way.y + z[g] * way.z) - length * radius_[g];
      if (!(bound > depth() + rounding * (length + nearest_[g])) && !visit(g)) return false;
    }
    return true;
  }
  // The same of the groups' faces.
  template <typename Visit>
  bool visit_near(const Vec3 &place, double depth, Visit &&visit) const {
    const auto visit_faces = [&](std::size_t g) {
      const Faces of_group = faces(g);
      return std::all_of(of_group.begin(), of_group.end(), visit);
    };
    return visit_groups_near(place, [depth] { return depth; }, visit_faces);
  }

 private:
  Vec3 center_;
  std::vector<std::int32_t> order_;  // the faces, group by group
  std::vector<std::size_t> begin_;   // of each group, and the end
  std::vector<double> balls_;
  std::vector<double> planes_;
  // By group: the middle of its normals, axis by axis, their greatest distance from there, the planes' least one from the center.
  std::vector<double> middles_, radius_, nearest_;
};

}  // namespace cmb
