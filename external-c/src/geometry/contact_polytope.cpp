#include "geometry/contact_polytope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "geometry/solid_angle.hpp"

namespace cmb {

namespace {

constexpr double pi = 3.14159265358979323846;
// Keeps the blend finite where the load comes exactly along a face's normal.
constexpr double smallest_angle_term = 1e-14;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

struct FaceCorner {
  std::int32_t face;
  std::int32_t next;  // vertex after this one in the face
  std::int32_t previous;
  double share;
};

}  // namespace

ContactPolytope::ContactPolytope(convex::Polytope geometry) : geometry_(std::move(geometry)) {
  const std::size_t vertex_count = geometry_.vertices().size();
  std::vector<std::vector<FaceCorner>> around(vertex_count);
  for (std::size_t f = 0; f < geometry_.faces().size(); ++f) {
    const convex::Polytope::Face &face = geometry_.faces()[f];
    double sum = 0.0;
    std::vector<double> exterior(index(face.count));
    const auto vertex = [&](std::int32_t k) {
      return geometry_.face_vertices()[index(face.first + (k + face.count) % face.count)];
    };
    for (std::int32_t k = 0; k < face.count; ++k) {
      const Vec3 &here = geometry_.vertices()[index(vertex(k))];
      const Vec3 in = here - geometry_.vertices()[index(vertex(k - 1))];
      const Vec3 out = geometry_.vertices()[index(vertex(k + 1))] - here;
      exterior[index(k)] = std::atan2(norm(cross(in, out)), dot(in, out));
      sum += exterior[index(k)];
    }
    for (std::int32_t k = 0; k < face.count; ++k) {
      around[index(vertex(k))].push_back(
          {static_cast<std::int32_t>(f), vertex(k + 1), vertex(k - 1), exterior[index(k)] / sum});
    }
  }
  for (std::size_t v = 0; v < vertex_count; ++v) {
    std::vector<FaceCorner> &corners = around[v];
    // In turn: each face's previous vertex is the next vertex of the face that follows counter-clockwise.
    for (std::size_t i = 0; i + 1 < corners.size(); ++i) {
      const std::int32_t shared = corners[i].previous;
      for (std::size_t j = i + 1; j < corners.size(); ++j) {
        if (corners[j].next == shared) {
          std::swap(corners[i + 1], corners[j]);
          break;
        }
      }
    }
    corner_begin_.push_back(static_cast<std::int32_t>(corners_.size()));
    double low = 1.0, high = 0.0;
    double normal_cone = 0.0;
    for (const FaceCorner &corner : corners) {
      const Vec3 &normal = geometry_.faces()[index(corner.face)].normal;
      corners_.push_back({normal, corner.share, corner.face});
      low = std::min(low, corner.share);
      high = std::max(high, corner.share);
    }
    constant_.push_back(high - low <= 1e-12 ? 0.5 * (high + low) : -1.0);
    all_constant_ = all_constant_ && constant_.back() >= 0.0;
    for (std::size_t i = corners_.size() - corners.size(); i + 2 < corners_.size(); ++i) {
      normal_cone += triangle_solid_angle(corners_[corners_.size() - corners.size()].normal, corners_[i + 1].normal,
                                          corners_[i + 2].normal);
    }
    normal_cone_.push_back(std::fabs(normal_cone));
  }
  corner_begin_.push_back(static_cast<std::int32_t>(corners_.size()));
  double radius = 0.0;
  for (const Vec3 &v : geometry_.vertices()) radius = std::max(radius, norm(v - geometry_.center()));
  fineness_ = static_cast<double>(vertex_count) / (2.0 * radius);
}

double ContactPolytope::greatest_face_cosine(const Vec3 &direction, std::int32_t start) const {
  double greatest = -1.0;
  std::int32_t best = -1;
  const auto look_round = [&](std::int32_t v) {
    for (auto i = index(corner_begin_[index(v)]); i < index(corner_begin_[index(v) + 1]); ++i) {
      const double cosine = dot(corners_[i].normal, direction);
      if (cosine > greatest) greatest = cosine, best = corners_[i].face;
    }
  };
  look_round(start);
  for (std::int32_t looked_at = -1; best != looked_at;) {  // cosines rise strictly, so this ends
    looked_at = best;
    const convex::Polytope::Face &face = geometry_.faces()[index(looked_at)];
    for (std::int32_t k = face.first; k < face.first + face.count; ++k) {
      const std::int32_t v = geometry_.face_vertices()[index(k)];
      if (v != start) look_round(v);
    }
  }
  return greatest;
}

double ContactPolytope::share(std::int32_t v, const Vec3 &down, Vec3 *gradient) const {
  if (gradient != nullptr) *gradient = {};
  if (constant_[index(v)] >= 0.0) return constant_[index(v)];
  // Shepard's interpolation over the faces at v in the angle between face normal and load.
  const Corner *const corner = corners_.data() + corner_begin_[index(v)];
  const std::size_t count = faces_at(v);
  constexpr std::size_t most_kept = 32;
  std::array<double, most_kept> kept;  // only the first ones are used
  const auto inverse_term = [&](std::size_t i) {
    const double term = 1.0 - dot(corner[i].normal, down);
    return 1.0 / (term > smallest_angle_term ? term : smallest_angle_term);
  };
  double sum = 0.0, weighted = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double inverse = inverse_term(i), influence = inverse * inverse;
    if (i < most_kept) kept[i] = inverse;
    sum += influence;
    weighted += influence * corner[i].share;
  }
  const double share = weighted / sum;
  if (gradient != nullptr) {
    const double factor = 2.0 / sum;
    for (std::size_t i = 0; i < count; ++i) {
      const double inverse = i < most_kept ? kept[i] : inverse_term(i);
      *gradient = *gradient + (factor * inverse * inverse * inverse * (corner[i].share - share)) * corner[i].normal;
    }
  }
  return share;
}

}  // namespace cmb
