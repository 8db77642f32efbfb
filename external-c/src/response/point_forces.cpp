#include "response/point_forces.hpp"

#include <cmath>

#include "response/speed_ratio.hpp"

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
