// The distance of curved cores that are apart or hardly in each other, from projections onto them by turns.
#pragma once

#include "closed_distance.hpp"
#include "direction_refinement.hpp"
#include "minkowski_difference.hpp"

namespace cmb::convex {

// Whether distance_by_projections knows a core: all but ellipsoid and polytope.
inline bool has_projection(CoreShape core) { return lies_on_line(core) || has_point_formula(core); }

enum class Projected {
  apart,        // the height is minus the distance, proven to the tolerance
  overlapping,  // the height is perhaps the depth, which remains to be proven
  unknown
};

// A few projections from core to core come near enough to the nearest points to tell what these lie on; Newton's method
// does the rest, and its points prove the distance to `tolerance` (m). Both cores are such that has_projection.
Projected distance_by_projections(const MinkowskiDifference &difference, double tolerance, RefinedDirection &result);

}  // namespace cmb::convex
