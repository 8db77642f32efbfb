// Distance of two convex cores by the algorithm of Gilbert, Johnson and Keerthi (1988).
//
// The nearest point of the simplex is found by looking at all of its faces that may hold it, and is kept perpendicular to edges and
// faces to rounding: near contact the direction and not the tiny vector decides. The search ends when upper and lower bound agree,
// when a vertex comes back, or when the distance no longer falls.
#pragma once

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

struct GjkResult {
  // apart: `closest` and the simplex hold the answer, proven to `gap`.
  // touching: the origin is in the simplex, or so near the difference that rounding decides.
  // uncertain: no proof in the steps allowed.
  enum class Status { apart, touching, uncertain };
  Status status = Status::uncertain;
  Vec3 closest;        // point of A - B nearest to the origin
  double lower = 0.0;  // proven lower bound of the distance (where apart)
  Vec3 direction;      // unit, from A to B: the direction that proves it
  DifferencePoint simplex[4];
  double weight[4] = {1, 0, 0, 0};  // convex combination of the simplex that gives `closest`
  int count = 0;
  int steps = 0;
};

// `first` is any direction (a guess from B to A makes it fast); `tolerance` the gap between upper and
// lower bound, in metres, that ends the search; so does, where both are positive, a gap of `enough` times the
// upper. Ends after at most 100 steps.
GjkResult gjk_distance(const MinkowskiDifference &difference, const Vec3 &first, double tolerance, double enough = 0.0);
// Begins a search, which gjk_continue() goes on with.
GjkResult gjk_start(const MinkowskiDifference &difference, const Vec3 &first);
// Goes on from a search that has begun, or ended apart, with smaller gaps; `result` is as if it had been asked for them at once.
void gjk_continue(const MinkowskiDifference &difference, double tolerance, double enough, GjkResult &result);

}  // namespace cmb::convex
