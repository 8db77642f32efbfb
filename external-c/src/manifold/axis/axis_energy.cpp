#include "manifold/axis/axis_energy.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/gauss_rule.hpp"

namespace cmb {

namespace {

// Two places of a rule at once.
typedef double Two __attribute__((vector_size(16)));
double total(Two x) { return x[0] + x[1]; }

// The part of [first, last] where constant + 2 slope x + curvature x^2 is negative; curvature >= 0.
std::pair<double, double> negative_part(double constant, double slope, double curvature, double first, double last) {
  const double discriminant = slope * slope - curvature * constant;
  if (!(discriminant > 0.0)) return constant < 0.0 ? std::pair(first, last) : std::pair(0.0, 0.0);
  const double sum = -slope - std::copysign(std::sqrt(discriminant), slope);
  const double x = sum / curvature, y = constant / sum;  // without curvature x is infinite
  return {std::max(first, std::min(x, y)), std::min(last, std::max(x, y))};
}

}  // namespace

void AxisEnergy::add_round(const Vec3 &gap, const Vec3 &slope, double shallow, double linear, double curvature, double reach,
                           double from, double to) {
  const auto [first, last] = negative_part(shallow, linear, curvature, from, to);
  if (!(last > first)) return;
  extend(first, last);
  // Where the axis nearly meets the obstacle, the gap bends at the nearest place: no rule goes over it.
  const double bend = -linear / curvature;
  if (bend > first && bend < last && reach * reach + shallow + linear * bend < 0.64 * reach * reach) {
    integrate_round(gap, slope, shallow, linear, curvature, reach, first, bend);
    integrate_round(gap, slope, shallow, linear, curvature, reach, bend, last);
  } else {
    integrate_round(gap, slope, shallow, linear, curvature, reach, first, last);
  }
}

void AxisEnergy::integrate_round(const Vec3 &gap, const Vec3 &slope, double shallow, double linear, double curvature, double reach,
                                 double from, double to) {
  static constexpr int count = 8;
  const auto &rule = overlap::gauss_rule<count>;
  const double length = to - from, least = 1e-18 * reach * reach;  // of a gap that is no direction
  Two sum{}, first{}, second{}, cube{}, one{}, one_x{}, one_xx{}, square{}, square_x{}, square_xx{};
  for (std::size_t k = 0; k < count; k += 2) {
    const Two x = from + length * Two{rule.node[k], rule.node[k + 1]};
    const Two below = shallow + x * (2.0 * linear + curvature * x);  // the gap squared, less the reach squared
    const Two apart2 = reach * reach + below, apart{std::sqrt(std::max(apart2[0], least)), std::sqrt(std::max(apart2[1], least))};
    // By one division: that of apart * (reach + apart).
    const Two both = reach + apart, inverse = 1.0 / (apart * both), deep = -below * apart * inverse;
    const Two depth = deep > 0.0 ? deep : Two{}, weight = length * Two{rule.weight[k], rule.weight[k + 1]};
    const Two part = weight * depth, squared = depth * depth, by_gap = weight * both * inverse, deeper = by_gap * squared;
    sum += part, first += part * x, second += part * x * x, cube += part * squared;
    one += by_gap, one_x += by_gap * x, one_xx += by_gap * x * x;
    square += deeper, square_x += deeper * x, square_xx += deeper * x * x;
  }
  sum_ += total(sum), first_ += total(first), second_ += total(second), cube_ += total(cube);
  one_ = one_ + total(one) * gap + total(one_x) * slope;
  one_x_ = one_x_ + total(one_x) * gap + total(one_xx) * slope;
  square_ = square_ + total(square) * gap + total(square_x) * slope;
  square_x_ = square_x_ + total(square_x) * gap + total(square_xx) * slope;
}

void AxisEnergy::add_flat(const Vec3 &normal, double depth, double rate, double from, double to) {
  // Only where it is deep.
  const double end = depth / rate;  // without a rate it is infinite, or no number
  if (rate > 0.0) to = std::min(to, end);
  if (rate < 0.0) from = std::max(from, end);
  if (!(to > from)) return;
  extend(from, to);
  // All are of third degree at most: two places are exact.
  const auto &rule = overlap::gauss_rule<2>;
  const double length = to - from;
  const Two x = from + length * Two{rule.node[0], rule.node[1]}, linear = depth - rate * x;
  const Two deep = linear > 0.0 ? linear : Two{};
  const Two weight = length * Two{rule.weight[0], rule.weight[1]}, part = weight * deep, squared = part * deep;
  sum_ += total(part), first_ += total(part * x), second_ += total(part * x * x), cube_ += total(squared * deep);
  one_ = one_ + length * normal, one_x_ = one_x_ + (0.5 * length * (from + to)) * normal;
  square_ = square_ + total(squared) * normal, square_x_ = square_x_ + total(squared * x) * normal;
}

void AxisEnergy::add_place(double x, double weight, double depth, const Vec3 &direction) {
  if (!(depth > 0.0)) return;
  const double part = weight * depth, squared = part * depth;
  sum_ += part, first_ += part * x, second_ += part * x * x, cube_ += squared * depth;
  const Vec3 one = weight * direction, square = squared * direction;
  one_ = one_ + one, one_x_ = one_x_ + x * one;
  square_ = square_ + square, square_x_ = square_x_ + x * square;
}

bool AxisEnergy::carry(const convex::Mat3 &frame, const Vec3 &axis, const Vec3 &origin, double radius, double part, double deepest,
                       double sense, std::vector<ContactPoint> &points) const {
  if (!(cube_ > 0.0)) return false;
  const double by_sum = 1.0 / sum_, energy = 0.5 * cube_ * by_sum;
  const auto gradient = [&](const Vec3 &squares, const Vec3 &ones) {
    return frame * ((0.5 * by_sum) * (3.0 * squares - (2.0 * energy) * ones));
  };
  const Vec3 force = gradient(square_, one_);
  // Of its first moment along the axis the part across it alone turns the body.
  Vec3 moment = gradient(square_x_, one_x_);
  moment = moment - dot(moment, axis) * axis;
  const Vec3 across = force - dot(force, axis) * axis;
  const double across2 = norm2(across), middle = first_ * by_sum;
  const double place = across2 > 0.0 ? dot(moment, across) / across2 : middle;
  const double spread = std::sqrt(std::max(0.0, second_ * by_sum - middle * middle) + (place - middle) * (place - middle));
  const Vec3 difference = spread > 0.0 ? (1.0 / spread) * (moment - middle * across) : Vec3{};
  // What pushes along the axis goes with the rest: half of it each would turn the points' ways apart, and these are a radius off the axis.
  const double lean = across2 > 0.0 ? std::clamp(dot(difference, across) / across2, -1.0, 1.0) : 0.0;
  const Vec3 along = force - across;
  const Vec3 forces[2] = {0.5 * (across - difference + (1.0 - lean) * along), 0.5 * (across + difference + (1.0 + lean) * along)};
  const double lengths[2] = {norm(forces[0]), norm(forces[1])}, load = lengths[0] + lengths[1];
  if (!(load > 0.0)) return false;
  const double depth = std::min(2.0 * energy / load, deepest);
  for (int k = 0; k < 2; ++k) {
    if (!(lengths[k] > 0.0)) continue;
    const Vec3 normal = (1.0 / lengths[k]) * forces[k];  // from the obstacle to the capsule
    const double x = middle + (k == 0 ? -spread : spread);
    points.push_back({depth, part * lengths[k] / depth, sense * normal, origin + x * axis - (radius - 0.5 * depth) * normal});
  }
  return true;
}

}  // namespace cmb
