// Walks over two hierarchies at once.
#pragma once

#include <algorithm>
#include <cstdint>

#include "mesh/core/triangle_hierarchy.hpp"

namespace cmb::mesh {

// Calls visit(leaf of a, leaf of b), by their numbers, for the leaves whose bounds are within `reach()` of each other.
// `reach` gives a squared distance, is asked anew at each step, and may shrink: the nearer bounds come first. `b_in_a` is
// the pose of b's frame in a's.
template <typename Reach, typename Visit>
void walk_pairs(const TriangleHierarchy &a, const TriangleHierarchy &b, const Pose &b_in_a, Reach &&reach,
                Visit &&visit) {
  struct Entry {
    std::uint32_t a, b;
    double distance2;
  };
  const Pose a_in_b = b_in_a.inverse();
  // Of all bounds, boxes seen from both frames, the largest distance is the truest one.
  const auto entry_of = [&](std::uint32_t node_a, std::uint32_t node_b) {
    const double flat = least_distance(a.flat_bounds()[node_a], moved(b.flat_bounds()[node_b], b_in_a));
    if (flat * flat > reach()) return Entry{node_a, node_b, flat * flat};
    const Bounds &box_a = a.nodes()[node_a].bounds, &box_b = b.nodes()[node_b].bounds;
    const double in_a = std::max(flat * flat, distance2(box_a, moved(box_b, b_in_a)));
    if (in_a > reach()) return Entry{node_a, node_b, in_a};
    return Entry{node_a, node_b, std::max(in_a, distance2(moved(box_a, a_in_b), box_b))};
  };
  Entry stack[128];  // each step replaces one pair by two, one of them a level deeper; trees are less than 32 deep
  int size = 0;
  stack[size++] = entry_of(0, 0);
  while (size > 0) {
    const Entry entry = stack[--size];
    if (entry.distance2 > reach()) continue;
    const TriangleHierarchy::Node &node_a = a.nodes()[entry.a], &node_b = b.nodes()[entry.b];
    if (node_a.count > 0 && node_b.count > 0) {
      visit(entry.a, entry.b);
      continue;
    }
    // The larger box is opened.
    const bool open_a =
        node_b.count > 0 || (node_a.count == 0 && norm2(node_a.bounds.high - node_a.bounds.low) >=
                                                      norm2(node_b.bounds.high - node_b.bounds.low));
    const Entry first = open_a ? entry_of(node_a.first, entry.b) : entry_of(entry.a, node_b.first);
    const Entry second = open_a ? entry_of(node_a.first + 1, entry.b) : entry_of(entry.a, node_b.first + 1);
    const bool first_nearer = first.distance2 <= second.distance2;
    const Entry &nearer = first_nearer ? first : second, &farther = first_nearer ? second : first;
    if (farther.distance2 <= reach()) stack[size++] = farther;
    if (nearer.distance2 <= reach()) stack[size++] = nearer;
  }
}

}  // namespace cmb::mesh
