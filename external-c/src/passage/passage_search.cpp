#include "passage/passage_search.hpp"

#include <algorithm>
#include <cmath>

#include "math/body_pose.hpp"
#include "query/bound_gap.hpp"
#include "query/pair_query.hpp"

namespace cmb {

namespace {

// Shares of the thickness of the thinner body. Bodies that move against each other by less than `short_way` cannot pass through each
// other unseen: they lie in each other at one end of the way, or overlap in between by a hundredth or two.
constexpr double short_way = 0.25;
// Bodies have met that overlap by so much more between the ends of a step than at these.
constexpr double noticed = 0.02;
// Where they touch is told to so much, and more where they lay in each other before, so that an integrator that goes on from there
// gets ahead.
constexpr double just_touching = 1e-6, deeper = 3.0;
// Of the step: shorter parts are not looked at.
constexpr double shortest_part = 1e-12;
constexpr int most_rounds = 60;  // of locating

Vec3 row(const double *rows, std::size_t index) { return {rows[3 * index], rows[3 * index + 1], rows[3 * index + 2]}; }

double largest_overlap(double begin, double end) { return std::fmax(0.0, std::fmax(-begin, -end)); }

struct Extent {
  double low, high;
  std::uint32_t body;
};

}  // namespace

BodyMotion PassageSearch::motion_of(std::size_t body, const Moment &moment) const {
  const std::size_t n = step_.body_count;
  const double *const at = moment.numbers;
  return {body_pose(at + 3 * body, at + 3 * n + 9 * body), row(at + 12 * n, body), row(at + 15 * n, body)};
}

ClosingSpeed PassageSearch::speed(const WatchedPair &pair, const Moment &moment) const {
  return closing_speed(scene_, pair.a, pair.reach_a, motion_of(pair.a, moment), pair.b, pair.reach_b, motion_of(pair.b, moment));
}

// By how much the distance may change on the way from one moment to the other.
double PassageSearch::way(const WatchedPair &pair, const Moment &begin, const Moment &end) const {
  const ClosingSpeed first = speed(pair, begin), last = speed(pair, end);
  const double most = std::fmax(first.largest, last.largest) + 0.5 * norm(last.of_centers - first.of_centers);
  return (end.share - begin.share) * step_.duration * most;
}

double PassageSearch::distance(const WatchedPair &pair, const Moment &moment, double exact_within) const {
  QueryScratch &scratch = query_scratch();
  PairReport report;
  const double within = exact_within > 0.0 ? exact_within : HUGE_VAL;
  query_bodies(scene_, pair.a, motion_of(pair.a, moment).pose, pair.b, motion_of(pair.b, moment).pose, scratch, scratch.contact,
               report, within);
  return scratch.contact.distance;
}

// Bodies that were apart and are not any more: the time at which an integrator comes by may lie within one of its steps.
bool PassageSearch::has_met(const WatchedPair &pair) const {
  return pair.begin >= 0.0 && -pair.end > 2.0 * just_touching * pair.thickness;
}

// Distances change by no more than the way, so that bodies get no deeper than half of what is left of it.
bool PassageSearch::may_pass(const WatchedPair &pair, double way) const {
  if (!(way > short_way * pair.thickness)) return false;
  return 0.5 * (way - pair.begin - pair.end) > largest_overlap(pair.begin, pair.end) + noticed * pair.thickness;
}

bool PassageSearch::take(double share, std::vector<double> &room, Moment &moment) const {
  room.resize(18 * step_.body_count);
  if (step_.at(step_.context, share, room.data()) != 0) return false;
  moment = {share, room.data()};
  return true;
}

// Finds where the pair comes to touch before a share at which it lies in each other: by regula falsi with halved
// weights (Dowell and Jarratt, BIT 11, 1971).
bool PassageSearch::locate(const WatchedPair &pair, double from, double until, cmb_passage &passage) const {
  // From where they are deeper than at the step's beginning on, if they already lie in each other where its part begins.
  const bool from_start = pair.begin < 0.0 && pair.begin < pair.start && pair.end < pair.start;
  const double at_first = from_start ? pair.start : pair.begin, before = std::fmax(0.0, -at_first);
  const double least = just_touching * pair.thickness, gain = std::fmin(std::fmax(least, deeper * before), 0.5 * noticed * pair.thickness);
  const double first = from_start ? 0.0 : from;
  double low = first, high = until;
  double at_low = at_first + before + gain, at_high = pair.end + before + gain;
  double missing = std::fabs(at_high);  // at `high`
  std::vector<double> room;
  Moment moment;
  for (int round = 0; round < most_rounds && missing > 0.5 * gain && high - low > shortest_part; ++round) {
    double share = at_low > at_high ? low + (high - low) * at_low / (at_low - at_high) : 0.5 * (low + high);
    if (!(share > low && share < high) || round % 8 == 7) share = 0.5 * (low + high);
    if (!take(share, room, moment)) return false;
    const double here = distance(pair, moment, HUGE_VAL) + before + gain;
    if (here > 0.5 * gain) {
      if (low > first) at_high *= 0.5;
      low = share;
      at_low = here;
    } else {
      at_low *= 0.5;
      high = share;
      at_high = here;
      missing = std::fabs(here);
    }
  }
  if (!take(high, room, moment)) return false;
  passage = {static_cast<int>(pair.a) + 1, static_cast<int>(pair.b) + 1, high, pair.thickness, speed(pair, moment).largest};
  return true;
}

bool PassageSearch::search(const Moment &begin, const Moment &end, const std::vector<WatchedPair> &pairs,
                           cmb_passage &passage) const {
  std::vector<double> ways;
  std::vector<WatchedPair> open, first, second, met;
  for (const WatchedPair &pair : pairs) {
    const double longest = way(pair, begin, end);
    if (has_met(pair) ? !(longest > short_way * pair.thickness) : !may_pass(pair, longest)) {
      if (has_met(pair)) met.push_back(pair);
      continue;
    }
    open.push_back(pair);
    ways.push_back(longest);
  }
  const bool is_last = end.share - begin.share <= shortest_part;
  if (open.empty() || is_last) return locate_first(met, begin.share, end.share, passage);
  std::vector<double> room;
  Moment middle;
  if (!take(0.5 * (begin.share + end.share), room, middle)) return false;
  for (const WatchedPair &pair : met) {  // of the half in which they met
    open.push_back(pair);
    ways.push_back(0.0);
  }
  met.clear();
  for (std::size_t k = 0; k < open.size(); ++k) {
    WatchedPair before = open[k], after = open[k];
    before.end = after.begin = distance(open[k], middle, ways[k]);
    if (before.begin < 0.0 && -before.end > largest_overlap(open[k].begin, open[k].end) + noticed * open[k].thickness) {
      met.push_back(before);
    } else {
      first.push_back(before);
      second.push_back(after);
    }
  }
  return search(begin, middle, first, passage) || locate_first(met, begin.share, middle.share, passage) ||
         search(middle, end, second, passage);
}

// The first of the meetings of some pairs, all of which lie in each other at the later share.
bool PassageSearch::locate_first(const std::vector<WatchedPair> &pairs, double from, double until, cmb_passage &passage) const {
  for (const WatchedPair &pair : pairs) {
    cmb_passage other;
    if (!locate(pair, from, until, other)) continue;
    if (passage.body_a == 0 || other.share < passage.share) passage = other;
  }
  return passage.body_a != 0;
}

// How far the body's points may come in the step.
double PassageSearch::fastest(std::size_t body) const {
  const TurningReach reach = turning_reach(scene_, body);
  const Moment ends[] = {{0.0, step_.begin}, {1.0, step_.end}};
  Vec3 velocity[2];
  double most = 0.0;
  for (int k = 0; k < 2; ++k) {
    const BodyMotion motion = motion_of(body, ends[k]);
    velocity[k] = motion.velocity + cross(motion.angular_velocity, motion.pose.rotation * reach.center);
    const double rate = norm(motion.angular_velocity);
    most = std::fmax(most, norm(velocity[k]) + (rate > 0.0 && reach.radius > 0.0 ? rate * reach.radius : 0.0));
  }
  return step_.duration * (most + 0.5 * norm(velocity[1] - velocity[0]));
}

void PassageSearch::watch(std::size_t a, std::size_t b) {
  WatchedPair pair{static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b),
                   std::fmin(scene_.thickness[a], scene_.thickness[b]), turning_reach(scene_, a), turning_reach(scene_, b), 0.0, 0.0, 0.0};
  if (!std::isfinite(pair.thickness)) return;
  const Moment begin{0.0, step_.begin}, end{1.0, step_.end};
  const double longest = way(pair, begin, end);
  if (!(longest > short_way * pair.thickness)) return;
  const BodyBounds &bounds_a = scene_.bounds[a], &bounds_b = scene_.bounds[b];
  if (bounds_a.bounded() && bounds_b.bounded()) {
    double gaps = 0.0;
    for (const Moment &moment : {begin, end}) {
      gaps += norm(motion_of(a, moment).pose(bounds_a.center) - motion_of(b, moment).pose(bounds_b.center)) - bounds_a.radius -
              bounds_b.radius;
    }
    if (gaps > longest) return;
  }
  pair.start = pair.begin = distance(pair, begin, longest);
  if (pair.begin >= longest) return;
  pair.end = distance(pair, end, longest);
  watched_.push_back(pair);
}

