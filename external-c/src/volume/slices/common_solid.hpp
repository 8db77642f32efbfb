// What a convex polytope and round solids have in common.
#pragma once

#include <cstdint>

#include "volume/convex_overlap.hpp"
#include "volume/slices/round_solid.hpp"

namespace cmb::overlap {

// Convex. Refers to its parts, which have to outlive it.
struct CommonSolid {
  const convex::OverlapScratch *polytope = nullptr;  // bounded, with faces
  const RoundSolid *rounds = nullptr;                // one or two
  int round_count = 0;
  std::int32_t marked_face = -2;  // source_face of the polytope's faces whose sums are taken apart; -2 for none

  // With one of its round solids alone.
  CommonSolid with_round(int k) const { return {polytope, rounds + k, 1, marked_face}; }
  // Whether all round solids but one, -1 for none, hold the point. Flat ends belong to the polytope.
  bool rounds_hold(const Vec3 &p, int but) const {
    for (int k = 0; k < round_count; ++k) {
      const Stretch along = rounds[k].stretch(p, {0.0, 0.0, 1.0});
      if (k != but && (along.empty() || along.begin > 0.0 || along.end < 0.0)) return false;
    }
    return true;
  }
};

}  // namespace cmb::overlap
