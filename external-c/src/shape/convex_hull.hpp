// The convex hull of a set of points as a polytope.
#pragma once

#include <string>
#include <vector>

#include "shape/polytope.hpp"

namespace cmb::convex {

// Builds the hull of `points` (finite). Triangles that lie in one plane to `tolerance` (relative to
// the extent) become one polygon; points inside, on faces or on edges to that tolerance are left
// out. Where slivers do not fit together, the tolerance is raised by tens, at most to a thousandfold.
// No point is outside the result by more than 100 tolerances. `kept` (may be null) receives the index
// in `points` of every vertex of `result`. Returns false, with the reason in `problem` (may be null),
// where the points span no volume. Deterministic. Allocates.
bool build_convex_hull(const std::vector<Vec3> &points, Polytope &result, std::vector<std::int32_t> *kept,
                       std::string *problem, double tolerance = 1e-11);

}  // namespace cmb::convex
