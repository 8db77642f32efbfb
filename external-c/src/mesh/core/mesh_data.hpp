// Triangles as a file or a descriptor gives them: nothing about them has been checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "math/vector3.hpp"

namespace cmb::mesh {

using convex::Mat3;
using convex::Pose;
using convex::Vec3;

// Corners by number, counter-clockwise seen from the front (the outside of a closed mesh).
using Triangle = std::array<std::uint32_t, 3>;

struct MeshData {
  std::vector<Vec3> vertices;  // m
  std::vector<Triangle> triangles;
};

// Limits that keep untrusted files from exhausting memory or time.
struct MeshLimits {
  static constexpr std::size_t triangles = 5'000'000;
  static constexpr std::size_t vertices = 3 * triangles;
  static constexpr std::size_t file_bytes = std::size_t{1} << 30;
};

// What is wrong with a mesh. The text names the file (or whatever the mesh came from), the element, and what to do.
class MeshError : public std::runtime_error {
 public:
  MeshError(const std::string &source, const std::string &problem, const std::string &remedy)
      : std::runtime_error(source + ": " + problem + "; " + remedy) {}
};

}  // namespace cmb::mesh
