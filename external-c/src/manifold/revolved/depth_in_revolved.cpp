#include "manifold/revolved/depth_in_revolved.hpp"

namespace cmb {

namespace {

// The mean over the overlap of (radius^2 - distance from the axis^2)^2, summed over cones from the places' origin to the surface's parts.
double mean_square_in_mantle(const RevolvedBody &body, const OverlapSurface &surface) {
  const Vec3 &place = surface.place();
  const double at_place = -body.beyond_mantle(place), radius = body.radius_at(place.z);
  double sum = 0.0;
  for (const auto *const side : {&surface.of_a(), &surface.of_b()}) {
    for (const OverlapSurface::Node &node : *side) {
      const Vec3 &p = node.at;
      // A quadratic polynomial along the way.
      const double growth = body.slope * p.z;
      const double first = 2.0 * (radius * growth - place.x * p.x - place.y * p.y), second = growth * growth - p.x * p.x - p.y * p.y;
      const double along = at_place * at_place / 3.0 + at_place * first / 2.0 + (first * first + 2.0 * at_place * second) / 5.0 +
                           first * second / 3.0 + second * second / 7.0;
      sum += dot(p, node.area) * along;
    }
  }
  return sum / surface.volume();
}

}  // namespace

DepthInRevolved::DepthInRevolved(const RevolvedBody &body, const OverlapSurface &surface)
    : body_(body), place_(surface.place()) {
  const double z = place_.z + surface.middle().z, spread = surface.spread().m[2];
  double square[sides];
  square[base] = (z + body.half) * (z + body.half) + spread;
  const double radius = body.radius_at(z), radius_square = radius * radius + body.slope * body.slope * spread;
  const double part = 0.25 * body.across * body.across / radius_square;
  square[mantle] = part * mean_square_in_mantle(body, surface);
  square[top] = (body.half - z) * (body.half - z) + spread;
  const int count = body.is_cylinder() ? sides : top;
  double least = square[base];
  for (int k = 1; k < count; ++k) least = square[k] < least ? square[k] : least;
  double sum = 0.0, raised = 0.0, eighth[sides];  // of e^-8 and of e^-7, in units of the least
  for (int k = 0; k < count; ++k) {
    const double inverse = least / square[k], second = inverse * inverse, fourth = second * second;
    eighth[k] = fourth * fourth;
    sum += eighth[k];
    raised += fourth * second * inverse;
  }
  const double mean = raised / sum;
  least_ = least * mean;
  for (int k = 0; k < count; ++k) weight_[k] = eighth[k] * (8.0 * mean * least / square[k] - 7.0) / sum;
  of_radius_ = -weight_[mantle] * square[mantle] / radius_square;
  weight_[mantle] *= part;
  mean_ = weight_[base] * square[base] + weight_[top] * square[top];
}

double DepthInRevolved::excess(const Vec3 &p) const {
  const Vec3 at = place_ + p;
  const double above = at.z + body_.half, below = body_.half - at.z;
  const double radius = body_.radius_at(at.z), inside = body_.beyond_mantle(at);
  return weight_[base] * above * above + weight_[top] * below * below + weight_[mantle] * inside * inside +
         of_radius_ * radius * radius - mean_;
}

}  // namespace cmb
