#include "mesh/intersection/sheet_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "mesh/intersection/triangle_crossing.hpp"

namespace cmb::mesh {

namespace {

// How far the triangles at the corners of triangle t reach beyond the plane through `origin`, to the side to which they reach
// less; each corner counts as much as `p`, of the triangle, is near it. All in the mesh's frame.
double reach_through(const TriangleMesh &mesh, std::uint32_t t, const Vec3 &p, const Vec3 &normal, const Vec3 &origin) {
  const Vec3 corner[3] = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  double front = 0.0, behind = 0.0, parts = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &q = corner[(k + 1) % 3], &r = corner[(k + 2) % 3];
    const double part = std::fmax(0.0, dot(mesh.face_normal(t), cross(q - p, r - p)));
    const std::uint32_t v = mesh.triangles()[t][k];
    double highest = 0.0, lowest = 0.0;
    for (std::uint32_t at = mesh.vertex_begin(v); at < mesh.vertex_begin(v + 1); ++at) {
      for (std::size_t i = 0; i < 3; ++i) {
        const double height = dot(normal, mesh.corner(mesh.vertex_triangles()[at], i) - origin);
        highest = std::fmax(highest, height);
        lowest = std::fmin(lowest, height);
      }
    }
    parts += part;
    front += part * highest;
    behind -= part * lowest;
  }
  return parts > 0.0 ? std::fmin(front, behind) / parts : 0.0;
}

}  // namespace

TriangleSection sheet_crossing(const TriangleMesh &mesh, std::uint32_t t, const TriangleMesh &body, std::uint32_t facet,
                               const Pose &place, double enough) {
  const Vec3 a[3] = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
  const Vec3 b[3] = {place(body.corner(facet, 0)), place(body.corner(facet, 1)), place(body.corner(facet, 2))};
  const Vec3 &normal_a = mesh.face_normal(t), normal_b = place.rotation * body.face_normal(facet);
  TriangleSection crossing = common_segment(a, normal_a, b, normal_b, enough);
  const auto at_most = [&](double depth) {
    crossing.depth = std::fmin(crossing.depth, depth);
    return crossing.depth > enough;
  };
  const Pose back = place.inverse();
  if (at_most(crossing.depth) && at_most(reach_through(mesh, t, crossing.place, normal_b, b[0])) &&
      at_most(reach_through(body, facet, back(crossing.place), back.rotation * normal_a, back(a[0])))) {
    return crossing;
  }
  return {};
}

}  // namespace cmb::mesh
