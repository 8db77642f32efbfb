// Bounds of whole bodies.
#pragma once

#include <cmath>

#include "shape/shape.hpp"

namespace cmb {

// A sphere and a box about one centre in a body's frame, each of which holds all its shapes; the sphere holds their bounding
// spheres, too. Immutable.
struct BodyBounds {
  LocalBounds box;
  Vec3 center;
  double radius = HUGE_VAL;  // infinite where a half-space is among the shapes, or there is none

  bool bounded() const { return std::isfinite(radius); }
};

BodyBounds bounds_of(const BodyShapes &shapes);

}  // namespace cmb
