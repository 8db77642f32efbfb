// Collects a file's polygons as triangles.
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "mesh/core/mesh_data.hpp"
#include "mesh/io/polygon_split.hpp"

namespace cmb::mesh {

// Corners come one by one; from the third on, each makes a triangle with the first and the one before. Once all vertices are
// there, unfold_all() puts right what that does to polygons that are not convex.
class PolygonReader {
 public:
  explicit PolygonReader(std::vector<Triangle> &triangles) : triangles_(triangles) {}

  // `place`: the polygon's line or number, for messages.
  void begin(std::size_t place) {
    count_ = 0;
    place_ = place;
  }
  // Returns false where the limit on triangles is reached.
  bool add(std::uint32_t vertex) {
    if (count_ == 0) first_ = vertex;
    if (count_ >= 2) {
      if (triangles_.size() >= MeshLimits::triangles) return false;
      triangles_.push_back({first_, last_, vertex});
      if (count_ == 3) larger_.push_back({triangles_.size() - 2, 3, place_});
      if (count_ >= 3) ++larger_.back().corners;
    }
    last_ = vertex;
    ++count_;
    return true;
  }
  std::size_t count() const { return count_; }

  // Hands the place of a polygon that is none to `refuse`, which throws. `data` holds the triangles.
  template <typename Refuse>
  void unfold_all(MeshData &data, Refuse &&refuse) const {
    for (const PolygonFan &fan : larger_) {
      if (!unfold(fan, data)) refuse(fan.place);
    }
  }

  // What to say of it: problem and remedy.
  static std::pair<std::string, std::string> not_a_polygon() {
    return {"a face whose border crosses itself or encloses nothing, or a concave one of more than " +
                std::to_string(most_folded_corners) + " corners",
            "export it as triangles"};
  }

  // What to say where add() returns false: problem and remedy.
  static std::pair<std::string, std::string> limit_reached() {
    return {"more than " + std::to_string(MeshLimits::triangles) + " triangles", "export with a coarser tolerance"};
  }

 private:
  std::vector<Triangle> &triangles_;
  std::vector<PolygonFan> larger_;  // than triangles
  std::size_t count_ = 0, place_ = 0;
  std::uint32_t first_ = 0, last_ = 0;
};

}  // namespace cmb::mesh
