// Points in boxes within boxes, for questions about planes.
#pragma once

#include <cstddef>
#include <vector>

#include "math/vector3.hpp"

namespace cmb {

// Immutable. A question costs the points near the plane, not all.
class PointGroups {
 public:
  explicit PointGroups(std::vector<convex::Vec3> points);

  // Whether dot(normal, p) > offset for a point p.
  bool any_beyond(const convex::Vec3 &normal, double offset) const;

 private:
  struct Node {
    convex::Vec3 center, half;         // of the box about its points
    std::size_t begin, end, next = 0;  // its points; the first node that is none of its parts
  };

  void divide(std::size_t begin, std::size_t end);

  std::vector<convex::Vec3> points_;
  std::vector<Node> nodes_;  // each before its parts
};

}  // namespace cmb
