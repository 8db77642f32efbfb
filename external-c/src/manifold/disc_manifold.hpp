// Contact of two flat discs.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "shape/shape.hpp"

namespace cmb {

// The flat end of a cylinder or cone that is the nearer to a direction.
struct Disc {
  Vec3 center, axis;  // axis unit, outward
  double radius;
  Disc(const Shape &shape, const Pose &pose, const Vec3 &towards);
};

// Appends what two discs carry that lie in each other, as seen along the contact normal `normal` (unit, from B to A; the points' normals are
// that times `sense`): the mean of the depth over the outline of what they have in common, by the angle it turns through (the exterior angle
// at corners): what the corners of an inscribed polygon carry, in the limit of very many. An arc's points have its load, energy and first
// moment. Returns the greatest depth on the outline.
double disc_on_disc(const Disc &a, const Disc &b, const Vec3 &normal, double sense, std::vector<ContactPoint> &points);

}  // namespace cmb
