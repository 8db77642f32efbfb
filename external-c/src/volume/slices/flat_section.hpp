// Sections of a convex polytope by planes y = const.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "volume/convex_overlap.hpp"

namespace cmb::overlap {

using convex::Vec3;

// A polygon: one segment a face that the plane cuts and that is not upright. Its room grows in the first calls.
class FlatSection {
 public:
  struct Segment {
    double x0, z0, x1, z1;  // from left to right
    bool upper, marked;
    int face;
    double at(double x) const { return x <= x0 ? z0 : x >= x1 ? z1 : z0 + (x - x0) / (x1 - x0) * (z1 - z0); }
  };
  // `marked_face`: source_face of the faces whose segments are marked. False where the section has no width.
  bool cut(const convex::OverlapScratch &polytope, double y, std::int32_t marked_face);

  const std::vector<Segment> &segments() const { return segments_; }
  const Segment &segment(int k) const { return segments_[static_cast<std::size_t>(k)]; }
  double low() const { return low_; }  // x of its ends
  double high() const { return high_; }

 private:
  std::vector<Segment> segments_;
  double low_ = 0.0, high_ = 0.0;
};

}  // namespace cmb::overlap
