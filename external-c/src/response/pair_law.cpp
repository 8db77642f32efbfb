#include "response/pair_law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace cmb {

namespace {

// Stiffness of a pair of springs F = k x^n in series.
double in_series(double a, double b, double exponent) {
  if (exponent == 1.0) return 1.0 / (1.0 / a + 1.0 / b);
  return std::pow(std::pow(a, -1.0 / exponent) + std::pow(b, -1.0 / exponent), -exponent);
}

double pair_stiffness(const cmb_contact_law &law, const cmb_body_properties &properties, std::size_t a, std::size_t b) {
  if (properties.stiffness != nullptr) return in_series(properties.stiffness[a], properties.stiffness[b], law.exponent);
  constexpr double flat = 1e-9;  // 1/m
  const double curvature = properties.curvature[a] + properties.curvature[b];
  if (!(curvature > flat)) return HUGE_VAL;
  const double compliance = 1.0 / properties.modulus[a] + 1.0 / properties.modulus[b];
  return 4.0 / 3.0 / (std::sqrt(curvature) * compliance);
}

void require(bool holds, const char *what) {
  if (!holds) throw ResponseError(what);
}

void require_of_body(bool holds, std::size_t body, const char *what) {
  if (!holds) throw ResponseError("body " + std::to_string(body + 1) + ": " + what);
}

bool not_negative(double value) { return value >= 0.0 && std::isfinite(value); }

// Symmetric up to what rounding leaves.
bool positive_definite(const double *m) {
  const double slight = 1e-9 * (m[0] + m[4] + m[8]);
  for (const auto &[above, below] : {std::pair{1, 3}, {2, 6}, {5, 7}}) {
    if (!(std::fabs(m[above] - m[below]) <= slight)) return false;
  }
  const double minor = m[0] * m[4] - m[3] * m[3];
  const double determinant = m[0] * (m[4] * m[8] - m[7] * m[7]) - m[3] * (m[3] * m[8] - m[7] * m[6]) +
                             m[6] * (m[3] * m[7] - m[4] * m[6]);
  return m[0] > 0.0 && minor > 0.0 && determinant > 0.0 && std::isfinite(determinant);
}

}  // namespace

double combine(double a, double b, cmb_combination_rule rule) {
  switch (rule) {
    case CMB_COMBINE_MINIMUM: return std::fmin(a, b);
    case CMB_COMBINE_MAXIMUM: return std::fmax(a, b);
    case CMB_COMBINE_ARITHMETIC_MEAN: return (a + b) / 2;
    case CMB_COMBINE_GEOMETRIC_MEAN: return std::sqrt(a * b);
    case CMB_COMBINE_HARMONIC_MEAN: return 2 * a * b / std::fmax(a + b, std::numeric_limits<double>::min());
    case CMB_COMBINE_PRODUCT: return a * b;
  }
  return 0.0;
}

PairLaw pair_law(const cmb_contact_law &law, const cmb_body_properties &properties, std::size_t a, std::size_t b,
                 DampingMemory &memory) {
  PairLaw pair;
  pair.stiffness = pair_stiffness(law, properties, a, b);
  if (!std::isfinite(pair.stiffness)) {
    throw ResponseError("bodies " + std::to_string(a + 1) + " and " + std::to_string(b + 1) +
                        " touch and have no finite stiffness; give one of them a finite stiffness or radius of contact");
  }
  if (needs_masses(law)) {
    pair.damping = memory.find(
        law.normal_law, combine(properties.restitution[a], properties.restitution[b], law.restitution_rule));
  }
  if (law.use_friction != 0) {
    pair.mu_dynamic = combine(properties.mu_dynamic[a], properties.mu_dynamic[b], law.friction_rule);
    pair.mu_static = law.stribeck_speed > 0.0
                         ? combine(properties.mu_static[a], properties.mu_static[b], law.friction_rule)
                         : pair.mu_dynamic;
  }
  return pair;
}

