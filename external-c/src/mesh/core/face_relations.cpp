#include "mesh/core/face_relations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/pi.hpp"
#include "math/smoothstep.hpp"

namespace cmb::mesh {

namespace {

double rising(double x) { return 1.0 - convex::falling_smoothstep(std::fmax(0.0, x)); }

// Of a face's corners those farthest out in directions all around, each once.
std::vector<Vec3> outermost(const std::vector<Vec3> &corners, const Vec3 &normal) {
  constexpr int directions = 32;
  if (corners.size() <= static_cast<std::size_t>(directions)) return corners;
  const Vec3 u = convex::any_perpendicular(normal), v = cross(normal, u);
  std::vector<const Vec3 *> found;
  for (int k = 0; k < directions; ++k) {
    const double angle = 2.0 * pi * k / directions;
    const Vec3 direction = std::cos(angle) * u + std::sin(angle) * v;
    const Vec3 *farthest = &corners[0];
    for (const Vec3 &p : corners) {
      if (dot(direction, p) > dot(direction, *farthest)) farthest = &p;
    }
    found.push_back(farthest);
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  std::vector<Vec3> result;
  for (const Vec3 *p : found) result.push_back(*p);
  return result;
}

// The sine of the angle by which the surface is bent at a side of triangle t; negative where it is folded inwards.
double bend(const MeshData &data, const std::vector<Vec3> &normals, std::uint32_t t, std::size_t side, std::uint32_t other) {
  const Vec3 along = data.vertices[data.triangles[t][(side + 1) % 3]] - data.vertices[data.triangles[t][side]];
  return dot(cross(normals[t], normals[other]), normalized(along));
}

}  // namespace

FaceRelations::FaceRelations(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours,
                             const std::vector<Vec3> &normals, const std::vector<std::uint32_t> &face_of) {
  const auto triangles = static_cast<std::uint32_t>(data.triangles.size());
  constexpr double least_fold = 1e-9;  // sine
  for (std::uint32_t t = 0; t < triangles && all_together_; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::int32_t other = neighbours[t][k];
      if (other < 0) continue;
      all_together_ = all_together_ && bend(data, normals, t, k, static_cast<std::uint32_t>(other)) > -least_fold;
    }
  }
  if (all_together_) return;  // nothing else is asked
  std::vector<std::vector<Vec3>> corners(1 + *std::max_element(face_of.begin(), face_of.end()));
  faces_.resize(corners.size());
  for (std::uint32_t t = 0; t < triangles; ++t) {
    Face &face = faces_[face_of[t]];
    if (corners[face_of[t]].empty()) face.normal = normals[t], face.offset = dot(normals[t], data.vertices[data.triangles[t][0]]);
    for (const std::uint32_t v : data.triangles[t]) corners[face_of[t]].push_back(data.vertices[v]);
  }
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    Face &face = faces_[f];
    face.first = static_cast<std::uint32_t>(corners_.size());
    for (const Vec3 &p : outermost(corners[f], face.normal)) corners_.push_back(p);
    face.count = static_cast<std::uint32_t>(corners_.size()) - face.first;
    for (std::uint32_t k = 0; k < face.count; ++k) face.size = std::fmax(face.size, norm(corners_[face.first + k] - corners_[face.first]));
  }
  find_beside(data, neighbours, normals, face_of);
}

void FaceRelations::find_beside(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours,
                                const std::vector<Vec3> &normals, const std::vector<std::uint32_t> &face_of) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t t = 0; t < face_of.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      if (neighbours[t][k] < 0) continue;
      const auto other = static_cast<std::uint32_t>(neighbours[t][k]);
      const std::uint32_t a = face_of[t], b = face_of[other];
      if (a != b && (bend(data, normals, t, k, other) >= 0.0 || together(a, b) >= 1.0)) pairs.insert(pairs.end(), {{a, b}, {b, a}});
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const auto &[a, b] : pairs) {
    if (faces_[a].count_beside++ == 0) faces_[a].first_beside = static_cast<std::uint32_t>(beside_.size());
    beside_.push_back(b);
  }
}

bool FaceRelations::go_over(std::uint32_t a, std::uint32_t b) const {
  const bool fewer = faces_[a].count_beside <= faces_[b].count_beside;
  const Face &face = faces_[fewer ? a : b];
  const auto begin = beside_.begin() + face.first_beside;
  return std::binary_search(begin, begin + face.count_beside, fewer ? b : a);
}

// How far the face reaches above the other one's plane, by its size.
double FaceRelations::height(const Face &face, const Face &above) const {
  double most = 0.0;
  for (std::uint32_t k = face.first; k < face.first + face.count; ++k) most = std::fmax(most, dot(above.normal, corners_[k]) - above.offset);
  return most / face.size;
}

double FaceRelations::together(std::uint32_t a, std::uint32_t b) const {
  const Face &one = faces_[a], &other = faces_[b];
  constexpr double alike = 0.70710678118654752;  // cosine of 45 degrees
  const double cosine = dot(one.normal, other.normal);
  if (cosine >= alike) return 1.0;
  const double unlike = convex::falling_smoothstep(std::fmax(0.0, cosine / alike));
  constexpr double before = 0.1;  // a face that reaches as far above the other's plane lies before it
  const double one_before = rising(height(one, other) / before);
  return one_before > 0.0 ? 1.0 - unlike * one_before * rising(height(other, one) / before) : 1.0;
}

}  // namespace cmb::mesh
