#include "mesh/wedges/triangle_wedge.hpp"

#include <algorithm>
#include <cmath>

namespace cmb::mesh {

void clip_polygon(std::vector<Vec3> &polygon, const Vec3 &normal, double offset, std::vector<Vec3> &room) {
  bool all_kept = true;
  for (const Vec3 &p : polygon) all_kept = all_kept && dot(normal, p) >= offset;
  if (all_kept) return;
  room.clear();
  double above_p = dot(normal, polygon[0]) - offset;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 &p = polygon[i], &q = polygon[i + 1 == polygon.size() ? 0 : i + 1];
    const double above_q = dot(normal, q) - offset;
    if (above_p >= 0.0) room.push_back(p);
    if ((above_p < 0.0) != (above_q < 0.0)) room.push_back(p + (above_p / (above_p - above_q)) * (q - p));
    above_p = above_q;
  }
  polygon.swap(room);
}

WedgeSide make_wedge_side(const TriangleMesh &mesh, std::uint32_t t, std::size_t k) {
  const Triangle &corners = mesh.triangles()[t];
  const bool turned = corners[(k + 1) % 3] < corners[k];  // both triangles reckon from the same corner
  const Vec3 &from = mesh.corner(t, turned ? k + 1 : k), &to = mesh.corner(t, turned ? k : k + 1);
  const std::int32_t other = mesh.neighbour(t, k);
  const Vec3 &normal = mesh.face_normal(t), along = to - from;
  Vec3 side = cross(other < 0 ? normal : normal + mesh.face_normal(static_cast<std::uint32_t>(other)), along);
  // Folded back onto itself: no plane halves the angle, the triangle's own border does as well.
  if (!(norm2(side) > 1e-24 * norm2(along))) side = cross(normal, along);
  const double scale = 1.0 / norm(side), offset = scale * dot(side, from);
  side = scale * side;
  return turned ? WedgeSide{-side, -offset} : WedgeSide{side, offset};
}

bool gives_side_away(const TriangleMesh &mesh, std::uint32_t t, std::size_t k) {
  const std::int32_t other = mesh.neighbour(t, k);
  if (other < 0) return true;
  const auto beyond = static_cast<std::uint32_t>(other);
  const std::uint32_t face = mesh.faces().face_of(t), face_beyond = mesh.faces().face_of(beyond);
  return face_beyond != face ? face_beyond < face : beyond < t;
}

void TriangleWedge::build_front(const TriangleMesh &mesh, std::uint32_t t, double deepest) {
  mesh_ = &mesh;
  triangle_ = t;
  normal_ = mesh.face_normal(t);
  offset_ = dot(normal_, mesh.corner(t, 0));
  limit_ = std::min(mesh.depth_limit(t), deepest);
}

void TriangleWedge::build_side(const TriangleMesh &mesh, std::size_t k) {
  const Vec3 along = mesh.corner(triangle_, k + 1) - mesh.corner(triangle_, k);
  const std::int32_t other = mesh.neighbour(triangle_, k);
  const Vec3 sum = other < 0 ? normal_ : normal_ + mesh.face_normal(static_cast<std::uint32_t>(other));
  side_[k] = cross(sum, along);
  // Folded back onto itself: no plane halves the angle, the triangle's own border does as well.
  if (!(norm2(side_[k]) > 1e-24 * norm2(along))) side_[k] = cross(normal_, along);
  side_offset_[k] = dot(side_[k], mesh.corner(triangle_, k));
}

TriangleWedge::TriangleWedge(const TriangleMesh &mesh, std::uint32_t t, double deepest) {
  build_front(mesh, t, deepest);
  for (std::size_t k = 0; k < 3; ++k) build_side(mesh, k);
}

bool TriangleWedge::hull(Vec3 (&corner)[6]) const {
  constexpr double least_slope = 1e-3;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec3 &at = mesh_->corner(triangle_, k);
    const Vec3 line = cross(side_[k], side_[(k + 2) % 3]);
    const double down = -dot(line, normal_);
    if (!(std::fabs(down) > least_slope * norm(line))) return false;
    corner[k] = at;
    corner[k + 3] = at + (limit_ / down) * line;
  }
  return true;
}

bool TriangleWedge::may_meet(const Vec3 (&corner)[3]) const {
  if (depth(corner[0]) <= 0.0 && depth(corner[1]) <= 0.0 && depth(corner[2]) <= 0.0) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const double offset = side_offset_[k];
    if (dot(side_[k], corner[0]) < offset && dot(side_[k], corner[1]) < offset && dot(side_[k], corner[2]) < offset) {
      return false;
    }
  }
  return true;
}

void TriangleWedge::clip(std::vector<Vec3> &polygon, std::vector<Vec3> &room) const {
  for (std::size_t k = 0; k < 3 && !polygon.empty(); ++k) clip_polygon(polygon, side_[k], side_offset_[k], room);
  if (!polygon.empty()) clip_polygon(polygon, -normal_, -offset_, room);
  if (!polygon.empty()) clip_polygon(polygon, normal_, offset_ - limit_, room);
}

void TriangleWedge::clip_roof(const PlanarFaces::Roof &roof, std::vector<Vec3> &polygon, std::vector<Vec3> &room) const {
  double deepest = 0.0;
  for (const Vec3 &p : polygon) deepest = std::max(deepest, depth(p));
  if (deepest <= roof.clear_depth) return;
  for (const std::uint32_t *k = roof.begin; k != roof.end && !polygon.empty(); ++k) {
    const RoofPlane &plane = mesh_->faces().plane(*k);
    clip_polygon(polygon, plane.normal, plane.offset, room);
  }
}

}  // namespace cmb::mesh
