#include "manifold/revolved/mantle.hpp"

#include <cmath>

#include "math/gauss_rule.hpp"

namespace cmb {

namespace {

using overlap::gauss_rule;
using overlap::GaussNodes;

GaussNodes heights_of(const RevolvedBody &body, Mantle::Partner partner) {
  if (partner == Mantle::Partner::polytope) return body.is_cylinder() ? GaussNodes(gauss_rule<2>) : GaussNodes(gauss_rule<3>);
  return body.is_cylinder() ? GaussNodes(gauss_rule<3>) : GaussNodes(gauss_rule<4>);
}

}  // namespace

Mantle::Mantle(const RevolvedBody &body, const Pose &in_common, const Vec3 &place, bool to_apex, Partner partner,
               std::vector<BorderPlace> &border, std::vector<OverlapSurface::Node> &nodes)
    : body_(&body),
      in_common_(in_common),
      border_(&border),
      nodes_(&nodes),
      axis_(in_common.rotation.column(2)),
      from_place_(in_common.translation - place),
      to_apex_(to_apex),
      partner_(partner) {
  border.clear();
}

void Mantle::add_border_place(const Vec3 &outward, double height, double turn) { border_->push_back({outward, height, turn}); }

void Mantle::integrate() {
  const GaussNodes heights = heights_of(*body_, partner_);  // between the border and where heights count from
  double sum = 0.0, whole = 0.0;
  for (const BorderPlace &place : *border_) {
    const double part = std::fabs(place.turn);
    sum += part * place.height, whole += part;
  }
  if (!(whole > 0.0)) return;
  const double from = to_apex_ ? body_->half : sum / whole;
  for (const BorderPlace &place : *border_) {
    const double rise = place.height - from;
    const Vec3 outward = in_common_.rotation * place.outward;
    for (std::size_t k = 0; k < heights.count; ++k) {
      const double z = from + heights.node[k] * rise, r = body_->radius_at(z), part = place.turn * rise * heights.weight[k] * r;
      nodes_->push_back({r * outward + z * axis_ + from_place_, part * (outward - body_->slope * axis_)});
    }
  }
}

}  // namespace cmb
