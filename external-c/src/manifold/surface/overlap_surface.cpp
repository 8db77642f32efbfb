#include "manifold/surface/overlap_surface.hpp"

#include <cmath>

#include "manifold/narrow_overlap.hpp"

namespace cmb {

namespace {

using convex::Lanes;
using convex::LaneVec3;

constexpr double most_open = 1e-5;  // by all of the surface: what may be open

}  // namespace

Vec3 OverlapSurface::middle_of_area() const {
  Vec3 sum;
  double whole = 0.0;
  for (const Nodes *const side : {&a_, &b_}) {
    for (const Node &node : *side) {
      const double area = norm(node.area);
      sum = sum + area * node.at;
      whole += area;
    }
  }
  return whole > 0.0 ? (1.0 / whole) * sum : Vec3{};
}

bool OverlapSurface::is_closed() const {
  Vec3 open;
  double whole = 0.0;
  for (const Nodes *const side : {&a_, &b_}) {
    for (const Node &node : *side) {
      open = open + node.area;
      whole += std::fabs(node.area.x) + std::fabs(node.area.y) + std::fabs(node.area.z);
    }
  }
  return whole > 0.0 && norm(open) <= most_open * whole;
}

// The integral of a homogeneous polynomial of degree k over the cones from the origin to the surface's parts is place . area times its
// value there, by k + 3. From a place in the overlap no part is negative, so that nothing cancels: so first that place is found.
bool OverlapSurface::measure() {
  LaneVec3 opens, firsts;
  Lanes volumes{};
  const auto add = [&](const Nodes &side) {
    Lanes whole{};
    side.visit_pairs([&](const Nodes::Pair &node) {
      const Lanes part = dot(node.at, node.area);
      whole += convex::square_root(norm2(node.area));
      opens = opens + node.area;
      volumes += part;
      firsts = firsts + part * node.at;
    });
    return convex::sum_of(whole);
  };
  area_[0] = add(a_), area_[1] = add(b_);
  const Vec3 open = convex::sum_of(opens);
  const double volume = convex::sum_of(volumes);
  gap_ = norm(open);
  if (!(volume > 0.0) || !(gap_ <= most_open * (area_[0] + area_[1]))) return false;
  to_middle_ = (3.0 / (4.0 * volume)) * convex::sum_of(firsts);
  return true;
}

bool OverlapSurface::settle() {
  const LaneVec3 shift(to_middle_);
  LaneVec3 firsts;
  Lanes volumes{};
  place_ = place_ + to_middle_;
  for (Nodes *const side : {&a_, &b_}) {
    side->change_pairs([&](Nodes::Pair &node) {
      node.at = node.at - shift;
      node.cone = dot(node.at, node.area);
      volumes += node.cone;
      firsts = firsts + node.cone * node.at;
    });
  }
  const double volume = convex::sum_of(volumes);
  const Vec3 first = convex::sum_of(firsts);
  if (!(volume > 0.0)) return false;
  volume_ = volume / 3.0;
  middle_ = (3.0 / (4.0 * volume)) * first;
  find_spread();
  return spread_.trace() > 0.0;
}

void OverlapSurface::find_spread() {
  Lanes sums[6] = {};
  for (const Nodes *const side : {&a_, &b_}) {
    side->visit_pairs([&](const Nodes::Pair &node) {
      const LaneVec3 &at = node.at, part = node.cone * at;
      sums[0] += part.x * at.x, sums[1] += part.y * at.y, sums[2] += part.z * at.z;
      sums[3] += part.y * at.z, sums[4] += part.z * at.x, sums[5] += part.x * at.y;
    });
  }
  convex::SymmetricMatrix second;
  for (int k = 0; k < 6; ++k) second.m[k] = convex::sum_of(sums[k]);
  spread_ = {};
  spread_.add(1.0 / (5.0 * volume_), second);
  spread_.add_square(-1.0, middle_);
  // Of a needle's or sliver's overlap one may be less than nothing by rounding, while its volume and middle are known.
  for (int k = 0; k < 3; ++k) spread_.m[k] = std::fmax(spread_.m[k], 0.0);
}

Mat3 OverlapSurface::align() {
  constexpr double thin = 1e-3;  // by how wide it is: from there on rounding counts for less than 1e-10
  const double width = std::sqrt(spread_.trace());
  if (volume_ > thin * width * std::fmin(area_[0], area_[1])) return {};
  // The side that is flat, or nearer to it.
  Vec3 normal;
  double flatness = 0.0;
  for (int side = 0; side < 2; ++side) {
    Vec3 sum;
    for (const Node &node : side == 0 ? a_ : b_) sum = sum + node.area;
    const double length = norm(sum);
    if (length > flatness * area_[side]) flatness = length / area_[side], normal = (1.0 / length) * sum;
  }
  if (flatness == 0.0) return {};
  const Vec3 u = convex::any_perpendicular(normal);
  const Mat3 turn{{u, cross(normal, u), normal}};
  turn_by(turn);
  // Of what is narrow as well, as along an edge, so that this holds for the square of its width, too.
  Mat3 along;
  if (!find_turn_along_narrow(spread_, along)) return turn;
  turn_by(along);
  const Mat3 columns = convex::transposed(turn);
  return convex::transposed({{along * columns.row[0], along * columns.row[1], along * columns.row[2]}});
}

void OverlapSurface::turn_by(const Mat3 &turn) {
  for (Nodes *const side : {&a_, &b_}) {
    side->change_pairs([&](Nodes::Pair &node) { node.at = turn * node.at, node.area = turn * node.area; });
  }
  place_ = turn * place_, middle_ = turn * middle_;
  find_spread();
}

}  // namespace cmb
