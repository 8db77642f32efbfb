// Collects a file's polygons as triangles.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "mesh/mesh_data.hpp"

namespace cmb::mesh {

// Corners come one by one; from the third on, each makes a triangle with the first and the one before.
class PolygonReader {
 public:
  explicit PolygonReader(std::vector<Triangle> &triangles) : triangles_(triangles) {}

  void begin() { count_ = 0; }
  // Returns false where the limit on triangles is reached.
  bool add(std::uint32_t vertex) {
    if (count_ == 0) first_ = vertex;
    if (count_ >= 2) {
      if (triangles_.size() >= MeshLimits::triangles) return false;
      triangles_.push_back({first_, last_, vertex});
    }
    last_ = vertex;
    ++count_;
    return true;
  }
  std::size_t count() const { return count_; }

  // What to say where add() returns false: problem and remedy.
  static std::pair<std::string, std::string> limit_reached() {
    return {"more than " + std::to_string(MeshLimits::triangles) + " triangles", "export with a coarser tolerance"};
  }

 private:
  std::vector<Triangle> &triangles_;
  std::size_t count_ = 0;
  std::uint32_t first_ = 0, last_ = 0;
};

}  // namespace cmb::mesh
