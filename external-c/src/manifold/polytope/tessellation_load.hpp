// What the corners of tessellated bodies carry together.
#pragma once

#include <algorithm>

#include "math/branchless.hpp"

namespace cmb {

// Few corners, or shallow ones, are springs: each carries its weight times its depth. A finely tessellated body would push
// with ever more of them the deeper it goes, the harder the finer it is; its smooth body would push with one point at the
// deepest place. So with the greatest depth D, counted in the tessellation's steps, contacts go over from springs to
// that point: the load, the sum of weight * depth, becomes the depth of the minimum translation, and is carried by the corners
// less than a few steps above the deepest, the less the higher. A load of more than D is never kept.
//
// All is continuous in the depths and weights of the corners.
class TessellationLoad {
 public:
  // `greatest`: the depth D (m, > 0); `fineness`: how many corners are met for each metre of depth (1/m, >= 0).
  TessellationLoad(double greatest, double fineness) : greatest_(greatest) {
    constexpr double springs_to = 1.0, smooth_from = 3.0, carrying = 1.2;  // steps
    const double steps = greatest * fineness;
    const double part = convex::within_unit((steps - springs_to) / (smooth_from - springs_to));
    smooth_ = part * part * (3.0 - 2.0 * part);
    const double height = steps > carrying ? carrying / fineness : greatest;
    rate_ = 1.0 / height;
    level_ = smooth_ * greatest - height;
  }

  // Depth (m) above which no corner carries; negative where all do.
  double level() const { return level_; }
  // The part of its weight that a corner of that depth keeps, before the scale.
  double part(double depth) const { return convex::within_unit((depth - level_) * rate_); }

  // What follows from the sums over all corners.
  struct Scale {
    double weight;  // by which all weights are multiplied
    double level;   // the depth at which a weight's change would not change the energy, m
  };
  // `load` (> 0) is the sum of weight * part * depth, `squares` that of weight * part * depth^2; `shortest` (m, > 0) the depth
  // of the minimum translation: D where that is along the contact normal, less where the normal is a mean of several ways'.
  //
  // With the weights w, parts p and depths d the energy is E = weight * sum(w p d^2) / 2, and its derivative by one weight,
  // while depths stay, is p d (weight * d - level) / 2.
  Scale scale(double load, double squares, double shortest) const {
    const double ratio = shortest / load;
    return {std::min(greatest_ / load, 1.0 + smooth_ * (ratio - 1.0)), smooth_ * ratio * squares / load};
  }

 private:
  double greatest_, smooth_, rate_, level_;
};

}  // namespace cmb
