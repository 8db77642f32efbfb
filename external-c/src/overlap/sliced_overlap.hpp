// The common part of a convex polytope and of round solids.
#pragma once

#include <cstdint>
#include <vector>

#include "convex/convex_overlap.hpp"
#include "overlap/round_solid.hpp"
#include "overlap/solid_sums.hpp"

namespace cmb::overlap {

// What a measurement tells. `marked`: the part of the upper side that lies in the polytope's faces of a given number.
struct SlicedSums {
  SolidSums solid;
  SideSums marked;
};

// Room to work in; one for each thread. Grows in the first calls.
//
// The solid is cut into slices of equal y. A slice's border consists of straight lines and conic sections: their corners are
// roots of quadratics, and of a quartic where two conics meet, and integrals along them are taken in variables in which
// they are smooth. Over y the integrals are smooth but where the border's order changes. Gauss' and Kronrod's rules tell
// where they are off; such stretches are cut where the order changes, which bisection finds, or in the middle.
class SlicedOverlap {
 public:
  // flat: the polytope, bounded; rounds: one or two, whose common part with it is measured. guess: y that may be
  // inside. relative_error: of each part that the volume and the sides' areas are added up from.
  SlicedSums measure(const convex::OverlapScratch &flat, const RoundSolid *rounds, int round_count, const double *guess,
                     int guess_count, double relative_error, std::int32_t marked_face = -2);

 private:
  struct Segment {
    double x0, z0, x1, z1;
    bool upper, marked;
    int face;
    double at(double x) const { return x <= x0 ? z0 : x >= x1 ? z1 : z0 + (x - x0) / (x1 - x0) * (z1 - z0); }
  };
  // What a side is at a place: number of a segment, or of a round solid's piece.
  struct Side {
    double z = 0.0;
    int segment = -1, round = -1, piece = 0;
    bool same(const Side &other) const {
      return segment == other.segment && round == other.round && piece == other.piece;
    }
  };
  struct Piece {
    double begin, end;
    SlicedSums sums;
    double error_volume, error_area;
    int depth;
  };

  // The order of the border of slice y, 0 where it is empty; adds its integrals to `sums`, unless null.
  std::uint64_t slice(double y, SlicedSums *sums);
  bool flat_section(double y);
  void find_corners(double y);
  bool sides_at(double x, Side &lower, Side &upper) const;
  void add_side(const Side &side, bool upper, double y, double from, double to, SlicedSums &sums) const;
  void find_kinks();
  bool find_inner(const double *guess, int guess_count, double &inner);
  double find_end(double inner, double end);
  void integrate(Piece &piece);
  double order_change(double low, std::uint64_t at_low, double high);
  void refine(const Piece &piece);

  const convex::OverlapScratch *flat_ = nullptr;
  const RoundSolid *rounds_ = nullptr;
  int round_count_ = 0;
  std::int32_t marked_face_ = -2;
  double low_ = 0.0, high_ = 0.0;      // of the slice
  double bottom_ = 0.0, top_ = 0.0;    // y of all that is not empty
  std::vector<Segment> segments_;
  RoundSection sections_[2];
  std::vector<double> corners_;
  std::vector<double> kinks_;
  std::vector<Vec3> touched_;  // places of the polytope's edges inside all round solids
  std::vector<Piece> pieces_, pending_;
};

}  // namespace cmb::overlap
