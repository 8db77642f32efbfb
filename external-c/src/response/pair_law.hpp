// What the law of a scene and the properties of two bodies make of their pair.
#pragma once

#include <cstddef>
#include <stdexcept>
#include <string>

#include "contact_multibody_scene.h"
#include "response/damping_factor.hpp"

namespace cmb {

// Arguments from which no forces follow.
class ResponseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct PairLaw {
  double stiffness = 0.0;
  Damping damping;  // where restitution is used
  double mu_static = 0.0, mu_dynamic = 0.0;
};

// Value of a pair from values of two materials, none negative.
double combine(double a, double b, cmb_combination_rule rule);

// Whether forces depend on the bodies' masses.
inline bool needs_masses(const cmb_contact_law &law) {
  return law.use_restitution != 0 && law.normal_law != CMB_LAW_SPRING_DAMPER;
}

// Bodies are 0-based. Throws ResponseError where the stiffness is not finite.
PairLaw pair_law(const cmb_contact_law &law, const cmb_body_properties &properties, std::size_t a, std::size_t b,
                 DampingMemory &memory);

// Throw ResponseError where something is missing or out of its range: of the law and the arrays, of one body.
void check_law(const cmb_contact_law &law, const cmb_body_properties &properties);
void check_body(const cmb_contact_law &law, const cmb_body_properties &properties, std::size_t body, bool fixed);

}  // namespace cmb
