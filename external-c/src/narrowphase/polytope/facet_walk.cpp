#include "narrowphase/polytope/facet_walk.hpp"

#include <algorithm>

#include "math/index.hpp"

namespace cmb::convex {

namespace {

constexpr std::size_t most_facets = 400;
constexpr int mark_bits = 13, small_bits = 6;  // small bodies have no more edges than that many bits count
constexpr std::size_t mark_count = std::size_t{1} << mark_bits;
static_assert(2 * small_bits + 1 <= mark_bits, "sides of small bodies have places of their own");
// The support ring takes some facets' time, which pays the sooner the finer the bodies are.
constexpr std::size_t facets_before_ring = 6, facets_before_ring_of_small = 12;
// The facets' cosine to the lowest one from which on the support ring is of no use.
constexpr double ring_reach = 0.75;
constexpr int most_descents = 200;
// Bodies less deep in each other than this, times the scale, are left to others.
constexpr double touching = 1e-10;

}  // namespace

FacetWalk::FacetWalk() : marks_(mark_count, Mark{0, 0, 0}) {
  facets_.reserve(most_facets);
  sides_.reserve(static_cast<std::size_t>(DifferenceFacets::most_corners));
}

// Goes on to nearer facets until one holds the origin's foot.
bool FacetWalk::descend(Facet &facet) {
  for (int step = 0; step < most_descents && facet.height > 0.0; ++step) {
    const Corner *const corner = surface_.corners_of(facet);
    double farthest = 0.0;
    std::int32_t beyond = -1;
    for (std::int32_t k = 0; k < facet.count; ++k) {
      const Vec3 &p = corner[k].at, &q = surface_.end_of(facet, k);
      const double area = dot(facet.normal, cross(p, q));
      if (area < farthest) farthest = area, beyond = k;
    }
    if (beyond < 0) return true;
    Facet next;
    const Corner side = corner[beyond];
    const Vec3 side_end = surface_.end_of(facet, beyond);
    surface_.forget();
    if (!surface_.cross_side(side, side_end, facet.normal, next) || !(next.height < facet.height)) return false;
    facet = next;
  }
  return false;
}

// The mark of a side, with its key if it is new.
FacetWalk::Mark &FacetWalk::mark_of(const Corner &corner) {
  const auto edge = static_cast<std::uint32_t>(corner.edge);
  const auto vertex = static_cast<std::uint32_t>(corner.vertex[1 - corner.body]);
  if (small_) {
    return marks_[static_cast<std::uint32_t>(corner.body) << 2 * small_bits | edge << small_bits | vertex];
  }
  const std::uint64_t key = static_cast<std::uint64_t>(corner.body) << 62 | static_cast<std::uint64_t>(edge) << 31 | vertex;
  auto at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> (64 - mark_bits));
  while (marks_[at].growth == growth_ && marks_[at].key != key) at = (at + 1) % mark_count;
  marks_[at].key = key;
  return marks_[at];
}

// Adds the sides of a facet from the one numbered `k` on. Each side belongs to two facets, which run along it in opposite
// directions.
bool FacetWalk::add_sides(const Facet &facet, std::int32_t number, std::int32_t k) {
  for (; k < facet.count; ++k) {
    const Corner &corner = surface_.corner(facet.first + k);
    Mark &mark = mark_of(corner);
    if (mark.growth != growth_) {
      mark.growth = growth_, mark.side = static_cast<std::int32_t>(sides_.size());
      sides_.push_back({number, facet.first + k, false});
      continue;
    }
    Side &known = sides_[index(mark.side)];
    if (known.inner || surface_.corner(known.corner).forward == corner.forward) return false;
    known.inner = true;
  }
  return true;
}

bool FacetWalk::is_closed(const PatchCompletion &completion) const {
  if (!completion.has_ring()) return true;
  int steps[PatchCompletion::ring_points] = {};
  bool open = false;
  for (const Side &side : sides_) {
    if (side.inner) continue;
    open = true;
    completion.count_steps(surface_.corner(side.corner).at, end_of(side), steps);
  }
  return !open || std::all_of(steps, steps + PatchCompletion::ring_points, [](int count) { return count == 1; });
}

