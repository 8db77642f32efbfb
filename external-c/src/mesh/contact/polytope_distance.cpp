#include "mesh/contact/polytope_distance.hpp"

#include <cmath>
#include <limits>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/wedges/triangle_wedge.hpp"
#include "mesh/distance/segment_distance.hpp"

namespace cmb::mesh {

TriangleGap triangle_polytope_distance(const Vec3 &a, const Vec3 &b, const Vec3 &c, const convex::Polytope &body,
                                       const std::vector<Vec3> &vertices, const std::vector<Vec3> &normals,
                                       std::vector<Vec3> &polygon, std::vector<Vec3> &clipped) {
  // The triangle meets the body where something of it lies behind all faces.
  polygon.assign({a, b, c});
  for (std::size_t f = 0; f < normals.size() && !polygon.empty(); ++f) {
    const Vec3 &on_face = vertices[static_cast<std::size_t>(
        body.face_vertices()[static_cast<std::size_t>(body.faces()[f].first)])];
    clip_polygon(polygon, -normals[f], -dot(normals[f], on_face), clipped);
  }
  if (!polygon.empty()) return {0.0, polygon[0], polygon[0]};

  TriangleGap best;
  best.distance = std::numeric_limits<double>::infinity();
  const auto offer = [&](const Vec3 &on_triangle, const Vec3 &on_body) {
    const double distance = norm(on_triangle - on_body);
    if (distance < best.distance) best = {distance, on_triangle, on_body};
  };
  for (const Vec3 &p : vertices) offer(nearest_on_triangle(p, a, b, c).point, p);
  const Vec3 corners[3] = {a, b, c};
  for (const convex::Polytope::Edge &edge : body.edges()) {
    const Vec3 &from = vertices[static_cast<std::size_t>(edge.vertex[0])];
    const Vec3 along = vertices[static_cast<std::size_t>(edge.vertex[1])] - from;
    for (int k = 0; k < 3; ++k) {
      const SegmentPoints points = nearest_of_segments(corners[k], corners[(k + 1) % 3] - corners[k], from, along);
      offer(points.first, points.second);
    }
  }
  // Corners over a face: the foot on the face's plane lies within the face.
  for (std::size_t f = 0; f < normals.size(); ++f) {
    const convex::Polytope::Face &face = body.faces()[f];
    const auto vertex = [&](std::int32_t i) -> const Vec3 & {
      return vertices[static_cast<std::size_t>(
          body.face_vertices()[static_cast<std::size_t>(face.first + i % face.count)])];
    };
    for (const Vec3 &p : corners) {
      const double height = dot(normals[f], p - vertex(0));
      if (!(height > 0.0) || height >= best.distance) continue;
      bool within = true;
      for (std::int32_t i = 0; i < face.count && within; ++i) {
        within = dot(cross(normals[f], vertex(i + 1) - vertex(i)), p - vertex(i)) >= 0.0;
      }
      if (within) offer(p, p - height * normals[f]);
    }
  }
  return best;
}

}  // namespace cmb::mesh
