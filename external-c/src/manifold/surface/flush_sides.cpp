#include "manifold/surface/flush_sides.hpp"

#include <cmath>

#include "math/branchless.hpp"

namespace cmb {

void FlushSides::start(const OverlapSurface &surface, double thickness) {
  constexpr double part = 0.05, extent = 4.0;  // of the thickness; of the root of the mean square, what lies farther counts for little
  count_ = 0;
  fading_ = part * thickness;
  width_ = extent * std::sqrt(surface.spread().trace());
}

void FlushSides::add(const Vec3 &normal_a, double offset_a, const Vec3 &normal_b, double offset_b) {
  const double cosine = dot(normal_a, normal_b);
  if (!(cosine > least_cosine) || count_ == most) return;
  const double sine = norm(cross(normal_a, normal_b));
  if (std::fabs(offset_a - offset_b) > fading_ + sine * width_) return;
  sides_[count_++] = {{normal_a, offset_a}, {normal_b, offset_b}, (cosine - least_cosine) / (1.0 - least_cosine)};
}

double FlushSides::share(const OverlapSurface::Node &node, Plane Sides::*own, Plane Sides::*other) const {
  constexpr double along = 1e-20;  // squared: whether it is of that side
  double least = 1.0;
  for (std::size_t k = 0; k < count_; ++k) {
    const Sides &sides = sides_[k];
    if (norm2(cross((sides.*own).normal, node.area)) > along * norm2(node.area)) continue;
    const double below = (sides.*other).offset - dot((sides.*other).normal, node.at);
    least = std::fmin(least, 1.0 - sides.most * convex::within_unit(0.5 - 0.5 * below / fading_));
  }
  return least;
}

}  // namespace cmb
