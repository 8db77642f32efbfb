// Where the search for the ratio of speeds of restitution without memory begins, tabulated.
#pragma once

#include <array>
#include <cstddef>

namespace cmb {

// sigma of a law of damping, by the speed q of a contact: cubics between places that lie evenly in |q|/(|q| + scale), of
// sigma/(q + scale) for q > 0 and of its counterpart 1/sigma for q < 0, which are bounded. Right to 3e-6 for damping factors of
// 0.01 to 3, to 1e-4 up to 8.
class SigmaTable {
 public:
  static constexpr double largest_speed = 1e4;

  // sigma_at(q): the exact value and its derivative by q.
  template <class SigmaAt>
  explicit SigmaTable(const SigmaAt &sigma_at) {
    for (std::size_t k = 0; k <= intervals; ++k) {
      const double place = static_cast<double>(k) / intervals;
      const double approach = speed_at(place, scale_of_approach), separation = speed_at(place, scale_of_separation);
      const auto [sigma, slope] = sigma_at(approach);
      approach_[k] = knot(sigma, slope, approach, scale_of_approach);
      const auto [own, own_slope] = sigma_at(-separation);
      separation_[k] = knot(1.0 / own, own_slope / (own * own), separation, scale_of_separation);
    }
  }

  // q: -largest_speed ... largest_speed.
  double sigma(double q) const {
    return q > 0.0 ? value(approach_, q, scale_of_approach) : 1.0 / value(separation_, -q, scale_of_separation);
  }

 private:
  static constexpr std::size_t intervals = 32;
  static constexpr double scale_of_approach = 2.0, scale_of_separation = 1.0;

  struct Knot {
    double value, slope;  // by the place, of an interval's length
  };
  using Knots = std::array<Knot, intervals + 1>;

  static constexpr double last_share(double scale) { return largest_speed / (largest_speed + scale); }

  static double speed_at(double place, double scale) {
    const double share = place * last_share(scale);
    return share * scale / (1.0 - share);
  }

  // Of f/(q + scale) by q/(q + scale), whose derivative by q is scale/(q + scale)^2.
  static Knot knot(double f, double slope, double q, double scale) {
    const double sum = q + scale;
    return {f / sum, (slope * sum - f) / scale * (last_share(scale) / intervals)};
  }

  static double value(const Knots &knots, double q, double scale) {
    const double sum = q + scale, place = q / sum * (intervals / last_share(scale));
    const std::size_t k = place < intervals - 1 ? static_cast<std::size_t>(place) : intervals - 1;
    const Knot &low = knots[k], &high = knots[k + 1];
    const double x = place - static_cast<double>(k), rise = high.value - low.value;
    const double bend = low.slope - rise, other = high.slope - rise;
    return sum * (low.value + x * (low.slope - x * (bend + (bend + other) * (1.0 - x))));
  }

  Knots approach_, separation_;
};

}  // namespace cmb
