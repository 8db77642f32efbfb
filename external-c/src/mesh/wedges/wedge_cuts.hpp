// Planes that part what is behind a triangle from other sides of the mesh that reach into its wedge.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/core/mesh_data.hpp"
#include "mesh/core/planar_faces.hpp"
#include "mesh/core/triangle_hierarchy.hpp"
#include "mesh/wedges/wedge_plane.hpp"

namespace cmb::mesh {

// The planes that halve angles to neighbours part a triangle from these alone: what is far behind it may be right behind another one, as what is
// high above the sole of an L is behind its floor, and would count as deep. So whatever of the surface is in a wedge is parted from the
// triangle by the plane that halves the angle to it. Immutable.
class WedgeCuts {
 public:
  struct Plane {
    Vec3 normal;  // inward, unit
    double offset = 0.0;
    std::uint32_t beyond = 0;  // the flat face there
    double clear_depth = 0.0;  // above it nothing is cut
  };
  struct Planes {
    const Plane *begin = nullptr, *end = nullptr;
  };

  WedgeCuts() = default;
  // `limits`: of the triangles' depths (m); lessened where no plane parts a triangle, which is partly before it, from what is in its wedge:
  // to half of the way there.
  WedgeCuts(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours, const std::vector<Vec3> &normals,
            const std::vector<std::array<WedgeSide, 3>> &sides, const PlanarFaces &faces, const TriangleHierarchy &hierarchy, double size,
            std::vector<double> &limits);

  Planes of(std::uint32_t t) const { return {planes_.data() + first_[t], planes_.data() + first_[t + 1]}; }

 private:
  std::vector<Plane> planes_;
  std::vector<std::uint32_t> first_;
};

}  // namespace cmb::mesh
