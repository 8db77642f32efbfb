#include "shape/contact_polytope.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "math/branchless.hpp"
#include "math/index.hpp"
#include "math/pi.hpp"
#include "shape/convex_hull.hpp"

namespace cmb {

namespace {

// Keeps the blend finite where the load comes exactly along a face's normal.
constexpr double smallest_angle_term = 1e-14;

struct Neighbourhood {
  std::int32_t face;
  std::int32_t next;  // vertex after this one in the face
  std::int32_t previous;
  double share;
};

}  // namespace

ContactPolytope::ContactPolytope(convex::Polytope geometry) : geometry_(std::move(geometry)) {
  const std::size_t vertex_count = geometry_.vertices().size();
  std::vector<std::vector<Neighbourhood>> around(vertex_count);
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
    std::vector<Neighbourhood> &corners = around[v];
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
    faces_begin_.push_back(static_cast<std::int32_t>(vertex_faces_.size()));
    double low = 1.0, high = 0.0;
    for (const Neighbourhood &corner : corners) {
      vertex_faces_.push_back(corner.face);
      face_shares_.push_back({geometry_.faces()[index(corner.face)].normal, corner.share});
      low = std::min(low, corner.share);
      high = std::max(high, corner.share);
    }
    constant_.push_back(high - low <= 1e-12 ? 0.5 * (high + low) : -1.0);
    all_constant_ = all_constant_ && constant_.back() >= 0.0;
  }
  faces_begin_.push_back(static_cast<std::int32_t>(vertex_faces_.size()));
  build_polar();
  if (geometry_.edges().size() <= most_in_set) {
    build_sets();
  } else {
    std::vector<Vec3> normals;
    for (const convex::Polytope::Face &face : geometry_.faces()) normals.push_back(face.normal);
    convex::build_convex_hull(normals, normals_, nullptr, nullptr);
  }
  double radius = 0.0;
  for (const Vec3 &v : geometry_.vertices()) radius = std::max(radius, norm(v - geometry_.center()));
  fineness_ = static_cast<double>(vertex_count) / (2.0 * radius);
}

void ContactPolytope::build_sets() {
  incidence_.resize(geometry_.vertices().size());
  for (std::size_t e = 0; e < geometry_.edges().size(); ++e) {
    const convex::Polytope::Edge &edge = geometry_.edges()[e];
    for (const std::int32_t end : edge.vertex) {
      Incidence &at_end = incidence_[index(end)];
      at_end.edges |= std::uint64_t{1} << e;
      at_end.faces |= std::uint64_t{1} << edge.face[0] | std::uint64_t{1} << edge.face[1];
    }
  }
  for (int axis = 0; axis < 3; ++axis) {
    for (const Vec3 &vertex : geometry_.vertices()) coordinates_.push_back(vertex[axis]);
    for (const convex::Polytope::Face &face : geometry_.faces()) normal_coordinates_.push_back(face.normal[axis]);
  }
}

void ContactPolytope::build_polar() {
  const std::vector<convex::Polytope::Face> &faces = geometry_.faces();
  polar_corners_.reserve(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    const double from_center = faces[f].offset - dot(faces[f].normal, geometry_.center());
    inner_radius_ = f == 0 ? from_center : std::min(inner_radius_, from_center);
    polar_corners_.push_back((1.0 / from_center) * faces[f].normal);
  }
  faces_across_.resize(geometry_.face_edges().size());
  for (std::size_t f = 0; f < faces.size(); ++f) {
    for (std::int32_t k = faces[f].first; k < faces[f].first + faces[f].count; ++k) {
      const convex::Polytope::Edge &edge = geometry_.edges()[index(geometry_.face_edges()[index(k)])];
      const std::int32_t across = edge.face[edge.face[0] == static_cast<std::int32_t>(f) ? 1 : 0];
      faces_across_[index(k)] = {polar_corners_[index(across)], across, faces[index(across)].first, faces[index(across)].count};
    }
  }
}

double ContactPolytope::greatest_face_cosine(const Vec3 &direction) const {
  if (has_sets()) {
    const std::size_t count = geometry_.faces().size();
    const double *const x = normal_coordinates_.data(), *const y = x + count, *const z = y + count;
    double cosine[most_in_set];
    for (std::size_t k = 0; k < count; ++k) cosine[k] = direction.x * x[k] + direction.y * y[k] + direction.z * z[k];
    return convex::greatest_of(cosine, count);
  }
  if (!normals_.vertices().empty()) return dot(direction, normals_.vertices()[index(normals_.support_vertex(direction))]);
  double greatest = -1.0;
  for (const convex::Polytope::Face &face : geometry_.faces()) {
    const double cosine = dot(face.normal, direction);
    greatest = cosine > greatest ? cosine : greatest;
  }
  return greatest;
}

ContactPolytope::Share ContactPolytope::share(std::int32_t v, const Vec3 &down) const {
  Share result{constant_[index(v)], {}};
  if (result.value >= 0.0) return result;
  const FaceShare *const first = face_shares_.data() + faces_begin_[index(v)];
  const FaceShare *const last = face_shares_.data() + faces_begin_[index(v) + 1];
  // Shepard's interpolation over the faces at v in the angle between face normal and load.
  constexpr std::size_t most_kept = 32;
  std::array<double, most_kept> kept;  // only the first ones are used
  const auto inverse_term = [&](double cosine) { return 1.0 / std::max(1.0 - cosine, smallest_angle_term); };
  double sum = 0.0, weighted = 0.0;
  std::size_t i = 0;
  for (const FaceShare *face = first; face != last; ++face, ++i) {
    const double inverse = inverse_term(dot(face->normal, down)), influence = inverse * inverse;
    if (i < most_kept) kept[i] = inverse;
    sum += influence;
    weighted += influence * face->share;
  }
  const double part = 1.0 / sum, share = weighted * part, factor = 2.0 * part;
  i = 0;
  double x = 0.0, y = 0.0, z = 0.0;
  for (const FaceShare *face = first; face != last; ++face, ++i) {
    const Vec3 &normal = face->normal;
    const double inverse = i < most_kept ? kept[i] : inverse_term(dot(normal, down));
    const double scale = factor * inverse * inverse * inverse * (face->share - share);
    x += scale * normal.x, y += scale * normal.y, z += scale * normal.z;
  }
  result.value = share;
  result.gradient.x = x, result.gradient.y = y, result.gradient.z = z;
  return result;
}

}  // namespace cmb
