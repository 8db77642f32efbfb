#include "mesh/triangle_wedge.hpp"

#include <cmath>

namespace cmb::mesh {

void clip_polygon(std::vector<Vec3> &polygon, const Vec3 &normal, double offset, std::vector<Vec3> &room) {
  bool all_kept = true;
  for (const Vec3 &p : polygon) all_kept = all_kept && dot(normal, p) >= offset;
  if (all_kept) return;
  room.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double above_p = dot(normal, p) - offset, above_q = dot(normal, q) - offset;
    if (above_p >= 0.0) room.push_back(p);
    if ((above_p < 0.0) != (above_q < 0.0)) room.push_back(p + (above_p / (above_p - above_q)) * (q - p));
  }
  polygon.swap(room);
}

TriangleWedge::TriangleWedge(const TriangleMesh &mesh, std::uint32_t t, double deepest)
    : triangle_(t),
      normal_(mesh.face_normal(t)),
      offset_(dot(normal_, mesh.corner(t, 0))),
      limit_(std::fmin(mesh.depth_limit(t), deepest)) {
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 along = mesh.corner(t, k + 1) - mesh.corner(t, k);
    const std::int32_t other = mesh.neighbour(t, k);
    const Vec3 sum = other < 0 ? normal_ : normal_ + mesh.face_normal(static_cast<std::uint32_t>(other));
    side_[k] = cross(sum, along);
    // Folded back onto itself: no plane halves the angle, the triangle's own border does as well.
    if (!(norm2(side_[k]) > 1e-24 * norm2(along))) side_[k] = cross(normal_, along);
    side_offset_[k] = dot(side_[k], mesh.corner(t, k));
  }
}

bool TriangleWedge::may_meet(const Vec3 &center, double radius) const {
  const double middle = depth(center);
  if (middle <= -radius || middle - radius >= limit_) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const double inside = dot(side_[k], center) - side_offset_[k];
    if (inside < 0.0 && inside * inside > radius * radius * norm2(side_[k])) return false;
  }
  return true;
}

void TriangleWedge::clip(std::vector<Vec3> &polygon, std::vector<Vec3> &room) const {
  clip_polygon(polygon, -normal_, -offset_, room);
  if (!polygon.empty()) clip_polygon(polygon, normal_, offset_ - limit_, room);
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) clip_polygon(polygon, side_[k], side_offset_[k], room);
}

}  // namespace cmb::mesh
