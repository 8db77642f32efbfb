// Contact of a flat disc with another one, or with the face of a box.
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

// How nearly a box faces `towards` (unit, world axes) with one of its faces: 1 where it does, fading to 0 as a disc's part
// does.
double face_part(const Shape &box, const Pose &pose, const Vec3 &towards);

// The following append what two flat pieces carry that lie in each other, as seen along the contact normal `normal` (unit,
// from the second to the first; the points' normals are that times `sense`). The mean of the depth over the outline of
// what they have in common, by the angle it turns through (the exterior angle at corners): what the corners of an
// inscribed polygon carry, in the limit of very many. An arc's points have its load, energy and first moment. They return the
// greatest depth on the outline.

double disc_on_disc(const Disc &a, const Disc &b, const Vec3 &normal, double sense, std::vector<ContactPoint> &points);
double disc_on_face(const Disc &disc, const Shape &box, const Pose &pose, const Vec3 &normal, double sense,
                    std::vector<ContactPoint> &points);

}  // namespace cmb
