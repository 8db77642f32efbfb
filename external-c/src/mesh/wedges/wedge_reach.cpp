#include "mesh/wedges/wedge_reach.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

// Of one wedge: down from the triangle's corners run the lines in which its sides meet.
double spread_of(const Vec3 &normal, const std::array<WedgeSide, 3> &sides) {
  double spread = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 line = cross(sides[k].normal, sides[(k + 2) % 3].normal);
    const double down = std::fabs(dot(line, normal));
    spread = std::fmax(spread, down > 0.0 ? norm(line) / down : HUGE_VAL);
  }
  return spread;
}

constexpr double widened = 1.0 + 1e-6, rounding = 1e-9;  // more than rounding adds
constexpr double least_steepness = 0.05;

}  // namespace

WedgeReach::WedgeReach(const MeshData &data, const std::vector<Vec3> &normals, const std::vector<std::array<WedgeSide, 3>> &sides,
                       const std::vector<double> &beyond_folds, const TriangleHierarchy &hierarchy) {
  const std::vector<TriangleHierarchy::Node> &nodes = hierarchy.nodes();
  bundles_.resize(nodes.size());
  std::vector<std::uint32_t> triangles, open;
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    triangles.clear();
    open.assign(1, i);
    while (!open.empty()) {
      const TriangleHierarchy::Node &node = nodes[open.back()];
      open.pop_back();
      if (node.count == 0) open.insert(open.end(), {node.first, node.first + 1});
      for (std::uint32_t k = 0; k < node.count; ++k) triangles.push_back(hierarchy.order()[node.first + k]);
    }
    Bundle &bundle = bundles_[i];
    Vec3 sum;
    for (const std::uint32_t t : triangles) sum = sum + normals[t];
    bundle.axis = normalized(sum, Vec3{0.0, 0.0, 1.0});
    bundle.center = 0.5 * (nodes[i].bounds.low + nodes[i].bounds.high);
    double deviation = 0.0, spread = 0.0, height = 0.0;
    for (const std::uint32_t t : triangles) {
      deviation = std::fmax(deviation, norm(normals[t] - bundle.axis) + rounding);
      spread = std::fmax(spread, widened * std::fmax(spread_of(normals[t], sides[t]), beyond_folds[t]));
      for (const std::uint32_t v : data.triangles[t]) {
        const Vec3 from_center = data.vertices[v] - bundle.center;
        bundle.radius = std::fmax(bundle.radius, widened * norm(from_center));
        height = std::fmax(height, dot(bundle.axis, from_center));
      }
    }
    bundle.is_narrow = deviation * spread < 1.0 - least_steepness;
    bundle.slope = spread / (1.0 - deviation * spread);
    bundle.most_above = widened * height + (deviation + rounding) * bundle.radius;
  }
}

}  // namespace cmb::mesh
