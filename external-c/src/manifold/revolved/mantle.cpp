#include "manifold/revolved/mantle.hpp"

#include <cmath>

#include "math/gauss_rule.hpp"

namespace cmb {

namespace {

using overlap::gauss_rule;
using overlap::GaussNodes;

GaussNodes heights_of(const RevolvedBody &body, Mantle::Partner partner) {
  if (partner == Mantle::Partner::polytope) return body.is_cylinder() ? GaussNodes(gauss_rule<2>) : GaussNodes(gauss_rule<3>);
  return body.is_cylinder() ? GaussNodes(gauss_rule<3>) : GaussNodes(gauss_rule<4>);
}

}  // namespace

Mantle::Mantle(const RevolvedBody &body, const Pose &in_common, const Vec3 &place, bool to_apex, Partner partner,
               std::vector<BorderPlace> &border, OverlapSurface::Nodes &nodes, bool is_fitted)
    : body_(&body),
      in_common_(in_common),
      border_(&border),
      nodes_(&nodes),
      axis_(in_common.rotation.column(2)),
      from_place_(in_common.translation - place),
      to_apex_(to_apex),
      partner_(partner),
      is_fitted_(is_fitted) {
  border.clear();
  height_there_ = -dot(axis_, from_place_);
  from_axis_ = -from_place_ - height_there_ * axis_;
  radius_there_ = body.radius_at(height_there_);
  beyond_there_ = norm2(from_axis_) - radius_there_ * radius_there_;
}

// From the place on all terms are small.
OffSide Mantle::off(const Vec3 &at) const {
  const double rise = dot(axis_, at), slope = body_->slope, wider = slope * rise;
  const Vec3 across = at - rise * axis_;
  const double beyond = beyond_there_ + 2.0 * (dot(from_axis_, across) - radius_there_ * wider) + norm2(across) - wider * wider;
  const Vec3 steepest = 2.0 * (from_axis_ + across - (slope * (radius_there_ + wider)) * axis_);
  const double steepness = 1.0 / norm(steepest);
  return {steepness * beyond, steepness * steepest};
}

void Mantle::add_border_place(const Vec3 &outward, double height, double turn) {
  const Vec3 out = in_common_.rotation * outward;
  border_->push_back({body_->radius_at(height) * out + height * axis_ + from_place_, out, height - counted_from(), turn});
}

void Mantle::add_border_way(const Vec3 &at, const Vec3 &step, double sense) {
  double rise = dot(axis_, at);
  const Vec3 across = at - rise * axis_, from_axis = from_axis_ + across;
  const double distance = norm(from_axis);
  if (!(distance > 0.0)) return;
  const Vec3 outward = (1.0 / distance) * from_axis;
  // Of a flat cone the distance from the axis tells better.
  if (body_->slope < -1.0) {
    rise = (beyond_there_ + 2.0 * dot(from_axis_, across) + norm2(across)) / ((distance + radius_there_) * body_->slope);
  }
  border_->push_back({at, outward, rise, sense * dot(cross(axis_, outward), step) / distance});
}

double Mantle::rise_from(const Cut &cut, const BorderPlace &place) const {
  if (cut.is_level) return place.height + (counted_from() - height_there_) - cut.offset;
  return (dot(cut.normal, place.at) - cut.offset) / dot(cut.normal, axis_ + body_->slope * place.outward);
}

double Mantle::area_from(const Cut &cut) const {
  constexpr double steady = 0.9, inclined = 0.05;
  double area = 0.0, least = HUGE_VAL, most = -HUGE_VAL;
  for (const BorderPlace &place : *border_) {
    const double rise = rise_from(cut, place), rate = dot(cut.normal, axis_ + body_->slope * place.outward);
    least = std::fmin(least, rate), most = std::fmax(most, rate);
    area += std::fabs(place.turn * rise * (radius_from(place) - 0.5 * body_->slope * rise));
  }
  // A plane that is as good as along rulings they meet anywhere.
  const bool is_steady = least > 0.0 ? least > steady * most : most < steady * least;
  const double rate = std::fmin(std::fabs(least), std::fabs(most));
  return cut.is_level || (is_steady && rate * body_->across > inclined * norm(cut.normal)) ? area : HUGE_VAL;
}

// Two planes along the border: through its places that are farthest from each other, and the one farthest from these or upright on the mantle.
std::array<Mantle::Cut, 2> Mantle::cuts_along() const {
  const Vec3 &first = border_->front().at;
  const auto farthest = [&](const auto &measure) {
    const BorderPlace *best = &border_->front();
    for (const BorderPlace &place : *border_) best = measure(place.at) > measure(best->at) ? &place : best;
    return best;
  };
  const BorderPlace &last = *farthest([&](const Vec3 &at) { return norm2(at - first); });
  const Vec3 along = last.at - first;
  const Vec3 &aside = farthest([&](const Vec3 &at) { return norm2(cross(along, at - first)); })->at;
  const Vec3 in_plane = cross(along, aside - first), upright = cross(along, last.outward - body_->slope * axis_);
  return {Cut{in_plane, dot(in_plane, first), false}, Cut{upright, dot(upright, first), false}};
}

double Mantle::mean_height() const {
  double sum = 0.0, whole = 0.0;
  for (const BorderPlace &place : *border_) {
    const double part = std::fabs(place.turn);
    sum += part * place.height, whole += part;
  }
  return whole > 0.0 ? sum / whole : 0.0;
}

// Whether what is between that height and the border is much more than what is in the border. From a plane askew a cone's rulings are no
// polynomials of the angle: there only what is thin, within so small an angle that they are as good as that.
bool Mantle::cancels(double from) const {
  const double much = body_->is_cylinder() ? 3.0 : 30.0;
  double area = 0.0, added = 0.0;
  for (const BorderPlace &place : *border_) {
    const double rise = place.height - from, part = place.turn * rise * (radius_from(place) - 0.5 * body_->slope * rise);
    area += part, added += std::fabs(part);
  }
  return added > much * std::fabs(area);
}

void Mantle::integrate() {
  const double from = to_apex_ ? body_->half - counted_from() : mean_height();
  if (!is_fitted_ && (to_apex_ || !cancels(from))) {
    integrate_from(from);
    return;
  }
  Cut cut{axis_, is_fitted_ ? from : from - height_there_, true};
  if (!to_apex_ && !border_->empty()) {
    double least = area_from(cut);
    for (const Cut &along : cuts_along()) {
      const double area = area_from(along);
      if (area < least) least = area, cut = along;
    }
  }
  integrate_from(cut);
}

void Mantle::integrate_from(double height) {
  const GaussNodes heights = heights_of(*body_, partner_);
  for (const BorderPlace &place : *border_) {
    const double rise = place.height - height;
    for (std::size_t k = 0; k < heights.count; ++k) {
      const double z = height + heights.node[k] * rise, r = body_->radius_at(z), part = place.turn * rise * heights.weight[k] * r;
      nodes_->add(r * place.outward + z * axis_ + from_place_, part * (place.outward - body_->slope * axis_));
    }
  }
}

// From each place of the border along its ruling, so that what is thin keeps its digits.
void Mantle::integrate_from(const Cut &cut) {
  const GaussNodes heights = heights_of(*body_, partner_);
  const double slope = body_->slope;
  for (const BorderPlace &place : *border_) {
    const double rise = rise_from(cut, place), radius = radius_from(place);
    const Vec3 ruling = axis_ + slope * place.outward, outward = place.outward - slope * axis_;
    for (std::size_t k = 0; k < heights.count; ++k) {
      const double back = (1.0 - heights.node[k]) * rise, r = radius - slope * back;
      nodes_->add(place.at - back * ruling, (place.turn * rise * heights.weight[k] * r) * outward);
    }
  }
}

}  // namespace cmb
