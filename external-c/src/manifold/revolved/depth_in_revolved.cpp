#include "manifold/revolved/depth_in_revolved.hpp"

namespace cmb {

DepthInRevolved::DepthInRevolved(const RevolvedBody &body, const Pose &in_axes, const OverlapSurface &surface)
    : axis_(in_axes.rotation.column(2)) {
  const Vec3 way = surface.place() - in_axes.translation;
  const double height = dot(axis_, way), radius_there = body.radius_at(height);
  from_axis_ = way - height * axis_;
  radius_slope_ = radius_there * body.slope, slope_square_ = body.slope * body.slope;
  there_ = radius_there * radius_there - norm2(from_axis_);
  const double z = height + dot(axis_, surface.middle()), spread = dot(axis_, convex::times(surface.spread(), axis_));
  const double radius = body.radius_at(z), radius_square = radius * radius + body.slope * body.slope * spread;
  const double part = 0.25 * body.across * body.across / radius_square;
  double square[sides];
  square[base] = (z + body.half) * (z + body.half) + spread;
  square[mantle] = part * mean_square_in_mantle(surface);
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
  const double of_radius = -weight_[mantle] * square[mantle] / radius_square;  // of r^2
  weight_[mantle] *= part;
  const double above = height + body.half, below = body.half - height;
  level_ = weight_[base] * (above * above - square[base]) + weight_[top] * (below * below - square[top]) +
           of_radius * radius_there * radius_there;
  growth_ = 2.0 * (weight_[base] * above - weight_[top] * below + of_radius * radius_slope_);
  bend_ = weight_[base] + weight_[top] + of_radius * slope_square_;
}

// The mean over the overlap of (r^2 - distance^2)^2, summed over cones from the surface's place to its parts.
double DepthInRevolved::mean_square_in_mantle(const OverlapSurface &surface) const {
  constexpr double third = 1.0 / 3.0, seventh = 1.0 / 7.0;
  const convex::LaneVec3 axis(axis_), from_axis(from_axis_);
  convex::Lanes sum{};
  for (const auto *const side : {&surface.of_a(), &surface.of_b()}) {
    side->visit_pairs([&](const OverlapSurface::Nodes::Pair &node) {
      const Inside<convex::Lanes> way = inside_along(node.at, dot(axis, node.at), from_axis);
      sum += node.cone * (there_ * there_ * third + way.first * (0.5 * there_ + 0.2 * way.first + third * way.second) +
                          way.second * (0.4 * there_ + seventh * way.second));
    });
  }
  return convex::sum_of(sum) / surface.volume();
}

// Of a mean of polynomials along the same cones.
void DepthInRevolved::find_mean_slope(const OverlapSurface &surface, Vec3 &slope, Vec3 &moment) const {
  slope = moment = {};
  const Vec3 there = 2.0 * (radius_slope_ * axis_ - from_axis_);  // how r^2 - distance^2 changes by the place
  for (const auto *const side : {&surface.of_a(), &surface.of_b()}) {
    for (const OverlapSurface::Node &node : *side) {
      const Vec3 &p = node.at;
      const double part = node.cone, rise = dot(axis_, p);
      const Inside<double> way = inside_along(p, rise, from_axis_);
      const Vec3 change = 2.0 * (slope_square_ * rise * axis_ - (p - rise * axis_));  // of that, along the way
      const double twice = 2.0 * weight_[mantle];
      // By powers of the part of the way, from the second on: 1/3, 1/4, ...
      const auto mean = [&](double third, double fourth, double fifth, double sixth) {
        return (twice * (there_ * third + way.first * fourth + way.second * fifth)) * there +
               (twice * (there_ * fourth + way.first * fifth + way.second * sixth)) * change +
               (growth_ * third + 2.0 * bend_ * rise * fourth) * axis_;
      };
      const Vec3 of_slope = mean(1.0 / 3.0, 1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0);
      slope = slope + part * of_slope;
      moment = moment + part * (cross(p, mean(1.0 / 4.0, 1.0 / 5.0, 1.0 / 6.0, 1.0 / 7.0)) - cross(surface.middle(), of_slope));
    }
  }
  slope = (1.0 / surface.volume()) * slope;
  moment = (1.0 / surface.volume()) * moment;
}

}  // namespace cmb
