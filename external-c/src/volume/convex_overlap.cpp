#include "volume/convex_overlap.hpp"

#include <algorithm>

#include "math/index.hpp"

namespace cmb::convex {

namespace {

void add_outer_product(Mat3 &m, double factor, const Vec3 &v) {
  m.row[0] = m.row[0] + (factor * v.x) * v;
  m.row[1] = m.row[1] + (factor * v.y) * v;
  m.row[2] = m.row[2] + (factor * v.z) * v;
}

}  // namespace

void OverlapScratch::clear() {
  vertices_.clear();
  faces_.clear();
  corners_.clear();
}

void OverlapScratch::load(const Polytope &body, const Pose &pose, bool is_b) {
  vertices_.clear();
  for (const Vec3 &p : body.vertices()) vertices_.push_back(is_b ? pose(p) : p);
  corners_.assign(body.face_vertices().begin(), body.face_vertices().end());
  faces_.clear();
  for (std::size_t f = 0; f < body.faces().size(); ++f) {
    const Polytope::Face &face = body.faces()[f];
    faces_.push_back({face.first, face.count, static_cast<std::int32_t>(f), is_b, face.normal, face.offset});
    if (!is_b) continue;
    faces_.back().normal = pose.rotation * face.normal;
    faces_.back().offset = face.offset + dot(faces_.back().normal, pose.translation);
  }
  bound();
}

void OverlapScratch::start_box(const Vec3 &low, const Vec3 &high) {
  // Corners by bits (x, y, z); faces -x, +x, -y, +y, -z, +z, counter-clockwise from outside.
  static constexpr std::int32_t corner[24] = {0, 4, 6, 2, 1, 3, 7, 5, 0, 1, 5, 4, 2, 6, 7, 3, 0, 2, 3, 1, 4, 5, 7, 6};
  clear();
  for (int v = 0; v < 8; ++v) {
    vertices_.push_back({v & 1 ? high.x : low.x, v & 2 ? high.y : low.y, v & 4 ? high.z : low.z});
  }
  corners_.assign(corner, corner + 24);
  for (std::int32_t f = 0; f < 6; ++f) {
    Face face{4 * f, 4, -1, false, {}, f % 2 == 0 ? -low[f / 2] : high[f / 2]};
    face.normal.set(f / 2, f % 2 == 0 ? -1.0 : 1.0);
    faces_.push_back(face);
  }
  bound();
}

void OverlapScratch::bound() {
  if (vertices_.empty()) return;
  Vec3 low = vertices_[0], high = vertices_[0];
  for (const Vec3 &p : vertices_) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  middle_ = 0.5 * (low + high);
  reach_ = 0.5 * (high - low);
}

// The vertex where the edge from a kept vertex to a dropped one meets the plane; one for both faces
// that share the edge.
std::int32_t OverlapScratch::crossing_vertex(std::int32_t inner, std::int32_t outer) {
  for (std::int32_t k = crossing_at_[index(inner)]; k >= 0; k = crossings_[index(k)].next) {
    if (crossings_[index(k)].outer_vertex == outer) return crossings_[index(k)].new_vertex;
  }
  const double below = height_[index(inner)], above = height_[index(outer)];
  const double t = below / (below - above);
  const Vec3 &p = vertices_[index(inner)], &q = vertices_[index(outer)];
  const std::int32_t created = static_cast<std::int32_t>(next_vertices_.size());
  next_vertices_.push_back(t < 0.5 ? p + t * (q - p) : q - (1.0 - t) * (q - p));
  cap_next_.resize(next_vertices_.size(), -1);
  crossings_.push_back({outer, created, crossing_at_[index(inner)]});
  crossing_at_[index(inner)] = static_cast<std::int32_t>(crossings_.size()) - 1;
  return created;
}

// Drops what lies above the plane. Whether a vertex is kept is decided once, for all its faces, so
// each cut edge is left by one face and entered by its neighbour: the new edges form closed cycles.
void OverlapScratch::cut(const Vec3 &normal, double offset, std::int32_t source_face, bool from_b) {
  const double highest = dot(normal, middle_) - offset + std::fabs(normal.x) * reach_.x +
                       std::fabs(normal.y) * reach_.y + std::fabs(normal.z) * reach_.z;
  if (highest <= 0.0) return;
  height_.resize(vertices_.size());
  bool any_above = false, any_below = false;
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    height_[v] = dot(normal, vertices_[v]) - offset;
    any_above = any_above || height_[v] > 0.0;
    any_below = any_below || height_[v] < 0.0;
  }
  if (!any_above) return;
  if (!any_below) return clear();
  next_vertices_.clear();
  next_faces_.clear();
  next_corners_.clear();
  crossings_.clear();
  renumbered_.assign(vertices_.size(), -1);
  crossing_at_.assign(vertices_.size(), -1);
  for (std::size_t v = 0; v < vertices_.size(); ++v) {
    if (height_[v] > 0.0) continue;
    renumbered_[v] = static_cast<std::int32_t>(next_vertices_.size());
    next_vertices_.push_back(vertices_[v]);
  }
  cap_next_.assign(next_vertices_.size(), -1);
  const std::size_t kept = next_vertices_.size();
  for (const Face &face : faces_) {
    Face part = face;
    part.first = static_cast<std::int32_t>(next_corners_.size());
    std::int32_t left_at = -1, first_entry = -1;
    std::int32_t from = corners_[index(face.first + face.count - 1)];
    bool from_above = height_[index(from)] > 0.0;
    for (std::int32_t k = 0; k < face.count; ++k) {
      const std::int32_t to = corners_[index(face.first + k)];
      const bool to_above = height_[index(to)] > 0.0;
      if (!from_above && to_above) {
        left_at = crossing_vertex(from, to);
        next_corners_.push_back(left_at);
      } else if (from_above && !to_above) {
        const std::int32_t entry = crossing_vertex(to, from);
        next_corners_.push_back(entry);
        if (left_at >= 0) {
          cap_next_[index(entry)] = left_at;
          left_at = -1;
        } else {
          first_entry = entry;  // its exit comes at the cycle's end
        }
      }
      if (!to_above) next_corners_.push_back(renumbered_[index(to)]);
      from = to;
      from_above = to_above;
    }
    if (first_entry >= 0) cap_next_[index(first_entry)] = left_at;
    part.count = static_cast<std::int32_t>(next_corners_.size()) - part.first;
    if (part.count > 0) next_faces_.push_back(part);
  }
  for (std::size_t begin = kept; begin < next_vertices_.size(); ++begin) {
    if (cap_next_[begin] < 0) continue;
    Face cap;
    cap.first = static_cast<std::int32_t>(next_corners_.size());
    cap.source_face = source_face;
    cap.from_b = from_b;
    cap.normal = normal;
    cap.offset = offset;
    for (std::int32_t v = static_cast<std::int32_t>(begin); cap_next_[index(v)] >= 0;) {
      next_corners_.push_back(v);
      const std::int32_t next = cap_next_[index(v)];
      cap_next_[index(v)] = -1;
      v = next;
    }
    cap.count = static_cast<std::int32_t>(next_corners_.size()) - cap.first;
    next_faces_.push_back(cap);
  }
  vertices_.swap(next_vertices_);
  faces_.swap(next_faces_);
  corners_.swap(next_corners_);
  bound();
}

