// Integrals over the common part of a convex polytope and of round solids.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/slices/slice_range.hpp"

namespace cmb::overlap {

// Room to work in; one for each thread. Grows in the first calls.
//
// The solid is cut into slices of equal y, see SolidSlice. Over y the integrals are smooth but where the border's order
// changes. Gauss' and Kronrod's rules tell where they are off; such stretches are cut where the order changes, which
// bisection finds, or in the middle.
class SlicedOverlap {
 public:
  // guess: y that may be inside. relative_error: of each part that the volume and the sides' areas are added up from.
  SlicedSums measure(const CommonSolid &solid, const double *guess, int guess_count, double relative_error);

 private:
  struct Piece {
    double begin, end;
    int depth;
    SlicedSums sums = {};
    double error_volume = 0.0, error_area = 0.0;

    double area() const { return 0.5 * (sums.solid.upper.area + sums.solid.lower.area); }
  };
  void cut_at_kinks();
  void integrate(Piece &piece);
  void refine(const Piece &piece);
  double order_change(double low, std::uint64_t at_low, double high);

  SolidSlice slice_;
  EdgeCrossings crossings_;
  Stretch range_;  // y of all that is not empty
  std::vector<Piece> pieces_, pending_;
};

}  // namespace cmb::overlap
