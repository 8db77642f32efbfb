// Newton's method for the direction in which the Minkowski difference's support function is least.
//
// The support function is smooth but for circles on the sphere of directions (a box's edges, a cylinder's side, a cone's side)
// and single points (a flat end).
#pragma once

#include "narrowphase/minkowski_difference.hpp"

namespace cmb::convex {

// A circle m . axis = height of directions m across which a body's farthest point jumps: for m on it all of a line
// segment along `line` is farthest.
struct Crease {
  Vec3 axis;
  double height;
  Vec3 line;
};

// As B's crease looks in A's frame, for directions from A to B; `rotation` maps B's frame to A's.
inline Crease crease_of_other(const Crease &c, const Mat3 &rotation) {
  return {rotation * c.axis, -c.height, rotation * c.line};
}

// Each of the following moves the unit vector m to a minimum nearby; false, and m of no meaning, where it ends elsewhere.

// Among directions where the support function is smooth; with shortened steps while far from the minimum. Where it is false
// m is as low as before or lower all the same. A step that does not lead lower is halved `most_halvings` times.
bool newton_on_sphere(const MinkowskiDifference &difference, Vec3 &m, int most_halvings = 12);

// Along a crease, from a point m on it: by steps that are not shortened, or, `from_afar`, down the slope until Newton's method
// holds.
bool newton_on_crease(const MinkowskiDifference &difference, const Crease &crease, Vec3 &m, bool from_afar = false);

// Moves m to the crease's nearest point; false where all are equally near.
bool project_on_crease(const Crease &crease, Vec3 &m);

// Where two creases meet, on the side of m.
bool meeting_point(const Crease &p, const Crease &q, Vec3 &m);

}  // namespace cmb::convex
