// The part of a curved body below a plane, as a solid.
#pragma once

#include "shape/shape.hpp"

namespace cmb {

// Sums over a solid between a plane and a lower surface, and over its shadow along the plane's normal; lengths from a
// point of the plane, heights along its normal.
struct SolidBelowPlane {
  double volume = 0.0;
  Vec3 volume_moment;         // integral of the place
  double shadow = 0.0;        // area
  Vec3 shadow_moment;         // integral of the place in the plane
  double shadow_second[3][3] = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}};  // integral of r r^T, r in the plane
  double lower_height = 0.0;  // integral of the lower side's height over the shadow
};

// Of a capsule, cylinder, cone or ellipsoid at `pose`, below the plane through `origin` with the unit normal `up`; all
// zero where nothing is below. To about 1e-12 of the whole body's, by the divergence theorem: the surface below the plane
// is ruled, or round, and what is integrated over it smooth between places known in closed form.
SolidBelowPlane solid_below_plane(const Shape &shape, const Pose &pose, const Vec3 &origin, const Vec3 &up);

}  // namespace cmb
