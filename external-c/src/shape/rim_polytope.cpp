#include "shape/rim_polytope.hpp"

#include <cmath>
#include <vector>

namespace cmb {

namespace {

constexpr double sector = 2.0 * 3.14159265358979323846 / rim_corners;

}  // namespace

std::shared_ptr<const ContactPolytope> make_rim_polytope(const convex::ConvexBody &body) {
  constexpr int n = rim_corners;
  const bool cone = body.core == convex::CoreShape::cone;
  const double r = body.half.x, h = body.half.z;
  std::vector<Vec3> vertices;
  for (int k = 0; k < n; ++k) {
    const double angle = sector * k;
    vertices.push_back({r * std::cos(angle), r * std::sin(angle), -h});
  }
  if (cone) {
    vertices.push_back({0, 0, h});
  } else {
    for (int k = 0; k < n; ++k) vertices.push_back({vertices[static_cast<std::size_t>(k)].x, vertices[static_cast<std::size_t>(k)].y, h});
  }
  std::vector<std::vector<std::int32_t>> faces(cone ? 1 : 2);
  for (int k = 0; k < n; ++k) {
    const int next = (k + 1) % n;
    faces[0].push_back(n - 1 - k);
    if (cone) {
      faces.push_back({k, next, n});
    } else {
      faces[1].push_back(n + k);
      faces.push_back({k, next, n + next, n + k});
    }
  }
  convex::Polytope geometry;
  convex::Polytope::build(vertices, faces, geometry, nullptr);
  return std::make_shared<const ContactPolytope>(std::move(geometry), ContactPolytope::Corners::curve);
}

double inside_rim_polygon(double radius, double x, double y) {
  const double angle = std::atan2(y, x), aside = angle - sector * (std::floor(angle / sector) + 0.5);
  return radius * std::cos(0.5 * sector) - std::sqrt(x * x + y * y) * std::cos(aside);
}

}  // namespace cmb
