// What counts below the plane of a triangle of a mesh: convex, between planes.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/wedges/fold_regions.hpp"
#include "mesh/wedges/triangle_wedge.hpp"
#include "mesh/wedges/wedge_plane.hpp"

namespace cmb::mesh {

// Visits what bounds a wedge but for its sides: the depth that nothing counts beyond, the roof of its flat face and what parts it from other sides of the
// mesh; those that may cut what is less than `deepest` below the triangle. Stops, and returns false, where visit(plane) does.
template <typename Visit>
bool visit_inner_planes(const TriangleMesh &mesh, std::uint32_t t, double deepest, Visit &&visit) {
  const Vec3 &normal = mesh.face_normal(t);
  const double limit = mesh.depth_limit(t);
  if (limit < deepest && !visit(WedgePlane{normal, dot(normal, mesh.corner(t, 0)) - limit, false})) return false;
  const PlanarFaces::Roof roof = mesh.faces().roof(t);
  for (const std::uint32_t *k = roof.begin; k != roof.end && deepest > roof.clear_depth; ++k) {
    const RoofPlane &plane = mesh.faces().plane(*k);
    const double scale = 1.0 / norm(plane.normal);
    if (!visit(WedgePlane{scale * plane.normal, scale * plane.offset, plane.beyond < mesh.faces().face_of(t)})) return false;
  }
  const WedgeCuts::Planes cuts = mesh.wedge_cuts(t);
  for (const WedgeCuts::Plane *cut = cuts.begin; cut != cuts.end; ++cut) {
    if (deepest > cut->clear_depth && !visit(WedgePlane{cut->normal, cut->offset, cut->beyond < mesh.faces().face_of(t)})) return false;
  }
  return true;
}

// A triangle's wedge, or what counts for it beyond a fold. Borrows the mesh.
class WedgeRegion {
 public:
  WedgeRegion(const TriangleMesh &mesh, std::uint32_t t) : mesh_(&mesh), triangle_(t), sides_(&mesh.wedge_sides(t)) {}
  WedgeRegion(const TriangleMesh &mesh, const FoldRegion &fold)
      : mesh_(&mesh), fold_(&fold), triangle_(fold.triangle), sides_(&fold.sides) {}

  // Below which places count.
  std::uint32_t triangle() const { return triangle_; }
  const std::array<WedgeSide, 3> &sides() const { return *sides_; }
  // A place of side k in the triangle's plane.
  const Vec3 &place_on_side(std::size_t k) const {
    return fold_ == nullptr ? mesh_->corner(triangle_, k) : k < 2 ? fold_->from : fold_->to;
  }
  // A place of its own, or of its border.
  Vec3 middle() const {
    if (fold_ != nullptr) return 0.5 * (fold_->from + fold_->to);
    return (1.0 / 3.0) * (mesh_->corner(triangle_, 0) + mesh_->corner(triangle_, 1) + mesh_->corner(triangle_, 2));
  }

  // Visits all that bound it but the triangle's own plane, its sides first; those that may cut what is less than `deepest` below the triangle. Stops,
  // and returns false, where visit(plane) does.
  template <typename Visit>
  bool visit_planes(double deepest, Visit &&visit) const {
    if (fold_ != nullptr) {
      const FoldRegions::Planes planes = mesh_->fold_regions().planes(*fold_);
      for (const WedgePlane *plane = planes.begin; plane != planes.end; ++plane) {
        if (!visit(*plane)) return false;
      }
      return true;
    }
    for (std::size_t k = 0; k < 3; ++k) {
      const WedgeSide &side = (*sides_)[k];
      if (!visit(WedgePlane{side.normal, side.offset, gives_side_away(*mesh_, triangle_, k)})) return false;
    }
    return visit_inner_planes(*mesh_, triangle_, deepest, visit);
  }

 private:
  const TriangleMesh *mesh_;
  const FoldRegion *fold_ = nullptr;
  std::uint32_t triangle_;
  const std::array<WedgeSide, 3> *sides_;
};

// The wedge of triangle t, and what in it counts for the faces across its folds.
template <typename Visit>
void visit_regions(const TriangleMesh &mesh, std::uint32_t t, Visit &&visit) {
  visit(WedgeRegion(mesh, t));
  const FoldRegions::Regions folds = mesh.fold_regions().of(t);
  for (const FoldRegion *fold = folds.begin; fold != folds.end; ++fold) visit(WedgeRegion(mesh, *fold));
}

}  // namespace cmb::mesh
