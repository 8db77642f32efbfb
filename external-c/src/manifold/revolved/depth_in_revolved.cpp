#include "manifold/revolved/depth_in_revolved.hpp"

namespace cmb {

DepthInRevolved::DepthInRevolved(const RevolvedBody &body, const Pose &in_axes, const OverlapSurface &surface)
    : body_(body), axis_(in_axes.rotation.column(2)) {
  const Vec3 way = surface.place() - in_axes.translation;
  height_ = dot(axis_, way);
  from_axis_ = way - height_ * axis_;
  const double z = height_ + dot(axis_, surface.middle()), spread = dot(axis_, convex::times(surface.spread(), axis_));
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
  of_radius_ = -weight_[mantle] * square[mantle] / radius_square;
  weight_[mantle] *= part;
  mean_ = weight_[base] * square[base] + weight_[top] * square[top];
}

DepthInRevolved::Inside DepthInRevolved::inside_along(const Vec3 &p) const {
  const double rise = dot(axis_, p), radius = body_.radius_at(height_), growth = body_.slope * rise;
  const Vec3 across = p - rise * axis_;
  return {radius * radius - norm2(from_axis_), 2.0 * (radius * growth - dot(from_axis_, across)), growth * growth - norm2(across)};
}

// The mean over the overlap of (r^2 - distance^2)^2, summed over cones from the surface's place to its parts.
double DepthInRevolved::mean_square_in_mantle(const OverlapSurface &surface) const {
  double sum = 0.0;
  for (const auto *const side : {&surface.of_a(), &surface.of_b()}) {
    for (const OverlapSurface::Node &node : *side) {
      const Inside way = inside_along(node.at);
      sum += node.cone * (way.there * way.there / 3.0 + way.there * way.first / 2.0 +
                                        (way.first * way.first + 2.0 * way.there * way.second) / 5.0 + way.first * way.second / 3.0 +
                                        way.second * way.second / 7.0);
    }
  }
  return sum / surface.volume();
}

double DepthInRevolved::excess(const Vec3 &p) const {
  const double rise = dot(axis_, p), z = height_ + rise, above = z + body_.half, below = body_.half - z, radius = body_.radius_at(z);
  const double inside = radius * radius - norm2(from_axis_ + p - rise * axis_);
  return weight_[base] * above * above + weight_[top] * below * below + weight_[mantle] * inside * inside +
         of_radius_ * radius * radius - mean_;
}

// Of a mean of polynomials along the same cones.
void DepthInRevolved::find_mean_slope(const OverlapSurface &surface, Vec3 &slope, Vec3 &moment) const {
  slope = moment = {};
  const double radius = body_.radius_at(height_);
  const Vec3 there = 2.0 * (radius * body_.slope * axis_ - from_axis_);  // how r^2 - distance^2 changes by the place
  // Of the ends' squares and of r^2: constant, and by the rise.
  const double flat = 2.0 * (weight_[base] * (height_ + body_.half) - weight_[top] * (body_.half - height_) +
                             of_radius_ * radius * body_.slope);
  const double flat_rise = 2.0 * (weight_[base] + weight_[top] + of_radius_ * body_.slope * body_.slope);
  for (const auto *const side : {&surface.of_a(), &surface.of_b()}) {
    for (const OverlapSurface::Node &node : *side) {
      const Vec3 &p = node.at;
      const double part = node.cone, rise = dot(axis_, p);
      const Inside way = inside_along(p);
      const Vec3 change = 2.0 * (body_.slope * body_.slope * rise * axis_ - (p - rise * axis_));  // of that, along the way
      const double twice = 2.0 * weight_[mantle];
      // By powers of the part of the way, from the second on: 1/3, 1/4, ...
      const auto mean = [&](double third, double fourth, double fifth, double sixth) {
        return (twice * (way.there * third + way.first * fourth + way.second * fifth)) * there +
               (twice * (way.there * fourth + way.first * fifth + way.second * sixth)) * change + (flat * third + flat_rise * rise * fourth) * axis_;
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
