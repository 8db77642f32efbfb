#include "ways_out.hpp"

#include <algorithm>

#include "curved_distance.hpp"
#include "direction_refinement.hpp"
#include "fade.hpp"
#include "inner_ball.hpp"
#include "minkowski_difference.hpp"
#include "nearby_surface.hpp"

namespace cmb::convex {

namespace {

// Agreement of the ball's distance from the surface with its radius, relative to the bodies' size.
constexpr double tolerance = 1e-10;
// The ball is at rest where it moves less than this, relative to the size; the greatest part of its way that may be left.
constexpr double at_rest = 1e-10, most_left = 0.95;
// Overlaps less deep, relative to the size, have one way out: what the ball rests on would be lost in rounding.
constexpr double shallow = 1e-7;
// The sums of shares from which on, and at which, the shortest way takes over.
constexpr double squeezed = 4.0, opposed = 8.0;
constexpr int most_cuts = 40, most_rounds = 12;

// A supporting plane of the difference: direction . c <= height on it.
struct Cut {
  Vec3 direction;
  double height = 0.0;
  Vec3 a, b;
  double pull = 0.0;  // on the ball's centre
};

// The centre of the ball: the point nearest to the origin with direction . p <= height - radius for all cuts.
class BallCentre {
 public:
  BallCentre(double radius, double slack) : radius_(radius), slack_(slack) {}

  const Vec3 &value() const { return centre_; }

  // Of at most four cuts; sets the pulls, and drops cuts without. False, and nothing changed, where there is no such point.
  bool settle(Cut *cuts, int &count) {
    best_excess_ = INFINITY;
    for (int i = 0; i < count; ++i) {
      const int one[] = {i};
      const double alone[] = {lack(cuts[i])};
      consider(cuts, count, one, alone, 1);
      for (int j = 0; j < i; ++j) {
        consider_two(cuts, count, i, j);
        for (int k = 0; k < j; ++k) consider_three(cuts, count, i, j, k);
      }
    }
    if (!(best_excess_ <= slack_)) return false;
    centre_ = best_;
    int kept = 0;
    for (int k = 0; k < count; ++k) {
      if (!(best_pull_[k] > 0.0)) continue;
      cuts[kept] = cuts[k];
      cuts[kept++].pull = best_pull_[k];
    }
    count = kept;
    return count > 0;
  }

 private:
  double lack(const Cut &cut) const { return radius_ - cut.height; }

  // The centre that is pulled by these cuts alone.
  void consider(const Cut *cuts, int count, const int *which, const double *pull, int pulling) {
    Vec3 p;
    for (int k = 0; k < pulling; ++k) {
      if (pull[k] < 0.0) return;
      p = p - pull[k] * cuts[which[k]].direction;
    }
    double excess = 0.0;
    for (int k = 0; k < count; ++k) excess = std::max(excess, dot(cuts[k].direction, p) + lack(cuts[k]));
    if (excess >= best_excess_) return;
    best_excess_ = excess;
    best_ = p;
    std::fill_n(best_pull_, 4, 0.0);
    for (int k = 0; k < pulling; ++k) best_pull_[which[k]] = pull[k];
  }

  void consider_two(const Cut *cuts, int count, int i, int j) {
    const double cosine = dot(cuts[i].direction, cuts[j].direction), sine2 = 1.0 - cosine * cosine;
    if (!(sine2 > 1e-20)) return;
    const double lack_i = lack(cuts[i]), lack_j = lack(cuts[j]);
    const int which[] = {i, j};
    const double pull[] = {(lack_i - cosine * lack_j) / sine2, (lack_j - cosine * lack_i) / sine2};
    consider(cuts, count, which, pull, 2);
  }

  void consider_three(const Cut *cuts, int count, int i, int j, int k) {
    const Vec3 &u = cuts[i].direction, &v = cuts[j].direction, &m = cuts[k].direction;
    const Vec3 vm = cross(v, m), mu = cross(m, u), uv = cross(u, v);
    const double volume = dot(u, vm);
    if (!(std::fabs(volume) > 1e-12)) return;
    const Vec3 p = (-1.0 / volume) * (lack(cuts[i]) * vm + lack(cuts[j]) * mu + lack(cuts[k]) * uv);
    const int which[] = {i, j, k};
    const double pull[] = {-dot(p, vm) / volume, -dot(p, mu) / volume, -dot(p, uv) / volume};
    consider(cuts, count, which, pull, 3);
  }

  double radius_, slack_, best_excess_ = INFINITY;
  Vec3 centre_, best_;
  double best_pull_[4] = {0, 0, 0, 0};
};

// The ball that is known to touch the surface at the shortest way out.
double ball_at(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const SignedDistance &nearest, double enough,
               double slack) {
  const Vec3 outward = -nearest.normal;
  const double swept = a.radius + b.radius;
  return swept + inner_ball(a, b, b_in_a, outward, nearest.point_a - a.radius * outward, nearest.point_b + b.radius * outward,
                            enough - swept, slack);
}

// Of bodies, B moved by p, whose difference's surface is about equally near at the cuts, and may be as near elsewhere.
SignedDistance distance_beside(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &p, const Cut *cuts,
                               int count, DistanceScratch &scratch) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + p};
  if (is_polyhedral(a.core) && is_polyhedral(b.core)) return signed_distance(a, b, moved, scratch);
  EquallyNear known;
  for (; known.count < count; ++known.count) known.direction[known.count] = cuts[known.count].direction;
  return swept_distance(curved_distance(a, b, moved, -cuts[0].direction, scratch, &known), a.radius, b.radius);
}

