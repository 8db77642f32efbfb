// How far a place is off a side of an overlap.
#pragma once

#include "math/vector3.hpp"

namespace cmb {

// To the first order, and the side's normal there.
struct OffSide {
  double distance;
  convex::Vec3 normal;
};

}  // namespace cmb
