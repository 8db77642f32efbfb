// A ball inside the difference C = A - B whose centre is the nearest to the origin, and the places that it rests on.
#pragma once

#include "convex_distance.hpp"
#include "held_ball.hpp"

namespace cmb::convex {

// Brings a ball that has been settled to rest: no place of C's surface is nearer to its centre than the radius, to the slack,
// and the cuts are where it touches. False where no such ball fits. Bodies of `size` (m).
bool bring_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, HeldBall &ball,
                   DistanceScratch &scratch);

// The pulls on a ball at rest, divided among the places that it touches, three, and up to two that it nearly does.
//
// Of four places that hold a ball at once any three may do without the fourth, and which of them are left once it has
// moved on depends on where to: pulls by three places alone jump. Those here are what springs at the places would take.
// A place has one that the ball does not touch, but would if it grew or shrank a little on the three (its centre moves by a
// twentieth of the radius, less where one of the three is about to leave); the farther it is the softer its spring, so that
// the pulls are continuous.
constexpr int most_places = 5;
// Returns how many `places` receive.
int share_pulls(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const HeldBall &ball,
                DistanceScratch &scratch, Cut places[most_places]);

}  // namespace cmb::convex
