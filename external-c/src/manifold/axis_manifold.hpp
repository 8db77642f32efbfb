// Contact along a line: of capsules, and of cylinders and cones that lie on their side, with bounded convex shapes.
#pragma once

#include <vector>

#include "backend/distance_backend.hpp"
#include "manifold/contact_set.hpp"

namespace cmb {

// Room that capsule contacts are made in; one for each thread.
struct AxisManifoldScratch {
  // A place on the axis and the contact of a sphere there.
  struct Station {
    double along = 0.0;  // m, from the axis' middle
    double depth = 0.0;  // may be negative
    Vec3 normal, position;
  };
  std::vector<Station> stations;
  BackendScratch backend;
};

// How far a shape lies along a line on an obstacle in the direction `towards` (unit, in the shape's frame): 1 for a
// capsule, always; for a cylinder or cone 1 with its side flat, fading to 0 where that is inclined by more than a
// sixth of a right angle; 0 for all others. `gradient` receives its derivative by `towards`.
double line_part(const Shape &shape, const Vec3 &towards, Vec3 &gradient);

// Appends what `shape`, of some line part, carries in a contact with `other` on a line: `deepest` is a point of the
// deepest place, `normal` the contact normal from `other` to `shape`; the points' normals are those times `sense`.
//
// Spheres at stations along the axis penetrate by depths that form a concave function of the place. A station's
// weight is the part of all inclinations under which it would be the deepest; the weights sum to 1.
void line_contact(const Shape &shape, const Pose &pose, const Shape &other, const Pose &other_pose, const Vec3 &deepest,
                  const Vec3 &normal, double sense, AxisManifoldScratch &scratch, std::vector<ContactPoint> &points);

}  // namespace cmb
