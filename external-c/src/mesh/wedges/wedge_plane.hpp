// Planes that bound what counts behind triangles of a mesh.
#pragma once

#include <cmath>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// A plane between what lies behind two neighbours (see make_wedge_side).
struct WedgeSide {
  Vec3 normal;  // inward, unit
  double offset = 0.0;
};

struct WedgePlane {
  Vec3 normal;  // inward, unit
  double offset = 0.0;
  bool strict = false;  // what lies in the plane counts beyond it
};

// One plane to rounding: a cap in the other one would be cut by chance. `size`: of the body.
inline bool coincide(const WedgePlane &p, const WedgePlane &q, double size) {
  constexpr double tolerance = 1e-9;
  return norm2(p.normal - q.normal) < tolerance * tolerance && std::fabs(p.offset - q.offset) < tolerance * size;
}

}  // namespace cmb::mesh
