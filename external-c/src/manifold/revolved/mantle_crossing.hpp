// The curve where two mantles cross.
#pragma once

#include <cstddef>
#include <vector>

#include "manifold/revolved/mantle_rulings.hpp"

namespace cmb {

// By the rulings of one mantle, each of which the other one crosses twice or not at all: so the curve consists of ovals, one over each interval
// of angles in which the discriminant is positive, or of two rings round the mantle. Corners, where it passes the bodies' ends, cut out of
// these what is between all ends.
class MantleCrossing {
 public:
  // Where a corner is on a strand of the curve; its place is in the frame of the mantle whose rulings serve.
  struct Cut {
    double parameter;
    Vec3 at, corner;
  };
  // Room to work in; it grows in the first calls.
  struct Cuts {
    std::vector<Cut> on[2];
  };

  // `in_other`: from the frame of the mantle whose rulings serve to that of the other one. `fitted`: room for places of edges, where they
  // are to be fitted to both sides.
  MantleCrossing(Mantle &ruled, Mantle &other, const Pose &in_other, Cuts &cuts, EdgePlaces *fitted);

  // In the frame of the mantle whose rulings serve, and in the nodes' axes.
  void add_corner(const Vec3 &at, const Vec3 &corner);
  // Adds the curve, as far as it is between the ends, to both mantles.
  void follow();

 private:
  // By a parameter of period 2 pi. Of an oval the angle is middle + half * sin(parameter), of a ring (half = 0) sense * parameter.
  struct Strand {
    double middle = 0.0, half = 0.0, sense = 1.0;
    TrigonometricPolynomial factor;  // the discriminant by cos(angle) - cos(half), angles counting from the middle
    std::vector<Cut> *cuts = nullptr;

    bool is_oval() const { return half > 0.0; }
    // The root of the discriminant by half * cos(parameter), by the angle from the middle and how far it is from both ends.
    double steepness(double angle, double above, double below) const;
  };
  // With its changes by the parameter.
  struct Place {
    double angle_cosine, angle_sine, height, turn;
    Vec3 at, in_other;  // in both frames
    double turn_in_other;
    EdgePlaces::Place fitted;
  };

  double height_in_other(const Place &place) const { return other_.body().height_on_mantle(place.in_other); }
  void find_strands();
  bool find_place(const Strand &strand, double parameter, Place &place) const;
  bool is_between_ends(const Strand &strand, double from, double to) const;
  void follow_strand(const Strand &strand);
  void close(const Cut *from, const Cut *to);
  // What is not known of an arc by its places, of its way and of what it adds to the other mantle's area.
  struct Unknown {
    double way, area;
  };
  // `before`: of the arc that this is a half of.
  void add_arc(const Strand &strand, double from, double to, int depth, const Unknown &before);
  static void fit_turn(const Vec3 &from, const Vec3 &to, std::size_t begin, std::vector<BorderPlace> &border);

  Mantle &ruled_, &other_;
  const Pose in_other_;
  const MantleRulings rulings_;
  const double size_;
  EdgePlaces *const fitted_;
  Strand strand_[2];
  int strands_ = 0, arcs_left_ = 200;  // the latter that may be halved
  double most_area_ = 0.0, widest_ = 0.0;  // that an arc has added to the other mantle's area, and as far as one came from its first place
};

}  // namespace cmb
