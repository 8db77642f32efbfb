// What of a box is farthest along a direction: a corner, an edge or a face.
#pragma once

#include "math/vector3.hpp"

namespace cmb::convex {

struct BoxFeature {
  Vec3 middle;
  Vec3 half[2];        // half edges: the first `dimension` ones
  int dimension = 0;   // 0: a corner, 1: an edge, 2: a face
};

// Of the box of half lengths `half`, whose frame `box` maps to the common one, along `m`, given in the box's frame. What is
// nearer by less than `slack` (m) counts as equally far.
BoxFeature farthest_feature(const Vec3 &half, const Pose &box, const Vec3 &m, double slack);

// A point of both rims as they are seen along m (in the common frame), in the middle of what they have in common where that
// is an edge or a polygon (the mean of its corners); its height along m is either rim's.
Vec3 common_point(const BoxFeature &a, const BoxFeature &b, const Vec3 &m);

}  // namespace cmb::convex
