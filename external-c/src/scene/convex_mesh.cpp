#include "scene/convex_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "math/symmetric_matrix.hpp"
#include "shape/convex_hull.hpp"

namespace cmb {

namespace {

using mesh::TriangleMesh;

constexpr std::size_t most_vertices = 8192;  // a hull's time grows with their square

// Whether an edge is concave by more than vertices that are `rounding` off can make it: quick, and rules most meshes out.
bool has_concave_edge(const TriangleMesh &mesh, double rounding) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
  for (std::uint32_t t = 0; t < count; ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto other = static_cast<std::uint32_t>(mesh.neighbour(t, k));
      const Vec3 &start = mesh.corner(t, k), along = normalized(mesh.corner(t, k + 1) - start);
      // How far the triangle reaches from the edge: its plane turns about the edge by rounding / reach.
      const double reach = norm(cross(along, mesh.corner(t, k + 2) - start));
      for (std::size_t corner = 0; corner < 3; ++corner) {
        const Vec3 to = mesh.corner(other, corner) - start;
        const double allowed = 4.0 * rounding * (1.0 + norm(cross(along, to)) / reach);
        if (dot(mesh.face_normal(t), to) > allowed) return true;
      }
    }
  }
  return false;
}

// Whether every triangle lies in the plane of a face, to rounding.
bool lies_on_faces(const TriangleMesh &mesh, const convex::Polytope &hull, double rounding) {
  const auto &faces = hull.faces();
  const auto is_near = [&](const convex::Polytope::Face &face, const Vec3 &p) {
    return std::fabs(dot(face.normal, p) - face.offset) <= rounding;
  };
  const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
  std::size_t first = 0;  // neighbouring triangles often lie in one face
  for (std::uint32_t t = 0; t < count; ++t) {
    std::size_t tried = 0;
    for (; tried < faces.size(); ++tried) {
      const auto &face = faces[(first + tried) % faces.size()];
      if (is_near(face, mesh.corner(t, 0)) && is_near(face, mesh.corner(t, 1)) && is_near(face, mesh.corner(t, 2))) break;
    }
    if (tried == faces.size()) return false;
    first = (first + tried) % faces.size();
  }
  return true;
}

// Whether two neighbouring faces are one, but for rounding.
bool has_bent_faces(const convex::Polytope &hull, double rounding) {
  const auto lies_in = [&](std::int32_t f, std::int32_t plane) {
    const auto &face = hull.faces()[static_cast<std::size_t>(f)], &other = hull.faces()[static_cast<std::size_t>(plane)];
    const std::int32_t *corners = hull.face_vertices().data() + face.first;
    return std::all_of(corners, corners + face.count, [&](std::int32_t v) {
      return std::fabs(dot(other.normal, hull.vertices()[static_cast<std::size_t>(v)]) - other.offset) <= rounding;
    });
  };
  const auto &edges = hull.edges();
  return std::any_of(edges.begin(), edges.end(), [&](const convex::Polytope::Edge &edge) {
    return lies_in(edge.face[0], edge.face[1]) || lies_in(edge.face[1], edge.face[0]);
  });
}

// Where planes meet: the place nearest to all of them, from `start` on. `start` itself where that is farther off than `most`, or
// the planes leave it open.
Vec3 meeting_place(const std::vector<const convex::Polytope::Face *> &planes, const Vec3 &start, double most) {
  // Normal equations: sum of n n' times the move = sum of n (offset - n . start).
  convex::SymmetricMatrix squares;
  Vec3 right, move;
  for (const auto *plane : planes) {
    squares.add_square(1.0, plane->normal);
    right = right + (plane->offset - dot(plane->normal, start)) * plane->normal;
  }
  return squares.solve(right, 1e-9, move) && norm(move) <= most ? start + move : start;
}

// The hull with faces that are one to rounding made flat: its corners are moved to where the planes of the merged faces meet.
bool build_flattened(const std::vector<Vec3> &vertices, double extent, double rounding, convex::Polytope &result) {
  convex::Polytope merged;
  if (!convex::build_convex_hull(vertices, merged, nullptr, nullptr, rounding / extent)) return false;
  std::vector<std::vector<const convex::Polytope::Face *>> planes(merged.vertices().size());
  for (const auto &face : merged.faces()) {
    for (std::int32_t k = 0; k < face.count; ++k) {
      planes[static_cast<std::size_t>(merged.face_vertices()[static_cast<std::size_t>(face.first + k)])].push_back(&face);
    }
  }
  std::vector<Vec3> corners;
  for (std::size_t v = 0; v < planes.size(); ++v) {
    corners.push_back(meeting_place(planes[v], merged.vertices()[v], 10.0 * rounding));
  }
  return convex::build_convex_hull(corners, result, nullptr, nullptr);
}

double volume_of(const convex::Polytope &hull) {
  double volume = 0.0;
  for (const auto &face : hull.faces()) {
    const std::int32_t *corners = hull.face_vertices().data() + face.first;
    const auto place = [&](std::int32_t k) { return hull.vertices()[static_cast<std::size_t>(corners[k])] - hull.center(); };
    for (std::int32_t k = 1; k + 1 < face.count; ++k) volume += dot(place(0), cross(place(k), place(k + 1))) / 6.0;
  }
  return volume;
}

}  // namespace

std::shared_ptr<const ContactPolytope> make_convex_mesh_hull(const TriangleMesh &mesh) {
  if (!mesh.closed() || mesh.vertices().size() > most_vertices) return nullptr;
  const double rounding = mesh_rounding * mesh.bound_radius();
  if (has_concave_edge(mesh, rounding)) return nullptr;
  convex::Polytope geometry;
  if (!convex::build_convex_hull(mesh.vertices(), geometry, nullptr, nullptr)) return nullptr;
  if (!lies_on_faces(mesh, geometry, rounding)) return nullptr;
  if (has_bent_faces(geometry, rounding)) {
    convex::Polytope flat;
    const bool built = build_flattened(mesh.vertices(), 2.0 * mesh.bound_radius(), rounding, flat);
    if (built && lies_on_faces(mesh, flat, 4.0 * rounding)) geometry = std::move(flat);
  }
  // A surface on the hull's that covers it twice, or folds, encloses another volume.
  const double volume = volume_of(geometry);
  if (!(std::fabs(mesh.mass_properties().volume - volume) <= 0.5 * volume)) return nullptr;
  return std::make_shared<const ContactPolytope>(std::move(geometry));
}

}  // namespace cmb
