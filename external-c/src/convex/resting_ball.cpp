#include "resting_ball.hpp"

#include <algorithm>

#include "anderson_mixing.hpp"
#include "curved_distance.hpp"
#include "direction_refinement.hpp"
#include "fade.hpp"
#include "minkowski_difference.hpp"

namespace cmb::convex {

namespace {

// The ball is at rest where what its places are seen from moves less than this, relative to the size.
constexpr double at_rest = 1e-11;
constexpr int most_cuts = 40, most_rounds = 60, most_divisions = 20;
// As far as a way may turn about a place that the ball rests on, and an extrapolated one at once (rad).
constexpr double nearby = 0.6, most_turn = 0.5;
// A part of the change before that tells of a slow approach; the cosine of directions that may be of one place.
constexpr double slow = 0.5, same_place = 0.995;
// How far the ball's centre moves to find places that it nearly touches, as a part of the radius.
constexpr double window = 0.05;

// The supporting plane where the surface is nearest to `centre`, B moved by which the distance is.
Cut cut_at(const SignedDistance &there, const Vec3 &centre) {
  return {-there.normal, -there.distance - dot(centre, there.normal), there.point_a, there.point_b - centre, 0.0};
}

// Of bodies, B moved by p, whose difference's surface is about equally near at the cuts, and may be as near elsewhere.
SignedDistance distance_beside(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const HeldBall &ball,
                               DistanceScratch &scratch) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + ball.centre};
  if (is_polyhedral(a.core) && is_polyhedral(b.core)) return signed_distance(a, b, moved, scratch);
  EquallyNear known;
  for (; known.count < ball.count; ++known.count) known.direction[known.count] = ball.cuts[known.count].direction;
  return swept_distance(curved_distance(a, b, moved, -ball.cuts[0].direction, scratch, &known), a.radius, b.radius);
}

// Moves a cut to where the surface is the nearest to `from`.
void move_cut(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &from, Cut &cut) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + from};
  const MinkowskiDifference difference(a, b, moved);
  const RefinedDirection r =
      refine_direction(difference, cut.direction, cut.a - a.radius * cut.direction, cut.b + from + b.radius * cut.direction);
  if (!(dot(r.direction, cut.direction) > 1.0 - 0.5 * nearby * nearby)) return;  // another place, as near
  cut.direction = r.direction;
  cut.height = r.height + a.radius + b.radius + dot(from, r.direction);
  cut.a = r.a + a.radius * r.direction;
  cut.b = r.b - b.radius * r.direction - from;
}

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

// Moves a ball that rests on three places to where it is `away` (m) from each, or as far in them where that is negative:
// where a larger or smaller ball touches them. False where it does not come there within twice the way that the planes
// tell, `step` (m).
bool move_away(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, double away, double step,
               HeldBall &ball) {
  const Vec3 from = ball.centre;
  const double radius = ball.radius + away;
  for (int round = 0; round < most_rounds; ++round) {
    const Vec3 last = ball.centre;
    const Cut *cuts = ball.cuts;
    if (!ball.meeting_place(cuts[0].height - radius, cuts[1].height - radius, cuts[2].height - radius, ball.centre)) {
      return false;
    }
    if (!(norm2(ball.centre - from) < 4.0 * step * step)) return false;
    if (norm2(ball.centre - last) <= at_rest * at_rest * size * size) break;
    for (Cut *cut = ball.cuts; cut != ball.cuts + 3; ++cut) {
      move_cut(a, b, b_in_a, ball.centre + cut->pull * cut->direction, *cut);
    }
  }
  return true;
}

// The place nearest to a ball that has been moved away from its three places, if it is nearer than these. `part`
// receives how near it is to the ball at rest: 1 where that touches it, 0 where it is just as near as those to the other.
bool find_near_place(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const HeldBall &ball,
                     double away, double step, DistanceScratch &scratch, Cut &place, double &part) {
  HeldBall other = ball;
  if (!move_away(a, b, b_in_a, size, away, step, other)) return false;
  const SignedDistance there = distance_beside(a, b, b_in_a, other, scratch);
  const double nearer = ball.radius + away + there.distance;
  if (!(nearer > ball.slack)) return false;
  place = cut_at(there, other.centre);
  move_cut(a, b, b_in_a, ball.centre, place);
  const double gap = std::max(0.0, place.height - dot(place.direction, ball.centre) - ball.radius);
  part = faded(gap / (gap + nearer));
  return part > 0.0;
}

