#include "mesh/elastic/deepest_within.hpp"

#include <algorithm>

namespace cmb::mesh {

namespace {

constexpr int most_steps = 80;
constexpr double steepest = 1e8;  // no multiplier is greater

// The place for which `place_for(l)` is before the plane by nothing: the farther before it, the greater l. False where it is beyond for
// all l. By the rule of false position (Illinois), and by halving where that is slow.
template <typename PlaceFor>
bool meet_plane(const WedgePlane &plane, double slack, PlaceFor &&place_for, Vec3 &place) {
  const auto before = [&](const Vec3 &at) { return dot(plane.normal, at) - plane.offset; };
  Vec3 low, high;
  low = place_for(0.0);
  double from = 0.0, to = 1.0, at_from = before(low), at_to = 0.0;
  for (;; to *= 4.0) {
    if (to > steepest) return false;
    high = place_for(to);
    at_to = before(high);
    if (at_to >= 0.0) break;
    from = to, low = high, at_from = at_to;
  }
  double low_value = at_from, high_value = at_to;  // halved where an end stays
  int side = 0;
  for (int step = 0; step < most_steps; ++step) {
    double middle = step % 3 == 2 ? 0.5 * (from + to) : from - low_value * (to - from) / (high_value - low_value);
    if (!(middle > from) || !(middle < to)) middle = 0.5 * (from + to);
    if (!(from < middle) || !(middle < to)) break;
    const Vec3 at = place_for(middle);
    const double value = before(at);
    if (value < 0.0) {
      from = middle, low = at, at_from = low_value = value;
      if (side < 0) high_value *= 0.5;
      side = -1;
    } else {
      to = middle, high = at, at_to = high_value = value;
      if (side > 0) low_value *= 0.5;
      side = 1;
    }
    if (-at_from <= slack || at_to <= slack || norm2(high - low) <= slack * slack) break;
  }
  // Where the supporting place jumps, both support, and so does what is between them.
  place = low + std::clamp(at_from / (at_from - at_to), 0.0, 1.0) * (high - low);
  return true;
}

}  // namespace

Deepest deepest_within(const convex::ConvexBody &body, const Vec3 &direction, const std::vector<WedgePlane> &planes, double enough,
                    Vec3 &place) {
  const double slack = 1e-13 * norm(body.half);
  const auto is_beyond_any = [&](const Vec3 &at) {
    return std::any_of(planes.begin(), planes.end(),
                       [&](const WedgePlane &plane) { return dot(plane.normal, at) < plane.offset - 10.0 * slack; });
  };
  const auto supporting = [&](const Vec3 &along) { return convex::core_support(body, along).point; };
  place = supporting(direction);
  if (!(dot(direction, place) > enough)) return Deepest::none;
  if (!is_beyond_any(place)) return Deepest::found;
  const Vec3 farthest = place;
  for (const WedgePlane &plane : planes) {
    if (!(dot(plane.normal, farthest) < plane.offset)) continue;
    const auto place_for = [&](double part) { return supporting(direction + part * plane.normal); };
    if (!meet_plane(plane, slack, place_for, place) || !(dot(direction, place) > enough)) return Deepest::none;
    if (!is_beyond_any(place)) return Deepest::found;
  }
  return Deepest::on_edges;
}

}  // namespace cmb::mesh