Overlap OverlapScratch::measure(const Vec3 &n) const {
  Overlap result;
  if (faces_.empty()) return result;
  const Vec3 &origin = middle_;
  Vec3 volume_moment;                                // integral of r over the volume, times 24
  Vec3 patch_first;                                  // integral of r over the projection, twice (both sides)
  double volume6 = 0.0, patch2 = 0.0;                // six volumes, two patch areas
  double side_height[2] = {0, 0}, side_area[2] = {0, 0};
  Mat3 second = {{{0, 0, 0}, {0, 0, 0}, {0, 0, 0}}};  // integral of r r^T over the projection, twice
  for (const Face &face : faces_) {
    const Vec3 a = vertices_[index(corners_[index(face.first)])] - origin;
    for (std::int32_t k = 1; k + 1 < face.count; ++k) {
      const Vec3 b = vertices_[index(corners_[index(face.first + k)])] - origin;
      const Vec3 c = vertices_[index(corners_[index(face.first + k + 1)])] - origin;
      const Vec3 area2 = cross(b - a, c - a);
      const Vec3 sum = a + b + c;
      const double part = dot(area2, a);
      volume6 += part;
      volume_moment = volume_moment + part * sum;
      const double projected2 = dot(area2, n);
      // Triangles of one face may be turned over by rounding: the face's own normal says which side it is.
      const int side = dot(face.normal, n) < 0.0 ? 0 : 1;
      const double projected = 0.5 * (side == 0 ? -projected2 : projected2);
      const Vec3 u = a - dot(a, n) * n, v = b - dot(b, n) * n, w = c - dot(c, n) * n, uvw = u + v + w;
      patch2 += projected;
      patch_first = patch_first + (projected / 3.0) * uvw;
      side_area[side] += projected;
      side_height[side] += projected / 3.0 * dot(sum, n);
      add_outer_product(second, projected / 12.0, u);
      add_outer_product(second, projected / 12.0, v);
      add_outer_product(second, projected / 12.0, w);
      add_outer_product(second, projected / 12.0, uvw);
    }
  }
  if (!(volume6 > 0.0) || !(patch2 > 0.0)) return result;
  result.volume = volume6 / 6.0;
  result.centroid = origin + (0.25 / volume6) * volume_moment;
  result.patch_area = 0.5 * patch2;
  const Vec3 in_plane = (1.0 / patch2) * patch_first;
  double height = 0.0;
  for (int side = 0; side < 2; ++side) {
    if (side_area[side] > 0.0) height += 0.5 * side_height[side] / side_area[side];
  }
  result.patch_centroid = origin + in_plane + height * n;
  for (int i = 0; i < 3; ++i) result.patch_moment.row[i] = 0.5 * second.row[i];
  add_outer_product(result.patch_moment, -result.patch_area, in_plane);
  return result;
}

