#include "response/point_forces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmb {

double depth_power(double depth, double exponent) {
  if (exponent == 1.0) return depth;
  if (exponent == 1.5) return depth * std::sqrt(depth);
  return std::pow(depth, exponent);
}

double damped_force(double depth, double approach_speed, double stiffness, double exponent, double rate) {
  if (!(depth > 0.0)) return 0.0;
  return stiffness * depth_power(depth, exponent) * std::fmax(0.0, 1.0 + rate * approach_speed);
}

double spring_damper_force(double depth, double approach_speed, double stiffness, double exponent, double damping,
                           double damping_depth) {
  if (!(depth > 0.0)) return 0.0;
  const double s = std::fmin(depth / damping_depth, 1.0);
  return std::fmax(0.0, stiffness * depth_power(depth, exponent) + s * s * (3.0 - 2.0 * s) * damping * approach_speed);
}

namespace {

// From here on damping is heavy.
constexpr double largest_nearby = 8.0;
constexpr double converged = 1e-7;  // a correction, by the unknown; what is left is of the order of its square

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

}  // namespace

double memoryless_speed_ratio(double approach_speed, double specific_energy, const Damping &damping) {
  constexpr double largest_q = 1e4;  // beyond, the ratio is that at the start or the end of the contact
  const double d = std::fmax(damping.factor, smallest_damping);
  const double span = damping.logarithm_at_start - damping.logarithm_at_separation;
  const double q = std::clamp(approach_speed / std::sqrt(specific_energy + std::numeric_limits<double>::min()),
                              -largest_q, largest_q);

  if (d > largest_nearby) return heavily_damped(q, damping) / d;
  double sigma = sigma_nearby(q, damping);
  double t = 0.0, power = 1.0;
  for (int i = 0; i < 4; ++i) {
    const double p = sigma * sigma, part = 1.0 / (1.0 + p);
    t = logarithm_at(p, part, damping);
    power = std::exp(t);
    const double e = power - 1.0;
    const double inverse = 1.0 / std::sqrt(t - power + damping.constant);
    const double residual = e * inverse - q;
    const double slope = 2.0 * p * span * part * part * inverse * (power + 0.5 * e * e * inverse * inverse);
    const double correction = residual / (residual + slope);
    sigma -= sigma * correction;
    if (std::fabs(correction) < converged) break;
  }
  const double squared = sigma * sigma;
  const double moved = logarithm_at(squared, 1.0 / (1.0 + squared), damping) - t;  // by the last correction: no other exp
  return (power * (1.0 + moved * (1.0 + 0.5 * moved)) - 1.0) / d;
}

double memoryless_force(double depth, double approach_speed, double stiffness, double exponent,
                        double spring_deceleration, const Damping &damping) {
  if (!(depth > 0.0)) return 0.0;
  const double ratio = memoryless_speed_ratio(approach_speed, depth * spring_deceleration / (exponent + 1.0), damping);
  return stiffness * depth_power(depth, exponent) * std::fmax(0.0, 1.0 + damping.factor * ratio);
}

double stribeck(double speed, double mu_static, double mu_dynamic, double limit_speed) {
  if (!(limit_speed > 0.0) || mu_static == mu_dynamic) return mu_dynamic;
  const double scaled = speed / limit_speed;
  return mu_dynamic + (mu_static - mu_dynamic) * std::exp(-scaled * scaled);
}

Vec3 friction_force(double normal_force, const Vec3 &sliding, double mu, double regularisation_speed) {
  return (-mu * normal_force / std::sqrt(norm2(sliding) + regularisation_speed * regularisation_speed)) * sliding;
}

Vec3 spin_torque(double normal_force, const Vec3 &normal, const Vec3 &w, double mu, double radius,
                 double regularisation_speed) {
  const double spin = dot(w, normal);
  return (-2.0 / 3.0 * mu * radius * normal_force * spin /
          std::sqrt(spin * spin + regularisation_speed * regularisation_speed)) *
         normal;
}

Vec3 rolling_torque(double normal_force, const Vec3 &normal, const Vec3 &w, double lever,
                    double regularisation_speed) {
  const Vec3 rolling = w - dot(w, normal) * normal;
  return (-lever * normal_force / std::sqrt(norm2(rolling) + regularisation_speed * regularisation_speed)) * rolling;
}

}  // namespace cmb