void check_law(const cmb_contact_law &law, const cmb_body_properties &properties) {
  require(law.normal_law >= CMB_LAW_EXACT && law.normal_law <= CMB_LAW_SPRING_DAMPER,
          "normal_law is unknown; use one of cmb_normal_law");
  require(law.exponent >= 1.0 && std::isfinite(law.exponent), "exponent is below 1 or not finite");
  require(not_negative(law.steady_rate), "steady_rate is negative or not finite");
  require(not_negative(law.damping), "damping is negative or not finite");
  require(law.damping_depth > 0.0, "damping_depth is not greater than 0");
  for (const cmb_combination_rule rule : {law.restitution_rule, law.friction_rule}) {
    require(rule >= CMB_COMBINE_MINIMUM && rule <= CMB_COMBINE_PRODUCT,
            "a combination rule is unknown; use one of cmb_combination_rule");
  }
  require(law.regularisation_speed > 0.0, "regularisation_speed is not greater than 0");
  require(not_negative(law.stribeck_speed), "stribeck_speed is negative or not finite");
  require(not_negative(law.spin_radius), "spin_radius is negative or not finite");
  require(not_negative(law.rolling_lever), "rolling_lever is negative or not finite");
  require(law.turning_regularisation_speed > 0.0, "turning_regularisation_speed is not greater than 0");

  require(properties.stiffness != nullptr || (properties.modulus != nullptr && properties.curvature != nullptr),
          "neither stiffness nor modulus and curvature are given");
  require(properties.stiffness != nullptr || law.exponent == 1.5,
          "Hertz's stiffness goes with exponent 1.5 only");
  if (needs_masses(law)) {
    require(properties.mass != nullptr && properties.center_of_mass != nullptr && properties.inertia != nullptr,
            "mass, center_of_mass or inertia is NULL; restitution needs them");
    require(properties.restitution != nullptr, "restitution is NULL");
  }
  if (law.use_friction != 0) {
    require(properties.mu_dynamic != nullptr, "mu_dynamic is NULL");
    require(properties.mu_static != nullptr || law.stribeck_speed == 0.0, "mu_static is NULL; Stribeck needs it");
  }
}

void check_body(const cmb_contact_law &law, const cmb_body_properties &properties, std::size_t body, bool fixed) {
  if (properties.stiffness != nullptr) {
    require_of_body(properties.stiffness[body] > 0.0, body, "the stiffness is not greater than 0");
  } else {
    require_of_body(properties.modulus[body] > 0.0, body, "the modulus is not greater than 0");
    require_of_body(not_negative(properties.curvature[body]), body, "the curvature is negative or not finite");
  }
  if (needs_masses(law)) {
    require_of_body(properties.restitution[body] >= 0.0 && properties.restitution[body] <= 1.0, body,
                    "the restitution is not between 0 and 1");
    if (!fixed) {
      require_of_body(properties.mass[body] > 0.0 && std::isfinite(properties.mass[body]), body,
                      "the mass is not greater than 0 and finite; say that the body is fixed if it never moves");
      const double *inertia = properties.inertia + 9 * body;
      require_of_body(std::all_of(inertia, inertia + 9, [](double value) { return value == 0.0; }) ||
                          positive_definite(inertia),
                      body, "the inertia is neither 0 nor symmetric and positive definite; give the whole tensor");
      const double *center = properties.center_of_mass + 3 * body;
      require_of_body(std::isfinite(center[0]) && std::isfinite(center[1]) && std::isfinite(center[2]), body,
                      "the centre of mass is not finite; give it in the body's frame");
    }
  }
  if (law.use_friction != 0) {
    require_of_body(not_negative(properties.mu_dynamic[body]), body, "mu_dynamic is negative or not finite");
    if (law.stribeck_speed > 0.0) {
      require_of_body(not_negative(properties.mu_static[body]), body, "mu_static is negative or not finite");
    }
  }
}

}  // namespace cmb
