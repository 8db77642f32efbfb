#include "narrowphase/multicontact/resting_ball.hpp"

#include <algorithm>

#include "math/anderson_mixing.hpp"
#include "narrowphase/multicontact/difference_cuts.hpp"

namespace cmb::convex {

namespace {

// The ball is at rest where what its places are seen from moves less than this, relative to the size.
constexpr double at_rest = 1e-11;
constexpr int most_cuts = 40, most_rounds = 60;
// As far as an extrapolated way may turn at once (rad).
constexpr double most_turn = 0.5;
// A part of the change before that tells of a slow approach; the cosine of directions that may be of one place.
constexpr double slow = 0.5, same_place = 0.995;

// What the cuts' places are seen from: the centre as it would be without the cut's own pull. As the nearest to that the
// place is well defined however nearly the surface there is as curved as the ball, from whose centre a whole arc is as near.
void find_views(const HeldBall &ball, Vec3 *views) {
  for (int k = 0; k < ball.count; ++k) views[k] = ball.centre + ball.cuts[k].pull * ball.cuts[k].direction;
}

// The planes of the cuts where the ball rests on a curved surface are not yet those at its places: one round moves them there,
// and the centre with them. `next` receives the views from then on. False where there is no centre.
bool move_cuts(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, HeldBall &ball, const Vec3 *views, Vec3 *next) {
  for (int k = 0; k < ball.count; ++k) move_cut(a, b, b_in_a, views[k], ball.cuts[k]);
  if (!ball.settle()) return false;
  find_views(ball, next);
  return true;
}

// The square of the farthest way between views.
double farthest2(const Vec3 *views, const Vec3 *next, int count) {
  double result = 0.0;
  for (int k = 0; k < count; ++k) result = std::max(result, norm2(next[k] - views[k]));
  return result;
}

// Rounds until planes and centre agree. Where they approach each other slowly, false, and the ball as it was: on a surface that
// is as curved as the ball, as all about a cone's axis, which places hold the ball is not for these few to say.
bool move_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, HeldBall &ball) {
  const HeldBall before = ball;
  Vec3 views[HeldBall::most], next[HeldBall::most];
  find_views(ball, views);
  double last = INFINITY;
  for (int round = 0; round < most_rounds; ++round) {
    const int count = ball.count;
    if (!move_cuts(a, b, b_in_a, ball, views, next)) break;
    const double change = farthest2(views, next, count);
    std::copy_n(next, count, views);
    if (ball.count != count) {
      last = INFINITY;
      continue;
    }
    if (change <= at_rest * at_rest * size * size) return true;
    if (change > slow * slow * last) break;
    last = change;
  }
  ball = before;
  return false;
}

// The same, extrapolated. False where there is no centre.
bool hasten_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, HeldBall &ball) {
  AndersonMixing<HeldBall::most> mixing;
  Vec3 views[HeldBall::most], next[HeldBall::most];
  find_views(ball, views);
  HeldBall before;
  bool mixed = false;
  for (int round = 0; round < most_rounds; ++round) {
    const int count = ball.count;
    const bool settled = move_cuts(a, b, b_in_a, ball, views, next);
    const bool too_far = mixed && !(settled && ball.count == count);
    if (too_far) {
      ball = before;
      find_views(ball, next);
    } else if (!settled) {
      return false;
    }
    if (too_far || ball.count != count) {
      mixing.restart();
      mixed = false;
      std::copy_n(next, ball.count, views);
      continue;
    }
    if (farthest2(views, next, count) <= at_rest * at_rest * size * size) return true;
    before = ball;
    mixing.mix(views, next, count);
    mixed = true;
    double part = 1.0;
    for (int k = 0; k < count; ++k) {
      const double step = norm(views[k] - next[k]), most_step = most_turn * ball.cuts[k].pull;
      if (step > part * most_step) part = std::min(part, most_step / step);
    }
    for (int k = 0; part < 1.0 && k < count; ++k) views[k] = next[k] + part * (views[k] - next[k]);
  }
  return true;
}

}  // namespace

bool bring_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, HeldBall &ball,
                   DistanceScratch &scratch) {
  const auto lacks_nothing = [](const SignedDistance &there, const HeldBall &held) {
    return -there.distance >= held.radius - held.slack;
  };
  bool at_rest_there = true, hasten = false;
  for (int step = 0; step < most_cuts; ++step) {
    if (step > 0 && !hasten) at_rest_there = move_to_rest(a, b, b_in_a, size, ball);
    if (hasten && !hasten_to_rest(a, b, b_in_a, size, ball)) return false;
    const SignedDistance there = distance_beside(a, b, b_in_a, ball, scratch);
    if (lacks_nothing(there, ball)) {
      if (at_rest_there || hasten) break;
      hasten = true;
      continue;
    }
    const Cut added = cut_at(there, ball.centre);
    for (int k = 0; k < ball.count; ++k) {
      if (!(dot(added.direction, ball.cuts[k].direction) > same_place)) continue;
      hasten = true;
      // Where the surface is nearly as curved as the ball, the place that holds it may have moved as far.
      HeldBall moved = ball;
      moved.cuts[k] = added;
      if (!moved.settle() || !hasten_to_rest(a, b, b_in_a, size, moved)) continue;
      if (!lacks_nothing(distance_beside(a, b, b_in_a, moved, scratch), moved)) continue;
      ball = moved;
      return true;
    }
    ball.cuts[ball.count++] = added;
    if (!ball.settle()) return false;
  }
  return true;
}

}  // namespace cmb::convex
