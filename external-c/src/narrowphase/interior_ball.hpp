// How large a ball lies in the difference C = A - B where its surface is the nearest to the origin.
//
// Of the cores, which spheres sweep to larger balls. Let m be C's outward normal at c = a - b, with a the farthest point of A along m
// and b of B against it. A ball in C that touches its surface at c is proven by what the bodies are known to be about a and b,
// without any search. If its radius is at least the depth, c is the nearest place of all of C's surface: a ball about the origin
// lies in every larger one that it touches from within.
//
// In another direction n, C reaches beyond c by h(n) - n . c, the sum of both bodies' excess: radius (1 - n . m) of a ball in one of
// them, w |n . e| along a line, w (n . e)^2 / 2 along an arc of their edges. In a face, side or end that holds a ball this is enough
// at once; else the radius follows from the sum as a quadratic form in the plane at c, and from how far C goes down from c.
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
