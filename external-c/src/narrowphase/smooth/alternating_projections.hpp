// Where curved cores touch or come nearest to each other, from projections onto them in alternation.
#pragma once

#include "narrowphase/analytic/closed_form_distance.hpp"
#include "narrowphase/minkowski_difference.hpp"
#include "narrowphase/smooth/direction_refinement.hpp"

namespace cmb::convex {

// Whether direction_by_alternating_projections knows a core: all but ellipsoid and polytope.
inline bool has_projection(CoreShape core) { return lies_on_line(core) || has_point_formula(core); }

// A few projections from core to core, both shrunk to `part` (<= 1) of their size, come near enough to the nearest points
// to tell what these lie on; Newton's method does the rest (feature_direction.hpp). Shrunk, the cores are apart where they
// hardly overlap. Whether it is the least height of all remains to be proven; false where none was found. Both cores are
// such that has_projection.
bool direction_by_alternating_projections(const MinkowskiDifference &difference, double part, int rounds,
                                          RefinedDirection &result);

}  // namespace cmb::convex
