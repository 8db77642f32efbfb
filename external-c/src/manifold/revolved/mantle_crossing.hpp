// The curve where two mantles cross.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "manifold/revolved/mantle.hpp"

namespace cmb {

// Followed from place to place: each next one lies in a plane across the curve, a step ahead, where Newton's method finds both mantles;
// steps are so short that the curve turns little. Adds what it follows to both mantles.
class MantleCrossing {
 public:
  // Of a curve, with the ways at its ends; of no use where it is not ahead all along.
  struct Piece {
    Vec3 from, chord, along, lean, lean_there;
    double length;
    bool ahead;
    Piece(const Vec3 &begin, const Vec3 &way, const Vec3 &end, const Vec3 &way_there);
    // By Hermite's cubic, which is as good as on the curve.
    Vec3 at(double part) const;
  };

  // Both in common axes. `followed`: room to work in, which grows in the first calls.
  MantleCrossing(Mantle &a, Mantle &b, std::vector<Piece> &followed);

  // A place of the curve where it comes between the ends of both bodies, and the outward normal of the end that it passes there.
  struct Corner {
    Vec3 at, normal;
  };
  // From a corner on to the next one, which is taken out of those that are left. False where the curve leads to none.
  bool follow(const Corner &from, std::vector<Corner> &left);
  // A loop between the ends that was not followed yet and is seen from `place`, or where one body's axis is in the other. False where there
  // is none, or it leaves the ends.
  bool follow_loop(const Vec3 &place);

 private:
  struct Side {
    Mantle *mantle;
    Vec3 axis, center;
    double slope, radius, half;  // radius in the middle
    explicit Side(Mantle &m);
    double height(const Vec3 &p) const { return dot(axis, p - center); }
    // Negative inside.
    double beyond(const Vec3 &p) const;
    Vec3 gradient(const Vec3 &p) const;
    // The cosine of the angle between two places about the axis.
    double turn(const Vec3 &p, const Vec3 &q) const;
    bool holds(const Vec3 &p) const { return std::fabs(height(p)) <= half && beyond(p) <= 0.0; }
    // Where the ray from `p`, inside, leaves the body; whether through the mantle.
    double way_out(const Vec3 &p, const Vec3 &ray, bool &through_mantle) const;
  };
  Vec3 tangent(const Vec3 &p) const;
  bool correct(const Vec3 &normal, Vec3 &p) const;
  bool step(const Vec3 &from, const Vec3 &way, double &length, Vec3 &to, Vec3 &way_there, double sense) const;
  bool is_on(const Piece &piece, const Vec3 &place, double &part) const;
  std::size_t corner_on(const Piece &piece, const std::vector<Corner> &corners) const;
  bool add_piece(const Piece &piece);
  bool find_loop(const Vec3 &inside, Vec3 &at) const;
  bool find(const Vec3 &inside, const Vec3 &pole, const Vec3 &equator, Vec3 &at) const;
  bool follow_loop_from(const Vec3 &start);

  const Side a_, b_;
  const double size_, bent_;
  std::vector<Piece> &followed_;
};

}  // namespace cmb
