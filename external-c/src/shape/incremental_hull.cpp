#include "shape/incremental_hull.hpp"

#include <algorithm>

namespace cmb::convex {

IncrementalHull::IncrementalHull(std::size_t max_points, std::size_t max_faces)
    : max_points_(max_points), max_faces_(max_faces) {
  points_.reserve(max_points);
  faces_.reserve(max_faces);
  visible_.reserve(max_faces);
  horizon_.reserve(max_faces);
  vertex_mark_.assign(max_points, 0);
  edge_at_vertex_.assign(max_points, 0);
}

// Plane through the face's corners; false where the triangle is thinner than `thickness`.
bool IncrementalHull::set_plane(Face &face, double thickness) const {
  const Vec3 &a = point(face.vertex[0]), &b = point(face.vertex[1]), &c = point(face.vertex[2]);
  const Vec3 ab = b - a, bc = c - b, ca = a - c;
  const double ab2 = norm2(ab), bc2 = norm2(bc), ca2 = norm2(ca);
  // The two shorter edges give the product with the least rounding. Which they are is unpredictable: a table, no branch.
  const Vec3 *const edges[5] = {&bc, &ca, &ab, &bc, &ca};
  const int is_ab = (ab2 >= bc2) & (ab2 >= ca2), is_bc = bc2 >= ca2, longest = (1 - is_ab) * (2 - is_bc);
  const double squares[3] = {ab2, bc2, ca2}, longest2 = squares[longest];
  const Vec3 n = cross(*edges[longest], *edges[longest + 1]);
  const double area2 = norm2(n);
  if (!(area2 > thickness * thickness * longest2)) return false;
  face.normal = (1.0 / std::sqrt(area2)) * n;
  face.offset = (1.0 / 3.0) * dot(face.normal, a + b + c);
  return true;
}

double IncrementalHull::distance(const Face &face) const {
  const double offset = face.offset;
  if (!(offset > 0.0)) return offset;
  const Vec3 *const corner[3] = {&point(face.vertex[0]), &point(face.vertex[1]), &point(face.vertex[2])};
  double nearest2 = INFINITY;
  for (int k = 0; k < 3; ++k) {
    const Vec3 &p = *corner[k], &q = *corner[k == 2 ? 0 : k + 1];
    if (dot(face.normal, cross(p, q)) >= 0.0) continue;  // the origin's foot lies on the face's side of the edge
    const Vec3 edge = q - p;
    const double along = -dot(p, edge), length2 = norm2(edge);
    const double t = along <= 0.0 ? 0.0 : along >= length2 ? 1.0 : along / length2;
    nearest2 = std::min(nearest2, norm2(p + t * edge));
  }
  return nearest2 < INFINITY ? std::max(offset, std::sqrt(nearest2)) : offset;
}

bool IncrementalHull::start(const Vec3 &p0, const Vec3 &p1, const Vec3 &p2, const Vec3 &p3, double thickness) {
  points_.clear();
  faces_.clear();
  first_new_face_ = 0;
  if (pass_ > 0xfffffff0u - max_points_) {
    pass_ = 0;
    std::fill(vertex_mark_.begin(), vertex_mark_.end(), 0u);
  }
  const bool positive = dot(cross(p1 - p0, p2 - p0), p3 - p0) > 0.0;  // p3 above the triangle p0 p1 p2
  points_.push_back(p0);
  points_.push_back(positive ? p2 : p1);
  points_.push_back(positive ? p1 : p2);
  points_.push_back(p3);
  // p3 lies below face 0 (0, 1, 2); the others join its edges to p3.
  static constexpr std::int32_t corner[4][3] = {{0, 1, 2}, {1, 0, 3}, {2, 1, 3}, {0, 2, 3}};
  static constexpr std::int32_t across[4][3] = {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}};
  for (int f = 0; f < 4; ++f) {
    Face face{};
    std::copy_n(corner[f], 3, face.vertex);
    std::copy_n(across[f], 3, face.neighbour);
    face.alive = true;
    if (!set_plane(face, thickness)) return false;
    faces_.push_back(face);
  }
  for (int f = 0; f < 4; ++f) {
    const std::int32_t opposite = f == 0 ? 3 : f == 1 ? 2 : f == 2 ? 0 : 1;
    if (!(at(f).offset - dot(at(f).normal, point(opposite)) > thickness)) return false;
  }
  return true;
}

IncrementalHull::Outcome IncrementalHull::expand(std::int32_t seen, const Vec3 &p, double tolerance, double thickness) {
  if (points_.size() >= max_points_) return Outcome::full;
  const std::uint32_t pass = ++pass_;
  visible_.clear();
  horizon_.clear();
  visible_.push_back(seen);
  at(seen).mark = pass;
  for (std::size_t k = 0; k < visible_.size(); ++k) {
    const Face &face = at(visible_[k]);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t g = face.neighbour[i];
      Face &other = at(g);
      if (other.mark == pass) continue;
      if (dot(other.normal, p) - other.offset > tolerance) {
        other.mark = pass;
        visible_.push_back(g);
      } else {
        horizon_.push_back({face.vertex[i], face.vertex[i == 2 ? 0 : i + 1], g});
      }
    }
  }
  if (horizon_.size() < 3) return Outcome::broken;
  if (faces_.size() + horizon_.size() > max_faces_) return Outcome::full;
  // The horizon must be one closed loop without a vertex twice.
  for (std::size_t k = 0; k < horizon_.size(); ++k) {
    const std::size_t from = static_cast<std::size_t>(horizon_[k].from);
    if (vertex_mark_[from] == pass) return Outcome::broken;
    vertex_mark_[from] = pass;
    edge_at_vertex_[from] = static_cast<std::int32_t>(k);
  }
  std::size_t loop = 0, edge = 0;
  do {
    const std::size_t to = static_cast<std::size_t>(horizon_[edge].to);
    if (vertex_mark_[to] != pass) return Outcome::broken;
    edge = static_cast<std::size_t>(edge_at_vertex_[to]);
    ++loop;
  } while (edge != 0 && loop <= horizon_.size());
  if (loop != horizon_.size()) return Outcome::broken;

  const std::int32_t apex = point_count();
  points_.push_back(p);
  first_new_face_ = face_count();
  for (std::size_t k = 0; k < horizon_.size(); ++k) {
    const HorizonEdge &h = horizon_[k];
    const std::int32_t self = first_new_face_ + static_cast<std::int32_t>(k);
    Face face{};
    face.vertex[0] = h.from;
    face.vertex[1] = h.to;
    face.vertex[2] = apex;
    face.neighbour[0] = h.outer_face;
    face.neighbour[1] = first_new_face_ + edge_at_vertex_[static_cast<std::size_t>(h.to)];
    face.alive = true;
    if (!set_plane(face, thickness)) {
      const Face &outer = at(h.outer_face);
      face.normal = outer.normal;
      face.offset = outer.offset;
      face.sliver = true;
    }
    faces_.push_back(face);
    Face &outer = at(h.outer_face);
    for (int i = 0; i < 3; ++i) {
      const std::int32_t shared = (outer.vertex[i] == h.to) & (outer.vertex[i == 2 ? 0 : i + 1] == h.from);
      outer.neighbour[i] += shared * (self - outer.neighbour[i]);  // without a branch, as above
    }
  }
  for (std::int32_t self = first_new_face_; self < face_count(); ++self) at(at(self).neighbour[1]).neighbour[2] = self;
  for (std::int32_t f : visible_) at(f).alive = false;
  return Outcome::expanded;
}

}  // namespace cmb::convex
