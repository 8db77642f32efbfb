#include "volume/slices/solid_slice.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "math/gauss_rule.hpp"

namespace cmb::overlap {

// All places that may be corners of the slice; too many do no harm.
void SolidSlice::find_corners(double y) {
  const double low = flat_.low(), high = flat_.high();
  corners_.clear();
  corners_.push_back(low), corners_.push_back(high);
  const auto add_corner = [&](double x) {
    if (x > low && x < high) corners_.push_back(x);
  };
  for (const FlatSection::Segment &segment : flat_.segments()) {
    add_corner(segment.x0), add_corner(segment.x1);
    const Vec3 origin{segment.x0, y, segment.z0}, along{segment.x1 - segment.x0, 0.0, segment.z1 - segment.z0};
    for (int k = 0; k < solid_.round_count; ++k) {
      const Stretch inside = solid_.rounds[k].stretch(origin, along);
      if (inside.empty()) continue;
      if (inside.begin > 0.0 && inside.begin < 1.0) add_corner(segment.x0 + inside.begin * along.x);
      if (inside.end > 0.0 && inside.end < 1.0) add_corner(segment.x0 + inside.end * along.x);
    }
  }
  for (int k = 0; k < solid_.round_count; ++k) rounds_[k].visit_joints(add_corner);
  if (solid_.round_count == 2) {
    double x[7];
    for (int i = 0; i < rounds_[0].pieces(); ++i) {
      for (int j = 0; j < rounds_[1].pieces(); ++j) {
        const int count = rounds_[0].piece(i).crossings(rounds_[1].piece(j), low, high, x);
        for (int k = 0; k < count; ++k) add_corner(x[k]);
      }
    }
  }
  std::sort(corners_.begin(), corners_.end());
}

bool SolidSlice::sides_at(double x, Side &lower, Side &upper) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  lower = {-infinity, -1, -1, 0}, upper = {infinity, -1, -1, 0};
  const std::vector<FlatSection::Segment> &segments = flat_.segments();
  for (std::size_t k = 0; k < segments.size(); ++k) {
    const FlatSection::Segment &segment = segments[k];
    if (x < segment.x0 || x > segment.x1) continue;
    const double z = segment.at(x);
    if (segment.upper && z < upper.z) upper = {z, static_cast<int>(k), -1, 0};
    if (!segment.upper && z > lower.z) lower = {z, static_cast<int>(k), -1, 0};
  }
  // The polytope is bounded: what rounding leaves between its segments is outside.
  if (lower.segment < 0 || upper.segment < 0) return false;
  for (int k = 0; k < solid_.round_count; ++k) {
    const RoundSection::Sides sides = rounds_[k].at(x);
    if (sides.z.empty()) return false;
    if (sides.z.end < upper.z) upper = {sides.z.end, -1, k, sides.upper};
    if (sides.z.begin > lower.z) lower = {sides.z.begin, -1, k, sides.lower};
  }
  return lower.z < upper.z;
}

void SolidSlice::add_side(const Side &side, bool upper, double y, double from, double to, SlicedSums &sums) const {
  double area = 0.0, ax = 0.0, axx = 0.0, az = 0.0, azz = 0.0, axz = 0.0;
  const auto visit = [&](double x, double z, double weight) {
    area += weight;
    ax += weight * x;
    axx += weight * x * x;
    az += weight * z;
    azz += weight * z * z;
    axz += weight * x * z;
  };
  if (side.segment >= 0) {
    const GaussRule<2> &rule = gauss_rule<2>;
    const FlatSection::Segment &segment = flat_.segment(side.segment);
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double x = from + (to - from) * rule.node[k];
      visit(x, segment.at(x), (to - from) * rule.weight[k]);
    }
  } else {
    rounds_[side.round].piece(side.piece).integrate(upper, from, to, visit);
  }
  const double sign = upper ? 1.0 : -1.0;
  SolidSums &solid = sums.solid;
  solid.volume += sign * az;
  solid.x += sign * axz;
  solid.y += sign * y * az;
  solid.z += sign * 0.5 * azz;
  const SideSums part{area, ax, y * area, axx, y * ax, y * y * area, az};
  (upper ? solid.upper : solid.lower).add(part, 1.0);
  if (side.segment >= 0 && flat_.segment(side.segment).marked) sums.marked.add(part, 1.0);
}

// From corner to corner; a side's integrals are taken over as many of these stretches as it stays the same.
std::uint64_t SolidSlice::walk(double y, SlicedSums *sums) {
  if (!flat_.cut(*solid_.polytope, y, solid_.marked_face)) return 0;
  for (int k = 0; k < solid_.round_count; ++k) {
    rounds_[k] = RoundSection(solid_.rounds[k], y, flat_.low(), flat_.high());
  }
  find_corners(y);
  std::uint64_t order = 0;
  const double least = 1e-14 * (flat_.high() - flat_.low());
  Side lower, upper, next_lower, next_upper;
  double lower_from = 0.0, upper_from = 0.0, to = 0.0;
  bool inside = false;
  const auto close = [&](bool lower_ends, bool upper_ends) {
    if (sums == nullptr) return;
    if (lower_ends) add_side(lower, false, y, lower_from, to, *sums);
    if (upper_ends) add_side(upper, true, y, upper_from, to, *sums);
  };
  const auto note = [&](const Side &side) {
    const auto what = static_cast<std::uint64_t>(side.segment >= 0 ? flat_.segment(side.segment).face
                                                                   : -1 - 3 * side.round - side.piece);
    order = (order ^ what) * 0x9E3779B97F4A7C15u + 1;
    order ^= order >> 29;
  };
  for (std::size_t k = 1; k < corners_.size(); ++k) {
    const double from = corners_[k - 1];
    if (corners_[k] - from <= least) continue;
    if (!sides_at(0.5 * (from + corners_[k]), next_lower, next_upper)) {
      if (inside) close(true, true);
      inside = false;
      continue;
    }
    const bool lower_changes = !inside || !next_lower.same(lower), upper_changes = !inside || !next_upper.same(upper);
    if (inside) close(lower_changes, upper_changes);
    if (lower_changes) lower = next_lower, lower_from = from;
    if (upper_changes) upper = next_upper, upper_from = from;
    if (lower_changes || upper_changes) note(lower), note(upper);
    inside = true;
    to = corners_[k];
  }
  if (inside) close(true, true);
  return order;
}

}  // namespace cmb::overlap
