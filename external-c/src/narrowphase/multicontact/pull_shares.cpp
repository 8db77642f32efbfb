#include "narrowphase/multicontact/pull_shares.hpp"

#include <algorithm>

#include "math/fade.hpp"
#include "narrowphase/multicontact/difference_cuts.hpp"
#include "narrowphase/multicontact/unilateral_springs.hpp"

namespace cmb::convex {

namespace {

// How far the ball's centre moves to find places that it nearly touches, and faces are from it, as a part of the radius.
constexpr double window = 0.05;
// The ball is at rest where it moves less than this, relative to the size.
constexpr double at_rest = 1e-11;
constexpr int most_rounds = 60;
// The part of the pull below which a place that is no face goes over to the faces nearby.
constexpr double leaving = 0.02;
// Where directions differ by less a place passes into a face (rad).
constexpr double like_direction = 0.1;
// The square of an angle (rad) at which a place alone takes all, to rounding.
constexpr double opposite = 1e-13;

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

// The springs at the places that share the pull.
class Springs {
 public:
  explicit Springs(Cut *places) : places_(places) {}

  int count() const { return count_; }
  void add(const Cut &cut, double part) {
    if (!(part > 0.0)) return;
    places_[count_] = cut;
    part_[count_++] = part;
  }

  // Sets the pulls that bear the load, which is no unit vector, and drops places without one; false where nothing is found.
  bool divide(const Vec3 &load) {
    const double length = norm(load);
    const Vec3 unit = (1.0 / length) * load;
    Vec3 direction[most_places];
    double stiffness[most_places], force[most_places];
    for (int k = 0; k < count_; ++k) {
      direction[k] = places_[k].direction;
      stiffness[k] = part_[k] / (0.5 * norm2(unit - direction[k]) + opposite);
    }
    if (!press_springs(unit, direction, stiffness, count_, force)) return false;
    int kept = 0;
    for (int k = 0; k < count_; ++k) {
      if (!(force[k] > 0.0)) continue;
      places_[kept] = places_[k];
      places_[kept++].pull = length * force[k];
    }
    count_ = kept;
    return true;
  }

 private:
  Cut *places_;
  double part_[most_places];
  int count_ = 0;
};

// How nearly two places are one: 1 where they are.
double likeness(const Cut &place, const Cut &other) {
  return faded(norm(place.direction - other.direction) / like_direction);
}

// How nearly a place is one of the faces.
double likeness(const Cut &place, const FlatPlaces &faces) {
  double result = 0.0;
  for (int k = 0; k < faces.count(); ++k) result = std::max(result, faces.part(k) * likeness(place, faces.cut(k)));
  return result;
}

// How nearly a place is one of those that the ball rests on.
double likeness(const Cut &place, const HeldBall &ball) {
  double result = 0.0;
  for (int k = 0; k < ball.count; ++k) result = std::max(result, likeness(place, ball.cuts[k]));
  return result;
}

// Which of the places that the ball rests on is in this direction; their count where none is.
int place_in(const HeldBall &ball, const Vec3 &direction) {
  int k = 0;
  while (k < ball.count && !same_place(ball.cuts[k].direction, direction)) ++k;
  return k;
}

}  // namespace

int share_pulls(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, const HeldBall &ball,
                DistanceScratch &scratch, Cut places[most_places]) {
  const auto as_they_are = [&] {
    std::copy_n(ball.cuts, ball.count, places);
    return ball.count;
  };
  if (ball.count < 2) return as_they_are();
  double least = INFINITY, sum = 0.0;
  for (int k = 0; k < ball.count; ++k) least = std::min(least, ball.cuts[k].pull), sum += ball.cuts[k].pull;

  // Faces that the ball nearly touches. Other places pass into these, and go over to them where they are about to leave.
  const FlatPlaces faces(a, b, b_in_a, ball, window * ball.radius);
  bool more = false;
  for (int k = 0; k < faces.count(); ++k) {
    more = more || (faces.part(k) > 0.0 && place_in(ball, faces.cut(k).direction) == ball.count);
  }
  Springs springs(places);
  for (const Cut *place = ball.cuts; place != ball.cuts + ball.count; ++place) {
    const int face = faces.find(place->direction);
    const double of_face = face < faces.count() ? faces.part(face) : 0.0;
    const double going = more ? faded(place->pull / (leaving * sum)) : 0.0;
    springs.add(*place, of_face + (1.0 - going) * (1.0 - likeness(*place, faces)));
  }
  for (int k = 0; k < faces.count(); ++k) {
    if (place_in(ball, faces.cut(k).direction) == ball.count) springs.add(faces.cut(k), faces.part(k));
  }

  if (ball.count == 3 && !ball.all_round) {
    const double step = window * ball.radius * (3.0 * least / sum);
    Vec3 way;  // of the centre, for each metre that the ball grows
    if (ball.meeting_place(-1.0, -1.0, -1.0, way)) {
      const double change = step / norm(way);
      for (const double away : {change, -change}) {
        Cut place;
        double part;
        if (!find_near_place(a, b, b_in_a, size, ball, away, step, scratch, place, part)) continue;
        part *= (1.0 - likeness(place, faces)) * (1.0 - likeness(place, ball));
        springs.add(place, part);
        more = more || part > 0.0;
      }
    }
  }
  if (!more || !springs.divide(-ball.centre)) return as_they_are();
  return springs.count();
}

}  // namespace cmb::convex
