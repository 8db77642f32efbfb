#include "closed_work.hpp"

#include <cmath>
#include <vector>

namespace cmb::quality {

namespace {

constexpr int most_halvings = 14;

// By Gauss' rule of three places.
class StepSum {
 public:
  explicit StepSum(const std::function<PathPlace(double)> &at) : at_(at) {}

  double over(double begin, double end) const {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin), aside = std::sqrt(0.6) * half;
    return half * (8.0 * at_(middle).power + 5.0 * (at_(middle - aside).power + at_(middle + aside).power)) / 9.0;
  }
  // Until halves change it by `enough` at most.
  double refined(double begin, double end, double whole, double enough, int halvings) const {
    const double middle = 0.5 * (begin + end), first = over(begin, middle), second = over(middle, end);
    if (halvings == 0 || std::fabs(first + second - whole) <= enough) return first + second;
    return refined(begin, middle, first, 0.5 * enough, halvings - 1) + refined(middle, end, second, 0.5 * enough, halvings - 1);
  }

 private:
  const std::function<PathPlace(double)> &at_;
};

}  // namespace

ClosedWork closed_work(const std::function<PathPlace(double)> &at, int steps) {
  constexpr double smooth = 2e-7, enough = 2e-8;  // of the energy
  const double width = 1.0 / steps;
  std::vector<double> power;
  ClosedWork result;
  for (int k = 0; k < steps; ++k) {
    const PathPlace place = at((k + 0.5) * width);
    power.push_back(place.power);
    result.largest_energy = std::fmax(result.largest_energy, place.energy);
  }
  const auto around = [&](int k) { return power[static_cast<std::size_t>((k + steps) % steps)]; };
  const StepSum sum(at);
  for (int k = 0; k < steps; ++k) {
    const double second = around(k - 1) - 2.0 * around(k) + around(k + 1);
    const double fourth = around(k - 2) + around(k + 2) - 4.0 * (around(k - 1) + around(k + 1)) + 6.0 * around(k);
    if (std::fabs(fourth) * width > smooth * result.largest_energy) {
      const double begin = k * width, end = (k + 1) * width;
      result.work += sum.refined(begin, end, sum.over(begin, end), enough * result.largest_energy, most_halvings);
    } else {
      // Euler's and Maclaurin's terms, which sum to nothing around a path of such steps alone.
      result.work += width * (around(k) + second / 24.0 - 17.0 * fourth / 5760.0);
    }
  }
  return result;
}

}  // namespace cmb::quality
