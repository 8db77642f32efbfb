// Where a polytope's edges and corners lie in round solids.
#pragma once

#include <vector>

#include "volume/slices/common_solid.hpp"

namespace cmb::overlap {

// Its room grows in the first calls.
class EdgeCrossings {
 public:
  void find(const CommonSolid &solid);

  // The y, ascending, where slices' order is known to change: of corners inside all round solids, of edges that enter or
  // leave one inside the others, of apices.
  const std::vector<double> &kinks() const { return kinks_; }
  // A point of each edge that has any inside all round solids.
  const std::vector<Vec3> &inside() const { return inside_; }

 private:
  std::vector<double> kinks_;
  std::vector<Vec3> inside_;
};

}  // namespace cmb::overlap
