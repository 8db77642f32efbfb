#include "volume/slices/slice_range.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmb::overlap {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

Stretch range_of(const convex::OverlapScratch &polytope) {
  Stretch range{infinity, -infinity};
  for (const Vec3 &p : polytope.vertices()) range = {std::min(range.begin, p.y), std::max(range.end, p.y)};
  return range;
}

// The slices that are not empty lie between the two next to any of them that are.
class RangeSearch {
 public:
  // `whole`: the polytope's y.
  RangeSearch(const CommonSolid &solid, const Stretch &whole, SolidSlice &slice, EdgeCrossings &crossings)
      : solid_(solid), whole_(whole), slice_(slice), crossings_(crossings) {
    slice_.start(solid_);
    crossings_.find(solid_);
  }

  Stretch find(const double *guess, int guess_count) {
    if (!find_inner(guess, guess_count)) return {};
    return {end_towards(whole_.begin), end_towards(whole_.end)};
  }

 private:
  bool holds(double y) {
    inner_ = y;
    return y > whole_.begin && y < whole_.end && slice_.order(y) != 0;
  }

  bool find_inner(const double *guess, int guess_count) {
    for (int k = 0; k < guess_count; ++k) {
      if (holds(guess[k])) return true;
    }
    Vec3 middle;
    const double part = 1.0 / static_cast<double>(solid_.polytope->vertices().size());
    for (const Vec3 &p : solid_.polytope->vertices()) middle = middle + part * p;
    for (const Vec3 &p : crossings_.inside()) {
      if (holds_behind(p, middle)) return true;
    }
    return solid_.round_count == 1 ? find_in_one(middle) : find_in_both();
  }

  // From a place of the polytope's surface inside the round solids towards its middle.
  bool holds_behind(const Vec3 &p, const Vec3 &middle) {
    double reach = 1.0;
    for (int k = 0; k < solid_.round_count; ++k) {
      reach = std::min(reach, solid_.rounds[k].stretch(p, middle - p).end);
    }
    return holds(p.y + 0.5 * reach * (middle.y - p.y));
  }

  // No edge of the polytope enters the round solid: it lies inside, or some face cuts it within its border.
  bool find_in_one(const Vec3 &middle) {
    const RoundSolid &round = solid_.rounds[0];
    if (holds(round.inner_point().y)) return true;
    for (const auto &face : solid_.polytope->faces()) {
      Vec3 p;
      if (round.point_in_plane(face.normal, face.offset, p) && holds_behind(p, middle)) return true;
    }
    return false;
  }

  // Within what each round solid alone has in common with the polytope.
  bool find_in_both() {
    Stretch both = whole_;
    for (int k = 0; k < 2; ++k) {
      const Stretch alone = RangeSearch(solid_.with_round(k), whole_, slice_, crossings_).find(nullptr, 0);
      both = {std::max(both.begin, alone.begin), std::min(both.end, alone.end)};
      if (both.empty()) return false;
    }
    slice_.start(solid_);
    crossings_.find(solid_);
    constexpr int samples = 128;
    for (int k = 0; k < samples; ++k) {
      if (holds(both.begin + (both.end - both.begin) * (k + 0.5) / samples)) return true;
    }
    return false;
  }

  // The y next to `end` of what is not empty.
  double end_towards(double end) {
    const double length = whole_.end - whole_.begin, outward = inner_ < end ? 1.0 : -1.0;
    const std::vector<double> &kinks = crossings_.kinks();
    if (!kinks.empty()) {
      const double last = outward > 0.0 ? kinks.back() : kinks.front();
      const double beyond = last + 1e-9 * outward * length;
      if ((last - inner_) * outward > 0.0 && ((end - beyond) * outward <= 0.0 || slice_.order(beyond) == 0)) return last;
    }
    const double just_inside = end - 1e-12 * outward * length;
    if (slice_.order(just_inside) != 0) return end;
    double in = inner_, out = just_inside;
    // Relative to what is found, which may be far less than the whole.
    for (int step = 0; step < 100 && std::fabs(out - in) > 1e-11 * std::fabs(in - inner_) + 1e-15 * length; ++step) {
      const double between = 0.5 * (in + out);
      (slice_.order(between) != 0 ? in : out) = between;
    }
    return in;
  }

  CommonSolid solid_;
  Stretch whole_;
  SolidSlice &slice_;
  EdgeCrossings &crossings_;
  double inner_ = 0.0;  // of a slice that is not empty
};

}  // namespace

Stretch find_slice_range(const CommonSolid &solid, const double *guess, int guess_count, SolidSlice &slice,
                         EdgeCrossings &crossings) {
  const Stretch whole = range_of(*solid.polytope);
  if (whole.empty()) return {};
  return RangeSearch(solid, whole, slice, crossings).find(guess, guess_count);
}

}  // namespace cmb::overlap
