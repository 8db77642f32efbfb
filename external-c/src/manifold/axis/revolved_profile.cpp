#include "manifold/axis/revolved_profile.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

RevolvedProfile::RevolvedProfile(const convex::ConvexBody &body)
    : radius_(body.half.x), half_(body.half.z), top_(body.core == convex::CoreShape::cone ? 0.0 : radius_) {
  const double inward = radius_ - top_;
  slant_ = std::sqrt(inward * inward + 4.0 * half_ * half_);
  normal_across_ = 2.0 * half_ / slant_;
  normal_along_ = inward / slant_;
}

RevolvedProfile::Part RevolvedProfile::nearest(const MeridianPlace &p) const {
  const double under = -half_ - p.height, over = is_cylinder() ? p.height - half_ : -HUGE_VAL, beside = over_mantle(p);
  if (under <= 0.0 && over <= 0.0 && beside <= 0.0) {
    return beside >= under && beside >= over ? Part::mantle : under >= over ? Part::base : Part::top;
  }
  if (under > 0.0 && p.across <= radius_) return Part::base;
  if (over > 0.0 && p.across <= top_) return Part::top;
  const double along = along_mantle(p);
  return along < 0.0 ? Part::base_rim : along > slant_ ? Part::top_rim : Part::mantle;
}

RevolvedProfile::Gap RevolvedProfile::gap(Part part, const MeridianPlace &p) const {
  const auto from_rim = [](double across, double height) -> Gap {
    const double distance = std::sqrt(across * across + height * height), inverse = distance > 0.0 ? 1.0 / distance : 0.0;
    return {distance, across * inverse, height * inverse};
  };
  switch (part) {
    case Part::base: return {-half_ - p.height, 0.0, -1.0};
    case Part::top: return {p.height - half_, 0.0, 1.0};
    case Part::mantle: return {over_mantle(p), normal_across_, normal_along_};
    case Part::base_rim: return from_rim(p.across - radius_, p.height + half_);
    default: return from_rim(p.across - top_, p.height - half_);
  }
}

double RevolvedProfile::to_edge(const MeridianPlace &p) const {
  const Part part = nearest(p);
  const Gap from_base_rim = gap(Part::base_rim, p), from_top_rim = gap(Part::top_rim, p), own = gap(part, p);
  if (own.distance > 0.0) return std::min(from_base_rim.distance, from_top_rim.distance);
  double aside;
  if (part == Part::mantle) {
    // Where the axis of revolution is as near as the mantle, all directions are.
    aside = std::min({along_mantle(p) + own.distance * base_sharpness(), p.across,
                      is_cylinder() ? half_ - p.height + own.distance : HUGE_VAL});
  } else {
    const double to_rim = radius_ - p.across;
    aside = to_rim + own.distance * base_sharpness();
    if (is_cylinder()) aside = std::min(aside, (part == Part::base ? half_ - p.height : half_ + p.height) + own.distance);
  }
  return std::max(0.0, aside);
}

}  // namespace cmb
