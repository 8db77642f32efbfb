#include "manifold/revolved/mantle_rulings.hpp"

namespace cmb {

MantleRulings::MantleRulings(const RevolvedBody &body, const RevolvedBody &other, const Pose &in_other) : body_(body) {
  const Vec3 u = in_other.rotation.column(0), v = in_other.rotation.column(1), axis = in_other.rotation.column(2);
  const double other_slope = other.slope;
  const auto product = [&](const Vec3 &p, const Vec3 &q) { return p.x * q.x + p.y * q.y - other_slope * other_slope * p.z * q.z; };
  // From where rulings count: their places are from + radius * outward + place * axis, or apex + (slope * outward - axis) / place.
  const Vec3 from = in_other({0.0, 0.0, body.is_cylinder() ? 0.0 : body.half});
  const double radius_there = other.radius_at(from.z);
  const auto slant = [&](const Vec3 &p) { return from.x * p.x + from.y * p.y - radius_there * other_slope * p.z; };
  const double along_u = slant(u), along_v = slant(v), along_axis = slant(axis);
  const double axis_u = product(axis, u), axis_v = product(axis, v), axis_axis = product(axis, axis), there = other.beyond_mantle(from);
  const double wide = body.is_cylinder() ? body.radius : -body.slope;
  const double uu = wide * wide * product(u, u), vv = wide * wide * product(v, v), uv = wide * wide * product(u, v);
  if (body.is_cylinder()) {
    second_ = axis_axis;
    first_ = {along_axis, wide * axis_u, wide * axis_v, 0.0, 0.0};
    zeroth_ = {there + 0.5 * (uu + vv), 2.0 * wide * along_u, 2.0 * wide * along_v, 0.5 * (uu - vv), uv};
  } else {
    second_ = there;
    first_ = {-along_axis, wide * along_u, wide * along_v, 0.0, 0.0};
    zeroth_ = {axis_axis + 0.5 * (uu + vv), -2.0 * wide * axis_u, -2.0 * wide * axis_v, 0.5 * (uu - vv), uv};
  }
  const double b = first_.constant, c = first_.cosine, s = first_.sine;
  discriminant_ = {b * b + 0.5 * (c * c + s * s) - second_ * zeroth_.constant, 2.0 * b * c - second_ * zeroth_.cosine,
                   2.0 * b * s - second_ * zeroth_.sine, 0.5 * (c * c - s * s) - second_ * zeroth_.cosine2,
                   c * s - second_ * zeroth_.sine2};
}

MantleRulings::Ruling MantleRulings::ruling(double angle) const {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c, s, first_.constant + first_.cosine * c + first_.sine * s, zeroth_.at(c, s)};
}

// Of the two forms of a quadratic's root that which takes no difference, but where it is one of rounding by another.
double MantleRulings::place_on(const Ruling &ruling, double growth) const {
  const double sum = ruling.first + growth;
  const bool adds = (ruling.first > 0.0) == (growth > 0.0);
  return adds && std::fabs(sum) * first_.size() > std::fabs(second_) * zeroth_.size() ? -ruling.zeroth / sum : (growth - ruling.first) / second_;
}

double MantleRulings::change(const Ruling &ruling, double place) const {
  return 2.0 * (first_.sine * ruling.cosine - first_.cosine * ruling.sine) * place + zeroth_.slope_at(ruling.cosine, ruling.sine);
}

}  // namespace cmb
