#include "mesh/core/triangle_hierarchy.hpp"

#include <algorithm>
#include <numeric>

namespace cmb::mesh {

Bounds bounds_of(const std::vector<Vec3> &points) {
  Bounds box{points[0], points[0]};
  for (const Vec3 &p : points) include(box, p);
  return box;
}

namespace {

// Of the triangles named by `begin` to `end`, whose box is `box`; across the mean of their normals.
CylinderBound flat_bound(const std::vector<Vec3> &vertices, const std::vector<Triangle> &triangles,
                         std::vector<std::uint32_t>::const_iterator begin,
                         std::vector<std::uint32_t>::const_iterator end, const Bounds &box) {
  Vec3 sum;
  for (auto it = begin; it != end; ++it) {
    const Triangle &t = triangles[*it];
    sum = sum + cross(vertices[t[1]] - vertices[t[0]], vertices[t[2]] - vertices[t[0]]);
  }
  CylinderBound bound;
  bound.axis = normalized(sum, {0.0, 0.0, 1.0});
  const Vec3 middle = 0.5 * (box.low + box.high);
  double low = 0.0, high = 0.0, radius2 = 0.0;
  for (auto it = begin; it != end; ++it) {
    for (const std::uint32_t v : triangles[*it]) {
      const Vec3 off = vertices[v] - middle;
      const double height = dot(bound.axis, off);
      low = std::min(low, height);
      high = std::max(high, height);
      radius2 = std::max(radius2, norm2(off - height * bound.axis));
    }
  }
  const double slack = 1e-12 * (norm(box.low) + norm(box.high));
  bound.center = middle + (0.5 * (low + high)) * bound.axis;
  bound.half_thickness = 0.5 * (high - low) + slack;
  bound.radius = std::sqrt(radius2) + slack;
  return bound;
}

}  // namespace

TriangleHierarchy::TriangleHierarchy(const std::vector<Vec3> &vertices, const std::vector<Triangle> &triangles)
    : order_(triangles.size()) {
  std::iota(order_.begin(), order_.end(), 0u);
  std::vector<Vec3> centres(triangles.size());  // three times the centres: only their order matters
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    centres[t] = vertices[triangles[t][0]] + vertices[triangles[t][1]] + vertices[triangles[t][2]];
  }
  nodes_.reserve(triangles.size());
  flat_bounds_.reserve(triangles.size());
  nodes_.push_back({{}, 0, static_cast<std::uint32_t>(triangles.size())});
  // Nodes are appended while their parents are split: a walk over the array reaches them all.
  for (std::size_t n = 0; n < nodes_.size(); ++n) {
    const std::uint32_t first = nodes_[n].first, count = nodes_[n].count;
    const auto begin = order_.begin() + first, end = begin + count;
    const Vec3 &start = vertices[triangles[*begin][0]];
    Bounds box{start, start}, spread{centres[*begin], centres[*begin]};
    for (auto it = begin; it != end; ++it) {
      for (const std::uint32_t v : triangles[*it]) include(box, vertices[v]);
      include(spread, centres[*it]);
    }
    nodes_[n].bounds = box;
    flat_bounds_.push_back(flat_bound(vertices, triangles, begin, end, box));
    if (count <= leaf_size) {
      std::sort(begin, end);
      continue;
    }
    const Vec3 extent = spread.high - spread.low;
    const int axis = extent.x >= extent.y && extent.x >= extent.z ? 0 : (extent.y >= extent.z ? 1 : 2);
    const std::uint32_t half = count / 2;
    std::nth_element(begin, begin + half, end, [&](std::uint32_t i, std::uint32_t j) {
      const double a = centres[i][axis], b = centres[j][axis];
      return a != b ? a < b : i < j;  // a total order: the halves are the same whatever the library
    });
    const auto left = static_cast<std::uint32_t>(nodes_.size());
    nodes_.push_back({{}, first, half});
    nodes_.push_back({{}, first + half, count - half});
    nodes_[n].first = left;
    nodes_[n].count = 0;
  }
}

bool TriangleHierarchy::meets(const Bounds &box, const Vec3 &origin, const Vec3 &direction, double longest) {
  double from = 0.0, to = longest;
  for (int k = 0; k < 3; ++k) {
    if (direction[k] == 0.0) {
      if (origin[k] < box.low[k] || origin[k] > box.high[k]) return false;
      continue;
    }
    const double a = (box.low[k] - origin[k]) / direction[k], b = (box.high[k] - origin[k]) / direction[k];
    from = std::fmax(from, std::fmin(a, b));
    to = std::fmin(to, std::fmax(a, b));
  }
  return from <= to * (1.0 + 1e-12);
}

}  // namespace cmb::mesh
