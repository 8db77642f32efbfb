// A tetrahedron whose corners stand for a distribution with the same first and second moments.
#pragma once

namespace cmb::convex {

constexpr int tetrahedron_corner_count = 4;
// Of mean 0; the mean of their products with themselves is the unit matrix.
constexpr double tetrahedron_corners[tetrahedron_corner_count][3] = {{1, 1, 1}, {1, -1, -1}, {-1, 1, -1}, {-1, -1, 1}};

}  // namespace cmb::convex
