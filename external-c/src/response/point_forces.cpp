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

double memoryless_speed_ratio(double approach_speed, double specific_energy, const Damping &damping) {
  constexpr double smallest_damping = 1e-3;
  constexpr double largest_q = 1e4;  // beyond, the ratio is that at the start or the end of the contact
  const double d = std::fmax(damping.factor, smallest_damping);
  const double start = std::log(1.0 + d);
  const double c = 1.0 + d - start;
  const double end = damping.logarithm_at_separation;
  const double q = std::clamp(approach_speed / std::sqrt(specific_energy + std::numeric_limits<double>::min()),
                              -largest_q, largest_q);

  // Bisection for l = ln sigma, then Newton's method for sigma with t = (start sigma^2 + end)/(1 + sigma^2).
  const auto t_of = [&](double p) { return (start * p + end) / (1.0 + p); };
  double low = -10.0, high = 10.0;
  for (int i = 0; i < 10; ++i) {
    const double l = 0.5 * (low + high);
    const double t = t_of(std::exp(2.0 * l)), power = std::exp(t), e = power - 1.0;
    const bool below = e * std::fabs(e) < q * std::fabs(q) * (t - power + c);
    (below ? low : high) = l;
  }
  double sigma = std::exp(0.5 * (low + high));
  for (int i = 0; i < 3; ++i) {
    const double p = sigma * sigma;
    const double t = t_of(p), power = std::exp(t), e = power - 1.0;
    const double h = t - power + c, root = std::sqrt(h);
    const double residual = e / root - q;
    const double slope =
        2.0 * p * (start - end) / ((1.0 + p) * (1.0 + p)) * (power / root + e * e / (2.0 * h * root));
    sigma -= sigma * residual / (residual + slope);
  }
  return (std::exp(t_of(sigma * sigma)) - 1.0) / d;
}

double memoryless_force(double depth, double approach_speed, double stiffness, double exponent,
                        double spring_deceleration, const Damping &damping) {
  if (!(depth > 0.0)) return 0.0;
  const double ratio = memoryless_speed_ratio(approach_speed, depth * spring_deceleration / (exponent + 1.0), damping);
  return stiffness * depth_power(depth, exponent) * std::fmax(0.0, 1.0 + damping.factor * ratio);
}

double stribeck(double speed, double mu_static, double mu_dynamic, double limit_speed) {
  if (!(limit_speed > 0.0)) return mu_dynamic;
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
