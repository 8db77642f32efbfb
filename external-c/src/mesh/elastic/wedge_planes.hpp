// The planes that bound what counts behind a triangle of a mesh.
#pragma once

#include <cmath>
#include <cstdint>

#include "mesh/core/triangle_mesh.hpp"
#include "mesh/core/triangle_wedge.hpp"

namespace cmb::mesh {

struct WedgePlane {
  Vec3 normal;  // inward, unit
  double offset = 0.0;
  bool strict = false;  // what lies in the plane counts for the wedge beyond
};

// One plane to rounding: a cap in the other one would be cut by chance. `size`: of the body.
inline bool coincide(const WedgePlane &p, const WedgePlane &q, double size) {
  constexpr double tolerance = 1e-9;
  return norm2(p.normal - q.normal) < tolerance * tolerance && std::fabs(p.offset - q.offset) < tolerance * size;
}

// Visits all but the triangle's own: the wedge's sides, where nothing counts any deeper, the roof of its flat face and what parts it from other sides of the mesh; those that may cut
// what is less than `deepest` below the triangle. Stops, and returns false, where visit(plane) does.
template <typename Visit>
bool visit_wedge_planes(const TriangleMesh &mesh, std::uint32_t t, double deepest, Visit &&visit) {
  for (std::size_t k = 0; k < 3; ++k) {
    const WedgeSide &side = mesh.wedge_sides(t)[k];
    if (!visit(WedgePlane{side.normal, side.offset, gives_side_away(mesh, t, k)})) return false;
  }
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

}  // namespace cmb::mesh
