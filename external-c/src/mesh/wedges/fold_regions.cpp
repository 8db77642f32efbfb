#include "mesh/wedges/fold_regions.hpp"

#include <cmath>
#include <limits>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/wedges/triangle_wedge.hpp"
#include "mesh/wedges/wedge_region.hpp"

namespace cmb::mesh {

namespace {

// A side of a triangle.
struct Side {
  std::uint32_t triangle;
  std::size_t number;
};

// The same side as its neighbour's; there is one.
Side across(const TriangleMesh &mesh, const Side &side) {
  const auto other = static_cast<std::uint32_t>(mesh.neighbour(side.triangle, side.number));
  const std::uint32_t begin = mesh.triangles()[side.triangle][side.number];
  std::size_t k = 0;
  while (mesh.triangles()[other][(k + 1) % 3] != begin || mesh.neighbour(other, k) != static_cast<std::int32_t>(side.triangle)) ++k;
  return {other, k};
}

bool is_border(const TriangleMesh &mesh, const Side &side) { return mesh.neighbour(side.triangle, side.number) < 0; }
std::uint32_t face_beyond(const TriangleMesh &mesh, const Side &side) {
  return mesh.faces().face_of(static_cast<std::uint32_t>(mesh.neighbour(side.triangle, side.number)));
}

// Whether the surface is folded inwards at the side so that the faces' contacts are not one.
bool is_fold(const TriangleMesh &mesh, const Side &side) {
  if (is_border(mesh, side) || mesh.face_relations().all_together()) return false;
  const auto other = static_cast<std::uint32_t>(mesh.neighbour(side.triangle, side.number));
  const Vec3 along = mesh.corner(side.triangle, side.number + 1) - mesh.corner(side.triangle, side.number);
  if (!(dot(cross(mesh.face_normal(side.triangle), mesh.face_normal(other)), along) < 0.0)) return false;
  return mesh.face_relations().together(mesh.faces().face_of(side.triangle), mesh.faces().face_of(other)) < 1.0;
}

// The other side at the corner where side k of a triangle begins, or ends.
std::size_t next_at(std::size_t k, bool at_begin) { return (k + (at_begin ? 2 : 1)) % 3; }

// The next side of the flat face there.
Side next_side_of_face(const TriangleMesh &mesh, Side side, bool at_begin) {
  const std::uint32_t face = mesh.faces().face_of(side.triangle);
  for (;;) {
    side.number = next_at(side.number, at_begin);
    if (is_border(mesh, side) || face_beyond(mesh, side) != face) return side;
    side = across(mesh, side);
  }
}

WedgePlane plane_of(const TriangleMesh &mesh, const Side &side) {
  const WedgeSide &plane = mesh.wedge_sides(side.triangle)[side.number];
  return {plane.normal, plane.offset, gives_side_away(mesh, side.triangle, side.number)};
}

// How far along the line in which two planes meet what is 1 deep below the triangle is.
double spread_along(const Vec3 &line, const Vec3 &normal) {
  const double down = std::fabs(dot(line, normal));
  return down > 0.0 ? norm(line) / down : HUGE_VAL;
}

}  // namespace

FoldRegions::FoldRegions(const TriangleMesh &mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.triangles().size());
  first_.assign(count + 1, 0);
  spreads_.assign(count, 0.0);
  for (std::uint32_t t = 0; t < count; ++t) {
    first_[t] = static_cast<std::uint32_t>(regions_.size());
    for (std::size_t k = 0; k < 3; ++k) {
      if (is_fold(mesh, {t, k})) add(mesh, t, k);
    }
  }
  first_[count] = static_cast<std::uint32_t>(regions_.size());
}

// Across the fold it goes on as the wedge of the other side does at the plane that parts the two, so that what comes through that plane counts the same
// way on both sides; but for planes to faces that are folded inwards there as well. On this side it ends where the flat face does.
void FoldRegions::add(const TriangleMesh &mesh, std::uint32_t t, std::size_t side) {
  const Side own{t, side}, opposite = across(mesh, own);
  FoldRegion region;
  region.triangle = opposite.triangle;
  region.from = mesh.corner(t, side);
  region.to = mesh.corner(t, side + 1);
  region.first = static_cast<std::uint32_t>(planes_.size());
  planes_.push_back(plane_of(mesh, own));
  region.sides.fill(mesh.wedge_sides(t)[side]);
  for (const bool at_begin : {true, false}) {
    const auto end_at = [&](const Side &border) {
      planes_.push_back(plane_of(mesh, border));
      const WedgeSide &plane = region.sides[at_begin ? 1 : 2] = mesh.wedge_sides(border.triangle)[border.number];
      for (const Vec3 &level : {region.sides[0].normal, mesh.face_normal(region.triangle)}) {
        spreads_[t] = std::fmax(spreads_[t], spread_along(cross(level, plane.normal), mesh.face_normal(t)));
      }
    };
    const Side beside = next_side_of_face(mesh, own, at_begin), beyond{opposite.triangle, next_at(opposite.number, !at_begin)};
    if (is_border(mesh, beside) || face_beyond(mesh, beside) != mesh.faces().face_of(opposite.triangle)) end_at(beside);
    if (!is_fold(mesh, beyond)) end_at(beyond);
  }
  for (const std::uint32_t triangle : {region.triangle, t}) {
    visit_inner_planes(mesh, triangle, std::numeric_limits<double>::infinity(), [this](const WedgePlane &plane) {
      planes_.push_back(plane);
      return true;
    });
  }
  region.count = static_cast<std::uint32_t>(planes_.size()) - region.first;
  regions_.push_back(region);
}

}  // namespace cmb::mesh
