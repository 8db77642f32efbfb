// Damping factors of the laws of the normal force, as ContactMultiBody.NormalForce computes them.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "contact_multibody_scene.h"

namespace cmb {

// d(e) of a law; 0 for CMB_LAW_SPRING_DAMPER. restitution: 0 ... 1.
double damping_factor(cmb_normal_law law, double restitution);

// Damping factors below count as this one in the law of restitution without memory, whose root they would make singular.
constexpr double smallest_damping = 1e-3;

// ln(1 - d e) where the free impact with damping factor d >= 0 ends: the negative root of t - exp(t) + 1 + d - ln(1 + d).
double logarithm_at_separation(double damping);

class SigmaTable;

// What the law of one pair needs to know of its restitution; see NormalForce.Internal.sigmaNearby and heavilyDamped.
struct Damping {
  double factor = 0.0;                   // d
  double logarithm_at_separation = 0.0;  // ln(1 - d e)
  double logarithm_at_start = 0.0;       // ln(1 + d)
  double constant = 0.0;                 // 1 + d - ln(1 + d)
  double middle = 0.0;                   // sigma without approach
  double slope = 0.0;                    // d sigma/dq there
  double rate_at_start = 0.0;            // of q by sigma
  double rate_at_separation = 0.0;       // of -q by 1/sigma
  double power_between = 0.0;            // 1 + d r below which its logarithm is sought where damping is heavy
  double speed_between = 0.0;            // q there
  std::shared_ptr<const SigmaTable> sigma;  // null: not tabulated; changes no more than rounding does
};

// All of it from d >= 0. It depends on d alone, so that it is kept: see DampingMemory.
Damping damping_of(double factor);

// Remembers a few values: materials are few, pairs are many. What it returns does not depend on what it remembers.
class DampingMemory {
 public:
  const Damping &find(cmb_normal_law law, double restitution);

 private:
  struct Entry {
    int law = 0;  // of no law
    double restitution = 0.0;
    Damping damping;
  };
  std::array<Entry, 64> entries_;
};

}  // namespace cmb
