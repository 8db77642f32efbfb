// Penetration depth of two convex cores by the expanding polytope algorithm (van den Bergen 2001), with these differences.
//
// Faces are taken by their distance from the origin, or the offset of their plane where that is negative, so the start need not
// hold the origin. A face farther than the depth need not be final: the way from the origin to a place of the surface within the
// ball of the depth crosses a face within the ball, which is. What a new point sees is found by flood fill, and its rim must be a
// single closed loop before anything is changed. Triangles too thin for a plane of their own take their neighbour's; a vertex that
// comes back means that a thin face's plane was off, and its neighbours decide: a face of width w can lower the depth by no more
// than w below its neighbours'. Faces that cannot beat the best support value are never queued.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "narrowphase/minkowski_difference.hpp"
#include "shape/incremental_hull.hpp"

namespace cmb::convex {

struct PenetrationResult {
  double depth = 0.0;  // smallest value found of the difference's support function; proven where `proven`
  double lower = 0.0;  // proven lower bound
  Vec3 direction;      // unit, where `depth` is taken: the surface of A - B nearest to the origin
  Vec3 a, b;           // witness points, in A's frame
  bool proven = false;
  int steps = 0;
  // Where not proven: directions, well apart from each other, in which the surface may be nearer. Where find_others was
  // called: in which it may be as near.
  static constexpr int most_others = 24;
  Vec3 other[most_others];
  int other_count = 0;
};

// Works in storage allocated by the constructor alone. Not for sharing between threads.
class ExpandingPolytope {
 public:
  explicit ExpandingPolytope(std::size_t max_points = 1024);

  // Depth of the origin in the difference, to `tolerance` metres, in at most `most_points` points of the
  // difference. `simplex` (count 1 to 4) are points to start from. Not proven where rounding broke the
  // surface, where the points did not suffice, or where the difference is flat (depth and direction are
  // then the best so far).
  PenetrationResult depth(const MinkowskiDifference &difference, const DifferencePoint *simplex, int count,
                          double tolerance, std::int32_t most_points);

  // Goes on from the search that ended last, of the same difference and with steps, to a lesser tolerance.
  PenetrationResult go_on(const MinkowskiDifference &difference, const PenetrationResult &before, double tolerance, std::int32_t most_points);

  // Of the depth found last: sets the other directions in which the surface may be no farther than `depth`.
  void find_others(double depth, PenetrationResult &result) const;

 private:
  bool start(const MinkowskiDifference &difference, const DifferencePoint *simplex, int count);
  bool start_from(const DifferencePoint *tetrahedron, double thickness);
  void search(const MinkowskiDifference &difference, double tolerance, std::int32_t most_points, PenetrationResult &result);
  void other_directions(PenetrationResult &result);
  void witness(PenetrationResult &result) const;

  IncrementalHull hull_;
  std::vector<DifferencePoint> points_;
  std::vector<std::pair<double, std::int32_t>> queue_;  // heap: faces by offset, least first
};

}  // namespace cmb::convex
