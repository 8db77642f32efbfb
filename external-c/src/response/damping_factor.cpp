#include "response/damping_factor.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

namespace cmb {

namespace {

// Less would need unbounded damping; as in the library's NormalForce.exact, and in the published laws there.
constexpr double smallest_exact = 5e-4;
constexpr double smallest_restitution = 0.01;

// The root d of (1 + d)/(1 - d e) = exp(d (1 + e)): by Newton's method for u = -ln(1 - d e), above e = 0.98, where
// logarithms cancel, by the series of the equation.
double exact(double restitution) {
  constexpr double series_from = 0.98;
  const double e = std::clamp(restitution, smallest_exact, 1.0);
  if (e > series_from) {
    const double e2 = e * e, e3 = e2 * e, e4 = e3 * e, e5 = e4 * e, e6 = e5 * e, e7 = e6 * e;
    double d = 0.0;
    for (int i = 0; i < 8; ++i) {
      d = 3.0 / (1.0 + e3) *
          ((1.0 - e2) / 2 +
           d * d * ((1.0 - e4) / 4 - d * ((1.0 + e5) / 5 - d * ((1.0 - e6) / 6 - d * (1.0 + e7) / 7))));
    }
    return d;
  }
  double u = (1.0 - e * e) / e;
  for (int i = 0; i < 6; ++i) {
    const double y = 1.0 - std::exp(-u);
    u -= ((1.0 + e) * y / e - std::log(1.0 + y / e) - u) / ((1.0 + e) * (1.0 - y) / e - (1.0 - y) / (e + y) - 1.0);
  }
  return (1.0 - std::exp(-u)) / e;
}

}  // namespace

double damping_factor(cmb_normal_law law, double e) {
  const double bounded = std::fmax(e, smallest_restitution);
  switch (law) {
    case CMB_LAW_EXACT: return exact(e);
    case CMB_LAW_JUHASZ: return (1 - e) / bounded;
    case CMB_LAW_HUNT_CROSSLEY: return 1.5 * (1 - e);
    case CMB_LAW_HERBERT_MCWHANNELL: return 6 * (1 - e) / ((2 * e - 1) * (2 * e - 1) + 3);
    case CMB_LAW_LEE_WANG: return 0.75 * (1 - e);
    case CMB_LAW_LANKARANI_NIKRAVESH: return 0.75 * (1 - e * e);
    case CMB_LAW_GONTHIER: return (1 - e * e) / bounded;
    case CMB_LAW_FLORES: return 1.6 * (1 - e) / bounded;
    case CMB_LAW_HU_GUO: return 1.5 * (1 - e) / bounded;
    case CMB_LAW_SPRING_DAMPER: return 0.0;
  }
  return 0.0;
}

double logarithm_at_separation(double damping) {
  const double d = std::fmax(damping, smallest_damping);
  const double c = 1.0 + d - std::log(1.0 + d);
  double t = 1.0 - c - std::sqrt(2.0 * (c - 1.0));
  for (int i = 0; i < 6; ++i) t -= (t - std::exp(t) + c) / (1.0 - std::exp(t));
  return t;
}

Damping damping_of(double factor) {
  const double d = std::fmax(factor, smallest_damping);
  Damping result;
  result.factor = factor;
  result.logarithm_at_separation = logarithm_at_separation(factor);
  result.logarithm_at_start = std::log(1.0 + d);
  result.constant = 1.0 + d - result.logarithm_at_start;
  const double span = result.logarithm_at_start - result.logarithm_at_separation;
  const double squared = -result.logarithm_at_separation / result.logarithm_at_start;
  result.middle = std::sqrt(squared);
  result.slope = std::sqrt(d - result.logarithm_at_start) * (1.0 + squared) * (1.0 + squared) /
                 (2.0 * result.middle * span);
  result.rate_at_start = std::sqrt(d / span);
  result.rate_at_separation = std::sqrt((1.0 - std::exp(result.logarithm_at_separation)) / span);
  result.power_between = 0.5 / (d - result.logarithm_at_start);
  result.speed_between = -(1.0 - result.power_between) /
                         std::sqrt(result.constant + std::log(result.power_between) - result.power_between);
  return result;
}

const Damping &DampingMemory::find(cmb_normal_law law, double restitution) {
  std::uint64_t bits = 0;
  std::memcpy(&bits, &restitution, sizeof bits);
  Entry &entry = entries_[((bits * 0x9e3779b97f4a7c15u) >> 58) % entries_.size()];
  if (entry.law != law || entry.restitution != restitution) {
    entry = {law, restitution, damping_of(damping_factor(law, restitution))};
  }
  return entry.damping;
}

}  // namespace cmb