// Adds facets round the lowest one until no other can be within the ball. Where one turns out to be lower, `lowest` is
// exchanged and the ball shrinks: what was outside it still is.
bool FacetWalk::grow(const MinkowskiDifference &difference, Facet &lowest) {
  const double slack = 1e-15 * difference.scale;
  const Vec3 axis = lowest.normal;
  PatchCompletion completion(difference, axis, lowest.height);
  const std::size_t before_ring = small_ ? facets_before_ring_of_small : facets_before_ring;
  bool ring_tried = false, sides_skipped = false;
  if (++growth_ == 0) {
    std::fill(marks_.begin(), marks_.end(), Mark{0, 0, 0});
    growth_ = 1;
  }
  facets_.clear();
  sides_.clear();
  facets_.push_back(lowest);
  if (!add_sides(lowest, 0, 0)) return false;
  for (std::size_t k = 0;; ++k) {
    if (k == sides_.size() && sides_skipped) {
      sides_skipped = false;
      k = 0;
    } else if (k == sides_.size()) {
      if (is_closed(completion)) return true;
      completion.drop_ring();
      k = 0;
    }
    if (sides_[k].inner) continue;
    const Corner &corner = surface_.corner(sides_[k].corner);
    const Vec3 &end = end_of(sides_[k]);
    if (completion.holds(corner.at, end)) continue;
    if (facets_.size() == most_facets) return false;
    if (facets_.size() >= before_ring && !ring_tried) {
      ring_tried = true;
      if (completion.add_ring()) {
        k = static_cast<std::size_t>(-1);
        continue;
      }
    }
    const Vec3 &from = facets_[index(sides_[k].facet)].normal;
    Facet next;
    sides_[k].inner = true;
    if (!surface_.cross_side(corner, end, from, next) || !(next.height > 0.0)) return false;
    facets_.push_back(next);
    const std::size_t first_new = sides_.size();
    if (!add_sides(next, static_cast<std::int32_t>(facets_.size()) - 1, 1)) return false;
    if (completion.has_ring() && dot(next.normal, axis) < ring_reach) {
      completion.drop_ring();
      k = static_cast<std::size_t>(-1);
    }
    if (next.height < lowest.height - slack) {
      lowest = next;
      if (!(lowest.height > touching * difference.scale)) return false;
      completion.shrink(lowest.height);
      // Downwards first.
      sides_skipped = true;
      k = first_new - 1;
    }
  }
}

// Takes the facet that holds the origin's foot out of those that are as low as the lowest to rounding. False where none does:
// facets beyond, in the same plane, were not met.
bool FacetWalk::choose_by_foot(double scale, Facet &lowest) const {
  const double height = lowest.height + 1e-14 * scale;
  double best = -HUGE_VAL;
  for (const Facet &facet : facets_) {
    if (!(facet.height <= height)) continue;
    double least = HUGE_VAL;
    for (std::int32_t k = 0; k < facet.count; ++k) {
      least = std::min(least, dot(facet.normal, cross(surface_.corner(facet.first + k).at, surface_.end_of(facet, k))));
    }
    if (least > best) best = least, lowest = facet;
  }
  return best >= -1e-15 * scale * scale;
}

FacetWalk::Outcome FacetWalk::minimum_translation(const MinkowskiDifference &difference, const Vec3 &first, const DifferencePoint &farthest,
                                                  Result &result) {
  surface_.place(difference);
  small_ = surface_.most_edges() <= std::size_t{1} << small_bits;
  Facet lowest;
  if (!surface_.start(first, farthest, lowest, result.direction)) {
    return norm2(result.direction) > 0.0 ? Outcome::apart : Outcome::undecided;
  }
  if (!descend(lowest)) {
    if (lowest.height > 0.0) return Outcome::undecided;
    result.direction = lowest.normal;
    return Outcome::apart;
  }
  if (!(lowest.height > touching * difference.scale) || !grow(difference, lowest)) return Outcome::undecided;
  // The one that the walk came down to, the first, holds the foot.
  const bool foot_known = lowest.first == facets_.front().first;
  if (!foot_known && !choose_by_foot(difference.scale, lowest)) return Outcome::undecided;
  result.direction = lowest.normal;
  result.depth = lowest.height;
  if (!surface_.is_outermost(lowest, 1e-15 * difference.scale)) return Outcome::undecided;
  surface_.find_witness(lowest, result.a, result.b);
  return Outcome::found;
}

}  // namespace cmb::convex
