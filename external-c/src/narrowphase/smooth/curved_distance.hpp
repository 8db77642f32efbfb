// Signed distance of two convex cores of which one at least is an ellipsoid, cylinder or cone.
#pragma once

#include "narrowphase/analytic/closed_form_distance.hpp"

namespace cmb::convex {

// Directions (unit, from A to B) in which the difference's surface is known to be about as near as anywhere.
struct KnownMinima {
  static constexpr int most = 4;
  Vec3 direction[most];
  int count = 0;
};

// `first` is a direction from B to A (not zero) to begin with. Where places are known to be about equally near, none of the
// proofs for one alone is tried, and further ones as near count to rounding, not to a search's tolerance.
CoreDistance curved_distance(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &b_in_a, const Vec3 &first,
                             DistanceScratch &scratch, const KnownMinima *known = nullptr);

}  // namespace cmb::convex
