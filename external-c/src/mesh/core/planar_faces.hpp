// Flat faces of a mesh: triangles of one plane that hang together.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// The plane that halves the angle between a flat face and the one beyond a convex side of it: what lies behind the face, on the
// inner side of this plane, is nearer to the face's plane than to the other one's.
struct RoofPlane {
  Vec3 normal;  // inward, not unit
  double offset = 0.0;
  std::uint32_t beyond = 0;  // the flat face beyond the side
};

// Built of a mesh's triangles; immutable. Faces are numbered from 0.
class PlanarFaces {
 public:
  // The planes of a triangle's face that reach below the triangle: planes()[k] for k in `members`.
  struct Roof {
    const std::uint32_t *begin = nullptr, *end = nullptr;
    double clear_depth = 0.0;  // m: above it none of them cuts what is behind the triangle
  };

  PlanarFaces() = default;
  // `normals`: of the triangles, unit. `limits`: no plane counts deeper behind a triangle than that. `tolerance` (m): vertices
  // as far from a plane lie in it.
  PlanarFaces(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours, const std::vector<Vec3> &normals,
              const std::vector<double> &limits, double tolerance);

  std::uint32_t face_of(std::uint32_t t) const { return face_of_[t]; }
  const std::vector<std::uint32_t> &face_of() const { return face_of_; }
  const RoofPlane &plane(std::uint32_t k) const { return planes_[k]; }
  Roof roof(std::uint32_t t) const {
    return {members_.data() + first_[t], members_.data() + first_[t + 1], clear_depth_[t]};
  }

 private:
  std::vector<std::uint32_t> face_of_, members_, first_;
  std::vector<double> clear_depth_;
  std::vector<RoofPlane> planes_;
};

}  // namespace cmb::mesh