Overlap convex_overlap(const Polytope &a, const Polytope &b, const Pose &b_in_a, const Vec3 &normal,
                       OverlapScratch &scratch) {
  // The body of fewer faces is cut by the other, first by the plane most perpendicular to the
  // normal: what is left is then small, and most of the other planes clear it at a glance.
  const bool cut_b = b.faces().size() < a.faces().size();
  const Polytope &knife = cut_b ? a : b;
  scratch.load(cut_b ? b : a, b_in_a, cut_b);
  const auto cut = [&](std::size_t f) {
    const Polytope::Face &face = knife.faces()[f];
    Vec3 n = face.normal;
    double offset = face.offset;
    if (!cut_b) {
      n = b_in_a.rotation * n;
      offset += dot(n, b_in_a.translation);
    }
    scratch.cut(n, offset, static_cast<std::int32_t>(f), !cut_b);
  };
  const Vec3 m = cut_b ? normal : transposed_times(b_in_a.rotation, normal);
  std::size_t first[2] = {0, 0};  // most along the normal and most against it
  for (std::size_t f = 1; f < knife.faces().size(); ++f) {
    if (dot(knife.faces()[f].normal, m) > dot(knife.faces()[first[0]].normal, m)) first[0] = f;
    if (dot(knife.faces()[f].normal, m) < dot(knife.faces()[first[1]].normal, m)) first[1] = f;
  }
  for (std::size_t f : first) cut(f);
  for (std::size_t f = 0; f < knife.faces().size() && !scratch.faces_.empty(); ++f) {
    if (f != first[0] && f != first[1]) cut(f);
  }
  return scratch.measure(normal);
}

Overlap convex_overlap(const Polytope &a, const Vec3 &normal, double offset, OverlapScratch &scratch) {
  scratch.load(a, {}, false);
  scratch.cut(normal, offset, 0, true);
  return scratch.measure(normal);
}

}  // namespace cmb::convex
