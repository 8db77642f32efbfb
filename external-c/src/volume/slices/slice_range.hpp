// Which slices y = const of a convex solid are not empty.
#pragma once

#include "volume/slices/edge_crossings.hpp"
#include "volume/slices/solid_slice.hpp"

namespace cmb::overlap {

// The stretch of y whose slices are not empty; empty itself where there is none. guess: y that may be inside. Unless it is
// empty, `slice` cuts `solid` and `crossings` are those of `solid` afterwards.
Stretch find_slice_range(const CommonSolid &solid, const double *guess, int guess_count, SolidSlice &slice,
                         EdgeCrossings &crossings);

}  // namespace cmb::overlap
