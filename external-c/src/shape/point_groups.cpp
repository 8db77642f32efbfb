#include "shape/point_groups.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cmb {

namespace {

using convex::Vec3;

constexpr std::size_t least_divided = 16;

}  // namespace

PointGroups::PointGroups(std::vector<Vec3> points) : points_(std::move(points)) {
  if (!points_.empty()) divide(0, points_.size());
}

void PointGroups::divide(std::size_t begin, std::size_t end) {
  Vec3 low = points_[begin], high = low;
  for (std::size_t k = begin; k < end; ++k) {
    for (int axis = 0; axis < 3; ++axis) {
      low.set(axis, std::min(low[axis], points_[k][axis]));
      high.set(axis, std::max(high[axis], points_[k][axis]));
    }
  }
  const Vec3 extent = high - low;
  const std::size_t node = nodes_.size();
  nodes_.push_back({0.5 * (low + high), 0.5 * extent, begin, end});
  if (end - begin >= least_divided) {
    const int widest = extent.x >= extent.y && extent.x >= extent.z ? 0 : extent.y >= extent.z ? 1 : 2;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return points_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end),
                     [widest](const Vec3 &a, const Vec3 &b) { return a[widest] < b[widest]; });
    divide(begin, middle);
    divide(middle, end);
  }
  nodes_[node].next = nodes_.size();
}

bool PointGroups::any_beyond(const Vec3 &normal, double offset) const {
  for (std::size_t k = 0; k < nodes_.size();) {
    const Node &node = nodes_[k];
    const double farthest = dot(normal, node.center) + std::fabs(normal.x) * node.half.x +
                            std::fabs(normal.y) * node.half.y + std::fabs(normal.z) * node.half.z;
    const bool is_leaf = node.next == k + 1;
    if (!(farthest > offset)) {
      k = node.next;
      continue;
    }
    if (is_leaf) {
      for (std::size_t p = node.begin; p < node.end; ++p) {
        if (dot(normal, points_[p]) > offset) return true;
      }
    }
    ++k;
  }
  return false;
}

}  // namespace cmb
