#include "mesh/core/triangle_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/core/mesh_topology.hpp"
#include "mesh/core/ray_hit.hpp"
#include "mesh/wedges/triangle_wedge.hpp"

namespace cmb::mesh {

namespace {

// Part of the mesh's size that the vertices of a flat face may be off its plane.
constexpr double flat_tolerance = 1e-9;

// Hands the data on once it has passed.
MeshData checked(MeshData data, MeshUse use, const std::string &source) {
  check_mesh(data, use, source);
  return data;
}

}  // namespace

TrianglePoint nearest_on_triangle(const Vec3 &p, const Vec3 &a, const Vec3 &b, const Vec3 &c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {a, TriangleFeature::vertex, 0};
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0.0 && d4 <= d3) return {b, TriangleFeature::vertex, 1};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) return {a + (d1 / (d1 - d3)) * ab, TriangleFeature::edge, 0};
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0.0 && d5 <= d6) return {c, TriangleFeature::vertex, 2};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) return {a + (d2 / (d2 - d6)) * ac, TriangleFeature::edge, 2};
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    return {b + ((d4 - d3) / ((d4 - d3) + (d5 - d6))) * (c - b), TriangleFeature::edge, 1};
  }
  const double scale = 1.0 / (va + vb + vc);
  return {a + (vb * scale) * ab + (vc * scale) * ac, TriangleFeature::face, 0};
}

TriangleMesh::TriangleMesh(MeshData data, MeshUse use, const std::string &source)
    : data_(checked(std::move(data), use, source)),
      neighbours_(triangle_neighbours(data_.triangles)),
      components_(connected_components(neighbours_)),
      component_count_(1 + *std::max_element(components_.begin(), components_.end())),
      component_triangles_(component_count_),
      hierarchy_(data_.vertices, data_.triangles) {
  for (std::uint32_t t = 0; t < components_.size(); ++t) component_triangles_[components_[t]] = t;
  for (const auto &row : neighbours_) {
    for (const std::int32_t t : row) closed_ = closed_ && t >= 0;
  }
  build_vertex_triangles();
  build_normals();
  measure();
  build_depth_limits();
  faces_ = PlanarFaces(data_, neighbours_, face_normals_, depth_limits_, flat_tolerance * bound_radius_);
  face_relations_ = FaceRelations(data_, neighbours_, face_normals_, faces_.face_of());
  build_clear_depths();
  build_wedge_sides();
  build_interior_points();
}

double TriangleMesh::triangle_size() const {
  return std::sqrt(2.0 * area_ / static_cast<double>(triangles().size()));
}

void TriangleMesh::build_wedge_sides() {
  wedge_sides_.resize(triangles().size());
  for (std::uint32_t t = 0; t < triangles().size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) wedge_sides_[t][k] = make_wedge_side(*this, t, k);
  }
  wedge_cuts_ = WedgeCuts(data_, neighbours_, face_normals_, wedge_sides_, faces_, hierarchy_, bound_radius_, depth_limits_);
  fold_regions_ = FoldRegions(*this);
  wedge_reach_ = WedgeReach(data_, face_normals_, wedge_sides_, fold_regions_.spreads(), hierarchy_);
}

void TriangleMesh::build_vertex_triangles() {
  vertex_begin_.assign(vertices().size() + 1, 0);
  for (const Triangle &corners : triangles()) {
    for (const std::uint32_t v : corners) ++vertex_begin_[v + 1];
  }
  for (std::size_t v = 0; v < vertices().size(); ++v) vertex_begin_[v + 1] += vertex_begin_[v];
  std::vector<std::uint32_t> next(vertex_begin_.begin(), vertex_begin_.end() - 1);
  vertex_triangles_.resize(3 * triangles().size());
  for (std::size_t t = 0; t < triangles().size(); ++t) {
    for (const std::uint32_t v : triangles()[t]) vertex_triangles_[next[v]++] = static_cast<std::uint32_t>(t);
  }
}