// Sets the pulls to those of springs of the stiffnesses `part` at the places, which hold a body that is loaded by `load`: it
// moves by some v, and a place pulls by part * (direction . v) where that is positive. Newton's method, from pulls of the first
// three that bear the load.
void divide_pulls(const Vec3 &load, const double *part, Cut *places, int count) {
  const auto solve = [](const Vec3 column[3], const Vec3 &right, Vec3 &v) {
    const Vec3 yz = cross(column[1], column[2]);
    const double determinant = dot(column[0], yz);
    if (!(determinant > 0.0)) return false;
    v = (1.0 / determinant) *
        Vec3{dot(right, yz), dot(column[0], cross(right, column[2])), dot(column[0], cross(column[1], right))};
    return true;
  };
  Vec3 v;
  bool pulling[most_places];
  for (int k = 0; k < count; ++k) pulling[k] = k < 3;
  for (int step = 0; step < most_divisions; ++step) {
    Vec3 column[3];
    for (int k = 0; k < count; ++k) {
      if (!pulling[k]) continue;
      const Vec3 &d = places[k].direction;
      column[0] = column[0] + (part[k] * d.x) * d, column[1] = column[1] + (part[k] * d.y) * d;
      column[2] = column[2] + (part[k] * d.z) * d;
    }
    if (!solve(column, load, v)) return;
    bool same = true;
    for (int k = 0; k < count; ++k) {
      const bool pulls = dot(places[k].direction, v) > 0.0;
      same = same && pulls == pulling[k];
      pulling[k] = pulls;
    }
    if (!same) continue;
    for (int k = 0; k < count; ++k) places[k].pull = pulling[k] ? part[k] * dot(places[k].direction, v) : 0.0;
    return;
  }
}

}  // namespace

bool bring_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, HeldBall &ball,
                   DistanceScratch &scratch) {
  bool at_rest_there = true, hasten = false;
  for (int step = 0; step < most_cuts; ++step) {
    if (step > 0 && !hasten) at_rest_there = move_to_rest(a, b, b_in_a, size, ball);
    if (hasten && !hasten_to_rest(a, b, b_in_a, size, ball)) return false;
    const SignedDistance there = distance_beside(a, b, b_in_a, ball, scratch);
    if (-there.distance >= ball.radius - ball.slack) {
      if (at_rest_there || hasten) break;
      hasten = true;
      continue;
    }
    for (int k = 0; k < ball.count; ++k) hasten = hasten || -dot(there.normal, ball.cuts[k].direction) > same_place;
    ball.cuts[ball.count++] = cut_at(there, ball.centre);
    if (!ball.settle()) return false;
  }
  return true;
}

int share_pulls(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const HeldBall &ball,
                DistanceScratch &scratch, Cut places[most_places]) {
  std::copy_n(ball.cuts, ball.count, places);
  if (ball.count != 3) return ball.count;
  double least = INFINITY, sum = 0.0;
  for (int k = 0; k < 3; ++k) least = std::min(least, places[k].pull), sum += places[k].pull;
  const double step = window * ball.radius * (3.0 * least / sum);
  Vec3 way;  // of the centre, for each metre that the ball grows
  if (!ball.meeting_place(-1.0, -1.0, -1.0, way)) return ball.count;
  const double change = step / norm(way);
  int count = 3;
  double part[most_places] = {1.0, 1.0, 1.0};
  for (const double away : {change, -change}) {
    if (find_near_place(a, b, b_in_a, size, ball, away, step, scratch, places[count], part[count])) ++count;
  }
  if (count == 3) return count;
  divide_pulls(-ball.centre, part, places, count);
  return static_cast<int>(std::remove_if(places, places + count, [](const Cut &cut) { return !(cut.pull > 0.0); }) - places);
}

}  // namespace cmb::convex
