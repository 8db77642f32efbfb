// A hierarchy of axis-aligned boxes over triangles.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "mesh/core/cylinder_bound.hpp"
#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

struct Bounds {
  Vec3 low, high;
};

// A box seen from another frame: the box there that holds it.
inline Bounds moved(const Bounds &box, const Pose &pose) {
  const Vec3 middle = pose(0.5 * (box.low + box.high)), half = 0.5 * (box.high - box.low);
  Vec3 reach;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &row = pose.rotation.row[k];
    reach.set(k, std::fabs(row.x) * half.x + std::fabs(row.y) * half.y + std::fabs(row.z) * half.z);
  }
  return {middle - reach, middle + reach};
}

// The box of points, of which there is one at least.
Bounds bounds_of(const std::vector<Vec3> &points);

// Makes the box hold p.
inline void include(Bounds &box, const Vec3 &p) {
  for (int k = 0; k < 3; ++k) {
    box.low.set(k, std::min(box.low[k], p[k]));
    box.high.set(k, std::max(box.high[k], p[k]));
  }
}

inline Bounds bounds_of(const Vec3 (&corners)[3]) {
  Bounds box{corners[0], corners[0]};
  include(box, corners[1]);
  include(box, corners[2]);
  return box;
}

// Distance of two boxes, squared; 0 where they meet.
inline double distance2(const Bounds &a, const Bounds &b) {
  double sum = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double gap = std::max(0.0, std::max(a.low[k] - b.high[k], b.low[k] - a.high[k]));
    sum += gap * gap;
  }
  return sum;
}

// Immutable; shared by threads. Split at medians, so that its depth is that of the logarithm of the triangles' number,
// and the same for the same input.
class TriangleHierarchy {
 public:
  static constexpr std::uint32_t leaf_size = 8;  // triangles in a leaf, at most

  TriangleHierarchy(const std::vector<Vec3> &vertices, const std::vector<Triangle> &triangles);

  const Bounds &bounds() const { return nodes_[0].bounds; }

  // Calls visit(triangle) for the triangles of all leaves whose boxes are within `reach()` of `box`. `reach` gives a
  // squared distance, is asked anew at each node, and may shrink as triangles are visited: the nearer child comes first.
  template <typename Reach, typename Visit>
  void visit_near(const Bounds &box, Reach &&reach, Visit &&visit) const {
    visit_near_unless(box, reach, [](const Bounds &) { return false; }, visit);
  }

  // The same, but for nodes of whose boxes skip(bounds) says, asked anew at each node, that nothing in them matters.
  template <typename Reach, typename Skip, typename Visit>
  void visit_near_unless(const Bounds &box, Reach &&reach, Skip &&skip, Visit &&visit) const {
    visit_nodes(box, reach, [&](std::uint32_t node) { return skip(nodes_[node].bounds); }, visit);
  }

  // The same, skip being asked by the node's number.
  template <typename Reach, typename Skip, typename Visit>
  void visit_nodes(const Bounds &box, Reach &&reach, Skip &&skip, Visit &&visit) const {
    struct Entry {
      std::uint32_t node;
      double distance2;
    };
    Entry stack[64];  // the tree is less than 32 deep
    int size = 0;
    stack[size++] = {0, distance2(nodes_[0].bounds, box)};
    while (size > 0) {
      const Entry entry = stack[--size];
      if (entry.distance2 > reach()) continue;
      if (skip(entry.node)) continue;
      const Node &node = nodes_[entry.node];
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
        continue;
      }
      const Entry left{node.first, distance2(nodes_[node.first].bounds, box)};
      const Entry right{node.first + 1, distance2(nodes_[node.first + 1].bounds, box)};
      const bool left_first = left.distance2 <= right.distance2;
      stack[size++] = left_first ? right : left;
      stack[size++] = left_first ? left : right;
    }
  }

  // Calls visit(triangle) for the triangles of all leaves that the ray origin + s direction, 0 <= s <= longest(), meets.
  template <typename Longest, typename Visit>
  void visit_along(const Vec3 &origin, const Vec3 &direction, Longest &&longest, Visit &&visit) const {
    std::uint32_t stack[64];
    int size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const Node &node = nodes_[stack[--size]];
      if (!meets(node.bounds, origin, direction, longest())) continue;
      if (node.count > 0) {
        for (std::uint32_t i = node.first; i < node.first + node.count; ++i) visit(order_[i]);
      } else {
        stack[size++] = node.first + 1;
        stack[size++] = node.first;
      }
    }
  }

  struct Node {
    Bounds bounds;
    std::uint32_t first = 0;  // leaf: into order(); else: left child, the right one follows it
    std::uint32_t count = 0;  // of triangles; 0 where the node has children
  };
  // The root is nodes()[0]; a walk needs a stack of at most 64 nodes.
  const std::vector<Node> &nodes() const { return nodes_; }
  // Of the node with the same number; wide enough for the rounding of moves by about the mesh's size.
  const std::vector<CylinderBound> &flat_bounds() const { return flat_bounds_; }
  const std::vector<std::uint32_t> &order() const { return order_; }

 private:
  static bool meets(const Bounds &box, const Vec3 &origin, const Vec3 &direction, double longest);

  std::vector<Node> nodes_;
  std::vector<CylinderBound> flat_bounds_;
  std::vector<std::uint32_t> order_;
};

}  // namespace cmb::mesh
