// How deep an overlap is below the faces of a polytope, by their soft least mean square.
#pragma once

#include <vector>

#include "math/lanes.hpp"
#include "math/symmetric_matrix.hpp"
#include "shape/contact_polytope.hpp"

namespace cmb {

using convex::Pose;

// A quadratic polynomial of a place x: x . (squares x) - 2 linear . x + constant.
struct Quadric {
  convex::SymmetricMatrix squares;
  Vec3 linear;
  double constant = 0.0;

  double at(const Vec3 &x) const { return dot(convex::times(squares, x) - 2.0 * linear, x) + constant; }
  // At two places.
  convex::Lanes at(const convex::LaneVec3 &x) const {
    return dot(times(squares, x) - convex::LaneVec3(2.0 * linear), x) + constant;
  }
};

// softmin over the faces f of (mean of s_f^2 over the overlap), s_f being the depth of a place below face f, and
// softmin(e) the sum of e^-7 over that of e^-8.
class DepthBelowFaces {
 public:
  // `overlap_middle` and `overlap_spread` (the mean of the products of coordinates from the middle): in the axes that `in_axes`
  // maps the body's frame to.
  void find(const Vec3 &overlap_middle, const convex::SymmetricMatrix &overlap_spread, const ContactPolytope &body,
            const Pose &in_axes);

  double least() const { return least_; }
  // The sum of the faces' squares by the derivatives of the softmin, of places from the overlap's middle; its mean is least().
  const Quadric &squares() const { return squares_; }
  // The mean over the overlap of place x the squares' gradient.
  const Vec3 &moment() const { return moment_; }

 private:
  // Near faces: normals in the overlap's axes, and the least mean square by each one's.
  struct PairOfFaces {
    convex::LaneVec3 normal;
    convex::Lanes below, mean_square, inverse;
  };

  double least_ = 0.0;
  Quadric squares_;
  Vec3 moment_;
  std::vector<double> bounds_;               // by group of faces
  std::vector<double> below_, mean_square_;  // by face: of the overlap's middle, over the overlap
  std::vector<std::size_t> groups_;          // that were looked at: their first faces
  std::vector<std::size_t> near_;            // faces that count
  std::vector<PairOfFaces> pairs_;           // in step, two at once
};

}  // namespace cmb
