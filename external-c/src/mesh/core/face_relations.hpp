// How the flat faces of a mesh lie to each other.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "mesh/core/mesh_data.hpp"

namespace cmb::mesh {

// Of faces and single triangles, by PlanarFaces' numbers. Immutable.
class FaceRelations {
 public:
  FaceRelations() = default;
  FaceRelations(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours, const std::vector<Vec3> &normals,
                const std::vector<std::uint32_t> &face_of);

  // Whether contacts with two faces are one: 1 where their normals are less than 45 degrees apart, and of faces of a convex edge; 0 for a floor and a
  // wall, which lie before each other. Symmetric; the same for every cut of the faces into triangles.
  // Not to be asked where all_together().
  double together(std::uint32_t a, std::uint32_t b) const;
  // Whether the faces share an edge at which their wedges end in one plane, with all that counts for either going over into what counts for the other:
  // but at folds whose sides do not count together. Symmetric. Not to be asked where all_together().
  bool go_over(std::uint32_t a, std::uint32_t b) const;
  // No face lies before its neighbour: all contacts are one.
  bool all_together() const { return all_together_; }

 private:
  struct Face {
    Vec3 normal;
    double offset = 0.0, size = 0.0;
    std::uint32_t first = 0, count = 0;                    // of the corners
    std::uint32_t first_beside = 0, count_beside = 0;      // of the faces that it goes over into
  };
  double height(const Face &face, const Face &above) const;
  void find_beside(const MeshData &data, const std::vector<std::array<std::int32_t, 3>> &neighbours, const std::vector<Vec3> &normals,
                   const std::vector<std::uint32_t> &face_of);

  std::vector<Face> faces_;
  std::vector<Vec3> corners_;  // about as far out as any of the face's
  std::vector<std::uint32_t> beside_;  // rising, of each face
  bool all_together_ = true;
};

}  // namespace cmb::mesh
