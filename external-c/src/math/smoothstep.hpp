// How a share fades.
#pragma once

namespace cmb::convex {

// From 1 at x = 0 to 0 at x >= 1, level at both (x >= 0).
inline double falling_smoothstep(double x) { return x < 1.0 ? 1.0 - x * x * (3.0 - 2.0 * x) : 0.0; }

// Its derivative.
inline double falling_smoothstep_slope(double x) { return x < 1.0 ? -6.0 * x * (1.0 - x) : 0.0; }

}  // namespace cmb::convex
