// Springs that hold a load by pressing alone.
#pragma once

#include "math/vector3.hpp"

namespace cmb::convex {

// Springs along the unit `directions` with the `stiffness` (> 0) each, `count` of them, hold a body that is loaded by the unit
// vector `load`: it moves by some v, and a spring presses by stiffness * (direction . v) where that is positive. `force`
// receives by how much; the sum of force * direction is the load where directions can bear it. The stiffnesses may differ
// by many decades where a stiff spring's direction is nearly the load's. False, and nothing changed, where no end is found.
bool solve_unilateral_springs(const Vec3 &load, const Vec3 *directions, const double *stiffness, int count, double *force);

}  // namespace cmb::convex
