// The last resort for polyhedral cores: every face, edge and vertex against every other.
#pragma once

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

struct EnumerationResult {
  double distance = 0.0;  // signed
  Vec3 direction;         // unit, from A to B
  Vec3 a, b;              // witness points, in A's frame
};

// Exact signed distance of two polyhedral cores, of which at least one has an interior, by trying all
// pairs of features: time grows with the product of the numbers of edges. Keeps no state.
EnumerationResult enumerate_features(const MinkowskiDifference &difference);

}  // namespace cmb::convex
