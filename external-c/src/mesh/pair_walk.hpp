// Walks over two hierarchies at once.
#pragma once

#include <cstdint>

#include "mesh/triangle_hierarchy.hpp"

namespace cmb::mesh {

// Calls visit(leaf of a, leaf of b) for the leaves whose boxes are within `reach()` of each other. `reach` gives a
// squared distance, is asked anew at each step, and may shrink: the nearer boxes come first. `b_in_a` is the pose of b's
// frame in a's.
template <typename Reach, typename Visit>
void walk_pairs(const TriangleHierarchy &a, const TriangleHierarchy &b, const Pose &b_in_a, Reach &&reach,
                Visit &&visit) {
  struct Entry {
    std::uint32_t a, b;
    double distance2;
  };
  Entry stack[128];  // each step replaces one pair by two, one of them a level deeper; trees are less than 32 deep
  int size = 0;
  stack[size++] = {0, 0, distance2(a.bounds(), moved(b.bounds(), b_in_a))};
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance2 > reach()) continue;
    const TriangleHierarchy::Node &node_a = a.nodes()[entry.a], &node_b = b.nodes()[entry.b];
    if (node_a.count > 0 && node_b.count > 0) {
      visit(node_a, node_b);
      continue;
    }
    // The larger box is opened.
    const bool open_a =
        node_b.count > 0 || (node_a.count == 0 && norm2(node_a.bounds.high - node_a.bounds.low) >=
                                                      norm2(node_b.bounds.high - node_b.bounds.low));
    Entry first = entry, second = entry;
    if (open_a) {
      first.a = node_a.first;
      second.a = node_a.first + 1;
      const Bounds box_b = moved(node_b.bounds, b_in_a);
      first.distance2 = distance2(a.nodes()[first.a].bounds, box_b);
      second.distance2 = distance2(a.nodes()[second.a].bounds, box_b);
    } else {
      first.b = node_b.first;
      second.b = node_b.first + 1;
      first.distance2 = distance2(node_a.bounds, moved(b.nodes()[first.b].bounds, b_in_a));
      second.distance2 = distance2(node_a.bounds, moved(b.nodes()[second.b].bounds, b_in_a));
    }
    const bool first_nearer = first.distance2 <= second.distance2;
    const double farthest2 = reach();
    const Entry &nearer = first_nearer ? first : second, &farther = first_nearer ? second : first;
    if (farther.distance2 <= farthest2) stack[size++] = farther;
    if (nearer.distance2 <= farthest2) stack[size++] = nearer;
  }
}

}  // namespace cmb::mesh
