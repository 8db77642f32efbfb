// Slices y = const of what a convex polytope and round solids have in common.
#pragma once

#include <cstdint>
#include <vector>

#include "volume/slices/common_solid.hpp"
#include "volume/slices/flat_section.hpp"
#include "volume/solid_sums.hpp"

namespace cmb::overlap {

// Integrals over a slice, or over the whole solid. `marked`: the part of the upper side that lies in the marked faces.
struct SlicedSums {
  SolidSums solid;
  SideSums marked;

  void add(const SlicedSums &other, double factor) {
    solid.add(other.solid, factor);
    marked.add(other.marked, factor);
  }
};

// A slice's border consists of straight lines and conic sections: their corners are roots of quadratics, and of a quartic
// where two conics meet, and integrals along them are taken in variables in which they are smooth. Its room grows in the
// first calls.
class SolidSlice {
 public:
  // What the calls that follow cut.
  void start(const CommonSolid &solid) { solid_ = solid; }

  // Tells by a number which faces and surfaces the slice's border consists of, in which order; 0 where it is empty.
  std::uint64_t order(double y) { return walk(y, nullptr); }
  // Adds the slice's integrals over x and z.
  void add_to(SlicedSums &sums, double y) { walk(y, &sums); }

 private:
  // What a side is at a place: number of a segment, or of a round solid's piece.
  struct Side {
    double z = 0.0;
    int segment = -1, round = -1, piece = 0;
    bool same(const Side &other) const {
      return segment == other.segment && round == other.round && piece == other.piece;
    }
  };
  std::uint64_t walk(double y, SlicedSums *sums);
  void find_corners(double y);
  bool sides_at(double x, Side &lower, Side &upper) const;
  void add_side(const Side &side, bool upper, double y, double from, double to, SlicedSums &sums) const;

  CommonSolid solid_;
  FlatSection flat_;
  RoundSection rounds_[2];
  std::vector<double> corners_;  // x, ascending
};

}  // namespace cmb::overlap
