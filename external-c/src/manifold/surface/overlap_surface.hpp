// The surface of what two convex bodies have in common, as places and areas that integrals are summed over.
#pragma once

#include "manifold/surface/surface_nodes.hpp"
#include "math/symmetric_matrix.hpp"

namespace cmb {

using convex::Mat3;
using convex::Vec3;

// Of body A within B, and of B within A. The rules are exact, or as good as, for polynomials of the fifth degree, along a mantle as far
// as its partner asks for (mantle.hpp).
class OverlapSurface {
 public:
  // From place(); their cones are found by sum().
  using Node = SurfaceNode;
  using Nodes = SurfaceNodes;

  // `place`: near the overlap.
  void start(const Vec3 &place) { a_.clear(), b_.clear(), place_ = place, area_[0] = area_[1] = 0.0; }
  const Vec3 &place() const { return place_; }
  Nodes &of_a() { return a_; }
  Nodes &of_b() { return b_; }
  const Nodes &of_a() const { return a_; }
  const Nodes &of_b() const { return b_; }

  // The mean of the surface's places, from the place; known whether it is closed or not.
  Vec3 middle_of_area() const;
  // Whether its area vectors sum to nothing, as good as; false where there are none.
  bool is_closed() const;
  // Finds what follows, and moves the place to the overlap's middle, as good as; false where the surface is not closed, or the bodies
  // overlap by rounding alone.
  bool sum() { return measure() && settle(); }
  // The two halves of that: areas and how open it is, before which nodes may still change; and all else.
  bool measure();
  bool settle();
  // After sum(): turns all to axes one of which is perpendicular to a face, where one bounds an overlap that is thin, so that the square of its
  // thickness is not a difference of squares of its width, nor that of its width one of its length. Returns the turn to these axes.
  Mat3 align();
  double volume() const { return volume_; }
  // What the area vectors sum to, of rounding and of rules that are not exact.
  double gap() const { return gap_; }
  // As good as: negative parts of what cancels count as positive.
  double area_a() const { return area_[0]; }
  double area_b() const { return area_[1]; }
  // Of the overlap, from the place.
  const Vec3 &middle() const { return middle_; }
  // The mean of the products of coordinates, from the middle.
  const convex::SymmetricMatrix &spread() const { return spread_; }

 private:
  // The mean of the products of coordinates, of nodes whose places are from the place.
  void find_spread();
  void turn_by(const Mat3 &turn);

  Nodes a_, b_;
  Vec3 place_;
  double volume_ = 0.0, gap_ = 0.0, area_[2] = {};
  Vec3 to_middle_;  // from the place, as good as; found by measure()
  Vec3 middle_;
  convex::SymmetricMatrix spread_;
};

}  // namespace cmb
