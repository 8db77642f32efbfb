// The speed of a contact by that of its impact, as restitution without memory finds it.
#pragma once

#include <memory>

#include "response/damping_factor.hpp"
#include "response/sigma_table.hpp"

namespace cmb {

// Where the search for the ratio of a law begins; null where damping is so heavy that another one is better. It takes as long as
// sixty ratios.
std::shared_ptr<const SigmaTable> tabulate_sigma(const Damping &damping);

// (dx/dt)/v0, between -e and 1, from the speed and the elastic energy by effective mass, K x^(n+1)/(m (n+1)), both at
// present; see NormalForce.memorylessSpeedRatio.
double memoryless_speed_ratio(double approach_speed, double specific_energy, const Damping &damping);

}  // namespace cmb