void TriangleMesh::build_normals() {
  const auto count = static_cast<std::uint32_t>(triangles().size());
  face_normals_.resize(count);
  vertex_normals_.assign(vertices().size(), Vec3{});
  for (std::uint32_t t = 0; t < count; ++t) {
    const Vec3 across = cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
    face_normals_[t] = normalized(across);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 to_next = corner(t, k + 1) - corner(t, k), to_last = corner(t, k + 2) - corner(t, k);
      const double angle = std::atan2(norm(cross(to_next, to_last)), dot(to_next, to_last));
      Vec3 &sum = vertex_normals_[triangles()[t][k]];
      sum = sum + angle * face_normals_[t];
    }
  }
  for (std::uint32_t v = 0; v < vertices().size(); ++v) {
    const bool used = vertex_begin_[v] < vertex_begin_[v + 1];
    vertex_normals_[v] = normalized(vertex_normals_[v], used ? face_normals_[vertex_triangles_[vertex_begin_[v]]] : Vec3{0, 0, 1});
  }
}

Vec3 TriangleMesh::edge_normal(std::uint32_t t, std::size_t k) const {
  const std::int32_t other = neighbour(t, k);
  if (other < 0) return face_normal(t);
  return normalized(face_normal(t) + face_normal(static_cast<std::uint32_t>(other)), face_normal(t));
}

void TriangleMesh::measure() {
  const Bounds &box = hierarchy_.bounds();
  bound_center_ = 0.5 * (box.low + box.high);
  for (const Vec3 &p : vertices()) bound_radius_ = std::fmax(bound_radius_, norm(p - bound_center_));
  // Tetrahedra from the box' centre to the triangles; second moments as in Mirtich 1996, in vector form.
  double six_volumes = 0.0;
  Vec3 first;
  double second[3][3] = {};
  for (std::uint32_t t = 0; t < triangles().size(); ++t) {
    const Vec3 a = corner(t, 0) - bound_center_, b = corner(t, 1) - bound_center_, c = corner(t, 2) - bound_center_;
    area_ += 0.5 * norm(cross(b - a, c - a));
    const double six = dot(a, cross(b, c));
    const Vec3 sum = a + b + c;
    six_volumes += six;
    first = first + six * sum;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        second[i][j] += six * (sum[i] * sum[j] + a[i] * a[j] + b[i] * b[j] + c[i] * c[j]);
      }
    }
  }
  if (!closed_) return;
  const double volume = six_volumes / 6.0;
  const Vec3 offset = (1.0 / (24.0 * volume)) * first;
  for (auto &row : second) {
    for (double &entry : row) entry /= 120.0;
  }
  double about[3][3];
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) about[i][j] = second[i][j] - volume * offset[i] * offset[j];
  }
  const double trace = about[0][0] + about[1][1] + about[2][2];
  mass_properties_.volume = volume;
  mass_properties_.centroid = bound_center_ + offset;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) mass_properties_.inertia.row[i].set(j, (i == j ? trace : 0.0) - about[i][j]);
  }
}

void TriangleMesh::build_depth_limits() {
  const auto count = static_cast<std::uint32_t>(triangles().size());
  depth_limits_.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const Vec3 middle = (1.0 / 3.0) * (corner(t, 0) + corner(t, 1) + corner(t, 2));
    const Vec3 inward = -face_normal(t);
    double hit = std::numeric_limits<double>::infinity();
    hierarchy_.visit_along(
        middle, inward, [&] { return hit; },
        [&](std::uint32_t other) {
          // Only a surface that is left from inside ends the body.
          if (other == t || !(dot(face_normal(other), inward) > 0.0)) return;
          hit = std::fmin(hit, ray_hit(middle, inward, corner(other, 0), corner(other, 1), corner(other, 2)));
        });
    depth_limits_[t] = 0.5 * hit;
  }
}

bool TriangleMesh::is_other_side(std::uint32_t t, std::uint32_t other) const {
  if (!(dot(face_normal(t), face_normal(other)) < 0.5)) return false;
  // What the roof of its face parts from the triangle is not behind it.
  const PlanarFaces::Roof roof = faces_.roof(t);
  for (const std::uint32_t *k = roof.begin; k != roof.end; ++k) {
    if (faces_.plane(*k).beyond == faces_.face_of(other)) return false;
  }
  for (const std::uint32_t v : triangles()[t]) {
    for (const std::uint32_t w : triangles()[other]) {
      if (v == w) return false;
    }
  }
  return true;
}

