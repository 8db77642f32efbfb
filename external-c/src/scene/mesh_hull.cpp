#include "scene/mesh_hull.hpp"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "shape/convex_hull.hpp"

namespace cmb {

namespace {

constexpr std::size_t most_points = 8192;

// The vertices that lie farthest along directions on a spiral of golden angles.
std::vector<Vec3> outermost(const std::vector<Vec3> &vertices) {
  constexpr double golden_angle = 2.39996322972865332;
  constexpr std::size_t directions = most_points;
  std::vector<std::size_t> chosen;
  for (std::size_t k = 0; k < directions; ++k) {
    const double z = 1.0 - (2.0 * static_cast<double>(k) + 1.0) / directions, angle = golden_angle * static_cast<double>(k);
    const double across = std::sqrt(1.0 - z * z);
    const Vec3 direction{across * std::cos(angle), across * std::sin(angle), z};
    std::size_t farthest = 0;
    double most = dot(direction, vertices[0]);
    for (std::size_t v = 1; v < vertices.size(); ++v) {
      const double along = dot(direction, vertices[v]);
      if (along > most) {
        most = along;
        farthest = v;
      }
    }
    chosen.push_back(farthest);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Vec3> points;
  for (const std::size_t v : chosen) points.push_back(vertices[v]);
  return points;
}

}  // namespace

std::shared_ptr<const ContactPolytope> make_mesh_hull(const mesh::TriangleMesh &mesh) {
  convex::Polytope geometry;
  const std::vector<Vec3> &vertices = mesh.vertices();
  const bool few = vertices.size() <= most_points;
  if (!convex::build_convex_hull(few ? vertices : outermost(vertices), geometry, nullptr, nullptr)) return nullptr;
  return std::make_shared<const ContactPolytope>(std::move(geometry));
}

}  // namespace cmb
