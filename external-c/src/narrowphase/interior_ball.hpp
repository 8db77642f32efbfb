// How large a ball lies in the difference C = A - B where its surface is the nearest to the origin.
//
// Of the cores, which spheres sweep to larger balls. Let m be C's outward normal at c = a - b, with a the farthest point of A along m and b of B against it. A ball in C that
// touches its surface at c is proven by what the bodies are known to be about a and b, without any search: a ball in one
// of them, a line or an arc of their edges. If its radius is at least the depth, c is the nearest place of all of C's
// surface: a ball about the origin lies in every larger one that it touches from within.
#pragma once

#include "shape/convex_body.hpp"

namespace cmb::convex {

// The radius of such a ball, or, once one of `enough` is found, at least that; 0 where none is known. `outward` (unit) is m,
// in A's frame as `a` and `b`, points of the bodies' cores, are. Points that are outside of the cores by more than
// `slack` prove nothing, and the ball is right to about `slack` (m).
double interior_ball_radius(const ConvexBody &body_a, const ConvexBody &body_b, const Pose &b_in_a, const Vec3 &outward,
                            const Vec3 &a,
                            const Vec3 &b, double enough, double slack);

}  // namespace cmb::convex