void TriangleMesh::build_clear_depths() {
  // A place in a triangle's wedge (TriangleWedge) lies within 1.5 depths of the triangle.
  constexpr double wedge_reach = 1.5;
  const double farthest = 3.0 * (1.0 + wedge_reach) * triangle_size();
  const auto count = static_cast<std::uint32_t>(triangles().size());
  clear_depths_.resize(count);
  for (std::uint32_t t = 0; t < count; ++t) {
    const Vec3 corners[3] = {corner(t, 0), corner(t, 1), corner(t, 2)};
    double nearest2 = farthest * farthest;
    hierarchy_.visit_near(bounds_of(corners), [&] { return nearest2; }, [&](std::uint32_t other) {
      if (!is_other_side(t, other)) return;
      // The distance of boxes is enough: a depth too small only costs time.
      const Vec3 others[3] = {corner(other, 0), corner(other, 1), corner(other, 2)};
      nearest2 = std::min(nearest2, distance2(bounds_of(corners), bounds_of(others)));
    });
    clear_depths_[t] = std::sqrt(nearest2) / (1.0 + wedge_reach);
  }
}

// Of the places half way through the mesh behind its triangles: that where it is thickest, then again and again the one farthest
// from those before.
void TriangleMesh::build_interior_points() {
  std::vector<Vec3> halfway;
  Vec3 next = vertices()[0];
  double thickest = 0.0;
  for (std::uint32_t t = 0; closed_ && t < triangles().size(); ++t) {
    if (!(depth_limits_[t] > 0.0) || std::isinf(depth_limits_[t])) continue;
    const Vec3 middle = (1.0 / 3.0) * (corner(t, 0) + corner(t, 1) + corner(t, 2));
    halfway.push_back(middle - depth_limits_[t] * face_normal(t));
    if (!(depth_limits_[t] > thickest)) continue;
    thickest = depth_limits_[t];
    next = halfway.back();
  }
  std::vector<double> apart(halfway.size(), std::numeric_limits<double>::infinity());
  for (double farthest = 1.0; farthest > 0.0 && interior_points_.size() < max_interior_points;) {
    interior_points_.push_back(next);
    farthest = 0.0;
    for (std::size_t k = 0; k < halfway.size(); ++k) {
      apart[k] = std::fmin(apart[k], norm2(halfway[k] - interior_points_.back()));
      if (!(apart[k] > farthest)) continue;
      farthest = apart[k];
      next = halfway[k];
    }
  }
}

NearestPoint TriangleMesh::nearest(const Vec3 &p, std::uint32_t first) const {
  double best = std::numeric_limits<double>::infinity();
  TrianglePoint at;
  std::uint32_t triangle = first;
  const auto offer = [&](std::uint32_t t) {
    const TrianglePoint candidate = nearest_on_triangle(p, corner(t, 0), corner(t, 1), corner(t, 2));
    const double d2 = norm2(p - candidate.point);
    // The smallest number wins a tie, so that the order of the walk does not matter.
    if (d2 < best || (d2 == best && t < triangle)) {
      best = d2;
      at = candidate;
      triangle = t;
    }
  };
  offer(first);
  hierarchy_.visit_near({p, p}, [&] { return best; }, offer);
  const Vec3 pseudo = at.feature == TriangleFeature::face   ? face_normal(triangle)
                      : at.feature == TriangleFeature::edge ? edge_normal(triangle, at.index)
                                                            : vertex_normal(triangles()[triangle][at.index]);
  const Vec3 off = p - at.point;
  const double length = norm(off);
  const double side = dot(off, pseudo) < 0.0 ? -1.0 : 1.0;
  NearestPoint result;
  result.distance = side * length;
  result.point = at.point;
  result.triangle = triangle;
  result.feature = at.feature;
  result.index = static_cast<std::uint8_t>(at.index);
  // Next to a face, and on an edge or corner, the difference of the points is but rounding.
  const bool on_surface = length <= 1e-13 * (bound_radius_ + norm(bound_center_));
  result.normal = at.feature == TriangleFeature::face || on_surface ? pseudo : normalized(side * off, pseudo);
  return result;
}

}  // namespace cmb::mesh
