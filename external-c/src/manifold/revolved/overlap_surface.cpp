#include "manifold/revolved/overlap_surface.hpp"

#include <cmath>

namespace cmb {

// The integral of a homogeneous polynomial of degree k over the cones from the origin to the surface's parts is place . area times its
// value there, by k + 3. From a place in the overlap no part is negative, so that nothing cancels.
bool OverlapSurface::find_middle() {
  double volume = 0.0;
  Vec3 first;
  for (const std::vector<Node> *const side : {&a_, &b_}) {
    for (const Node &node : *side) {
      const double part = dot(node.at, node.area);
      volume += part;
      first = first + part * node.at;
    }
  }
  if (!(volume > 0.0)) return false;
  volume_ = volume / 3.0;
  middle_ = (3.0 / (4.0 * volume)) * first;
  return true;
}

bool OverlapSurface::is_closed() const {
  constexpr double gap = 1e-5;  // by all of the surface
  Vec3 open;
  double whole = 0.0;
  for (const std::vector<Node> *const side : {&a_, &b_}) {
    for (const Node &node : *side) {
      open = open + node.area;
      whole += norm(node.area);
    }
  }
  return whole > 0.0 && norm(open) <= gap * whole;
}

bool OverlapSurface::sum() {
  if (!is_closed() || !find_middle()) return false;
  const auto shift = [&](std::vector<Node> &side) {
    double whole = 0.0;
    for (Node &node : side) {
      whole += norm(node.area);
      node.at = node.at - middle_;
    }
    return whole;
  };
  area_[0] = shift(a_), area_[1] = shift(b_);
  place_ = place_ + middle_;
  if (!find_middle()) return false;
  convex::SymmetricMatrix second;
  for (const std::vector<Node> *const side : {&a_, &b_}) {
    for (const Node &node : *side) second.add_square(dot(node.at, node.area), node.at);
  }
  spread_ = {};
  spread_.add(1.0 / (5.0 * volume_), second);
  spread_.add_square(-1.0, middle_);
  return spread_.m[0] > 0.0 && spread_.m[1] > 0.0 && spread_.m[2] > 0.0;
}

}  // namespace cmb
