#include "response/speed_ratio.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cmb {

namespace {

// From here on damping is heavy.
constexpr double largest_nearby = 8.0;
constexpr double converged = 1e-7;  // a correction, by the unknown; what is left is of the order of its square
constexpr double negligible = 3e-16;  // what is left of a logarithm, by its range

// t = ln(1 + d (dx/dt)/v0) by the square of sigma; part: 1/(1 + squared).
double logarithm_at(double squared, double part, const Damping &damping) {
  return (damping.logarithm_at_start * squared + damping.logarithm_at_separation) * part;
}

// Near the root, by its asymptotes and what it is without approach.
double sigma_nearby(double q, const Damping &damping) {
  const double rate = q > 0.0 ? damping.rate_at_start : damping.rate_at_separation;
  const double n = q > 0.0 ? rate * damping.middle : rate / damping.middle;
  const double slope = q > 0.0 ? damping.slope : damping.slope / (damping.middle * damping.middle);
  const double half = 0.5 * std::fabs(q);
  const double y = (half + std::sqrt(half * half + n * (2.0 * rate * slope - 1.0) * std::fabs(q) + n * n)) / rate;
  return q > 0.0 ? y : 1.0 / y;
}

// d r of heavy damping: the root of y - 1 = q (sqrt(q^2/4 + m + ln y) - q/2) for y = 1 + d r, m = d - ln(1 + d), by Newton's
// method from where it comes from one side; the root term hardly changes with y. Where y is so small that its logarithm
// decides, which is at the end of a contact, for the logarithm t: (1 - e^t)^2/q^2 = t - e^t + 1 + m.
double heavily_damped(double q, const Damping &damping) {
  constexpr int most_steps = 6;
  if (q > damping.speed_between) {
    const double m = damping.constant - 1.0, part = 0.25 * q * q + m;
    double root = std::sqrt(q > 0.0 ? part + damping.logarithm_at_start : part);
    double y = std::fmax(damping.power_between, 1.0 + q * (root - 0.5 * q)), result = 0.0;
    for (int i = 0; i < most_steps; ++i) {
      const double logarithm = std::log(y);
      root = std::sqrt(part + logarithm);
      result = q * (m + logarithm) / (root + 0.5 * q);
      const double rate = q / (2.0 * root * y), correction = (y - 1.0 - result) / (1.0 - rate);
      y -= correction;
      result -= rate * correction;
      if (std::fabs(correction) < converged * y) break;
    }
    return result;
  }
  const double inverse = 1.0 / (q * q);
  double t = std::fmin(std::log(damping.power_between), inverse - damping.constant), power = 0.0;
  for (int i = 0; i < most_steps; ++i) {
    power = std::exp(t);
    const double rest = 1.0 - power;
    const double correction = (rest * rest * inverse + power - damping.constant - t) / (rest * (2.0 * power * inverse + 1.0));
    t += correction;
    power *= 1.0 + correction;
    if (std::fabs(correction) < converged) break;
  }
  return power - 1.0;
}

// Where (exp(t) - 1)/sqrt(t - exp(t) + constant) is q.
struct SigmaRoot {
  double sigma, slope;  // d sigma/dq
  double logarithm, power;  // t and exp(t) beside the root
  double moved;  // t of the root less that
};

// From a sigma nearby, by Halley's method for ln sigma: what is left is of the order of the cube of a correction.
SigmaRoot find_sigma(double sigma, double q, const Damping &damping) {
  constexpr int most_steps = 4;
  const double span = damping.logarithm_at_start - damping.logarithm_at_separation;
  SigmaRoot root{};
  for (int i = 0; i < most_steps; ++i) {
    const double p = sigma * sigma, part = 1.0 / (1.0 + p);
    root.logarithm = logarithm_at(p, part, damping);
    root.power = std::exp(root.logarithm);
    const double e = root.power - 1.0;
    const double square = 1.0 / (root.logarithm - root.power + damping.constant), inverse = std::sqrt(square);
    // Derivatives of t by ln sigma, of q by t, of q by ln sigma.
    const double first = 2.0 * p * span * part * part, second = first * (2.0 - 4.0 * p * part);
    const double curve = e * e * square;
    const double q_first = inverse * (root.power + 0.5 * curve);
    const double q_second = inverse * (root.power + e * square * (1.5 * root.power + 0.75 * curve));
    const double slope = q_first * first, bend = q_second * first * first + q_first * second;
    const double residual = e * inverse - q;
    const double correction = -residual * slope / (slope * slope - 0.5 * residual * bend);
    root.moved = correction * (first + 0.5 * correction * second);
    root.slope = sigma / slope;
    sigma *= 1.0 + correction * (1.0 + 0.5 * correction);
    if (std::fabs(correction * correction * correction) * first < negligible * span) break;
  }
  root.sigma = sigma;
  return root;
}

}  // namespace

std::shared_ptr<const SigmaTable> tabulate_sigma(const Damping &damping) {
  if (damping.factor > largest_nearby) return nullptr;
  return std::make_shared<const SigmaTable>([&](double q) {
    const SigmaRoot root = find_sigma(sigma_nearby(q, damping), q, damping);
    return std::pair{root.sigma, root.slope};
  });
}

double memoryless_speed_ratio(double approach_speed, double specific_energy, const Damping &damping) {
  constexpr double largest_q = SigmaTable::largest_speed;  // beyond, the ratio is that at the start or the end of the contact
  const double q = std::clamp(approach_speed / std::sqrt(specific_energy + std::numeric_limits<double>::min()),
                              -largest_q, largest_q);
  const double d = std::fmax(damping.factor, smallest_damping);
  if (d > largest_nearby) return heavily_damped(q, damping) / d;
  const double nearby = damping.sigma != nullptr ? damping.sigma->sigma(q) : sigma_nearby(q, damping);
  const SigmaRoot root = find_sigma(nearby, q, damping);
  return (root.power * (1.0 + root.moved * (1.0 + 0.5 * root.moved)) - 1.0) / d;  // no other exp
}

}  // namespace cmb