WaysOut single(const SignedDistance &nearest) {
  WaysOut result;
  result.count = 1;
  result.way[0] = {nearest.normal, -nearest.distance, nearest.point_a, nearest.point_b, {}, 1.0};
  return result;
}

// As far as a way may turn about a place that the ball rests on (rad).
constexpr double nearby = 1e-2;

// The planes of the cuts where the ball rests on a curved surface are not yet those at its centre: Newton's method
// moves them there. Afterwards the cuts' points are those that face each other.
void move_cuts(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const Vec3 &p, Cut *cuts, int count) {
  const Pose moved{b_in_a.rotation, b_in_a.translation + p};
  const MinkowskiDifference difference(a, b, moved);
  for (int k = 0; k < count; ++k) {
    Cut &cut = cuts[k];
    const RefinedDirection r = refine_direction(difference, cut.direction, cut.a - a.radius * cut.direction,
                                                cut.b + p + b.radius * cut.direction);
    if (!(dot(r.direction, cut.direction) > 1.0 - 0.5 * nearby * nearby)) continue;  // another place, as near
    cut.direction = r.direction;
    cut.height = r.height + a.radius + b.radius + dot(p, r.direction);
    cut.a = r.a + a.radius * r.direction;
    cut.b = r.b - b.radius * r.direction - p;
  }
}

// Moves the planes of the cuts to the ball's centre, and the centre with them, until both agree. Along a curved edge of where the
// centre may be each round leaves a part of the way: the next one begins where this part, round after round, would lead. False
// where the cuts leave no centre.
bool move_to_rest(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, double size, BallCentre &centre, Cut *cuts,
                  int &count) {
  Vec3 at = centre.value(), last_way;
  for (int round = 0; round < most_rounds; ++round) {
    const int before = count;
    move_cuts(a, b, b_in_a, at, cuts, count);
    if (!centre.settle(cuts, count)) return false;
    const Vec3 way = centre.value() - at;
    if (norm2(way) <= at_rest * at_rest * size * size) return true;
    const double last2 = norm2(last_way), left = count == before && last2 > 0.0 ? dot(way, last_way) / last2 : 0.0;
    const bool extrapolated = round % 2 == 1 && std::fabs(left) < most_left;
    at = extrapolated ? centre.value() + (left / (1.0 - left)) * way : centre.value();
    last_way = extrapolated ? Vec3{} : way;
  }
  return true;
}

}  // namespace

WaysOut ways_out(const ConvexBody &a, const ConvexBody &b, const Pose &b_in_a, const SignedDistance &nearest, double size,
                 DistanceScratch &scratch) {
  const double depth = -nearest.distance, radius = surface_reach(depth, size), slack = tolerance * size;
  if (!(depth > shallow * size)) return single(nearest);
  const double known = std::max(nearest.ball, ball_at(a, b, b_in_a, nearest, radius, slack));
  if (known >= radius) return single(nearest);

  Cut cuts[4];
  cuts[0] = {-nearest.normal, depth, nearest.point_a, nearest.point_b, 1.0};
  int count = 1;
  BallCentre centre(radius, slack);
  if (!centre.settle(cuts, count)) return single(nearest);
  for (int step = 0; step < most_cuts; ++step) {
    if (step > 0 && !move_to_rest(a, b, b_in_a, size, centre, cuts, count)) return single(nearest);
    const Vec3 p = centre.value();
    const SignedDistance there = distance_beside(a, b, b_in_a, p, cuts, count, scratch);
    if (-there.distance >= radius - slack) break;
    cuts[count] = {-there.normal, -there.distance - dot(p, there.normal), there.point_a, there.point_b - p, 0.0};
    ++count;
    if (!centre.settle(cuts, count)) return single(nearest);
  }
  WaysOut result;  // the centre is at least radius - depth > 0 from the origin
  const Vec3 &p = centre.value();
  const double length = norm(p);
  double sum = 0.0;
  for (int k = 0; k < count; ++k) sum += cuts[k].pull / length;
  // Ways that nearly oppose each other would need ever greater shares: the shortest takes over.
  const double left = faded(std::max(0.0, (sum - squeezed) / (opposed - squeezed)));
  if (left < 1.0) {
    result = single(nearest);
    result.way[0].share = 1.0 - left;
  }
  for (int k = 0; k < count; ++k) {
    const Cut &cut = cuts[k];
    const Vec3 aside = p - dot(p, cut.direction) * cut.direction;
    result.way[result.count++] = {-cut.direction, cut.height, cut.a, cut.b, aside, left * cut.pull / length};
  }
  return result;
}

}  // namespace cmb::convex
