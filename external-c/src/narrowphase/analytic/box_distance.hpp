// The distance of two boxes or segments that are apart.
//
// The nearest points are six coordinates within bounds that minimise a square. The search begins where three projections in
// alternation end; then one coordinate after the other that the difference draws inwards is moved, those that are free following,
// until the bound from the extents along the difference agrees with it. Each step comes nearer, so that there is an end.
#pragma once

#include "narrowphase/analytic/closed_form_distance.hpp"

namespace cmb::convex {

// Whether distance_of_disjoint_boxes knows a core: a box, a segment or a point, all boxes with some half lengths zero.
inline bool is_box_like(CoreShape core) { return core == CoreShape::box || lies_on_line(core); }

// Of boxes centred at the origins of their frames, by half lengths >= 0; B's pose in A's frame. The answer is proven to
// `tolerance` (m). False, and nothing known, where the boxes overlap or are so near that rounding decides.
bool distance_of_disjoint_boxes(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a, double tolerance,
                                CoreDistance &result);

}  // namespace cmb::convex