bool PassageSearch::find(cmb_passage &passage) {
  // The way of a pair is no longer than both bodies' together, rounding apart: most steps are too short for any.
  constexpr double rounding = 1e-9;
  std::vector<double> way_of;
  way_of.reserve(scene_.bodies.size());
  for (std::size_t body = 0; body < scene_.bodies.size(); ++body) way_of.push_back(fastest(body));
  for (const Scene::Pair &pair : scene_.pairs) {
    const double thickness = std::fmin(scene_.thickness[pair.first], scene_.thickness[pair.second]);
    const double most = way_of[pair.first] + way_of[pair.second];
    if (most <= (1.0 - rounding) * short_way * thickness) continue;
    watch(pair.first, pair.second);
  }
  return !watched_.empty() && search({0.0, step_.begin}, {1.0, step_.end}, watched_, passage);
}

// Looks at bodies whose balls, as far as the step may carry them, overlap along the first axis.
bool PassageSearch::find_among(const std::vector<std::uint32_t> &bodies, const CollisionFilter &filter, cmb_passage &passage) {
  std::vector<Extent> extents;
  double thinnest = HUGE_VAL, farthest = 0.0;
  for (const std::uint32_t body : bodies) {
    thinnest = std::fmin(thinnest, scene_.thickness[body]);
    if (!filter.fixed(body)) farthest = std::fmax(farthest, fastest(body));
  }
  if (!(2.0 * farthest > short_way * thinnest)) return false;
  for (const std::uint32_t body : bodies) {
    const BodyBounds &bounds = scene_.bounds[body];
    if (scene_.bodies[body].empty()) continue;
    const double all = bounds.radius + (filter.fixed(body) ? 0.0 : fastest(body));
    const double x = bounds.bounded() ? motion_of(body, {0.0, step_.begin}).pose(bounds.center).x : 0.0;
    extents.push_back({x - all, x + all, body});
  }
  std::sort(extents.begin(), extents.end(), [](const Extent &p, const Extent &q) {
    return p.low < q.low || (p.low == q.low && p.body < q.body);
  });
  for (std::size_t p = 0; p < extents.size(); ++p) {
    for (std::size_t q = p + 1; q < extents.size() && extents[q].low <= extents[p].high; ++q) {
      if (!filter.may_touch(extents[p].body, extents[q].body)) continue;
      watch(std::min(extents[p].body, extents[q].body), std::max(extents[p].body, extents[q].body));
    }
  }
  return !watched_.empty() && search({0.0, step_.begin}, {1.0, step_.end}, watched_, passage);
}

}  // namespace cmb
