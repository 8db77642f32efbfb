#include "manifold/revolved/mantle.hpp"

#include <algorithm>
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
               std::vector<OverlapSurface::Node> &nodes)
    : body_(&body),
      in_common_(in_common),
      nodes_(&nodes),
      axis_(in_common.rotation.column(2)),
      from_place_(in_common.translation - place),
      from_(to_apex ? body.half : std::clamp(-dot(axis_, from_place_), -body.half, body.half)) {
  const GaussNodes heights = heights_of(body, partner);
  part_ = heights.node, weight_ = heights.weight, parts_ = heights.count;
}

void Mantle::add_border_node(const Vec3 &at, const Vec3 &step) {
  const Vec3 way = at - in_common_.translation;
  const double height = dot(axis_, way);
  const Vec3 radial = way - height * axis_;
  const double across2 = norm2(radial);
  if (!(across2 > 0.0)) return;
  add_nodes((1.0 / std::sqrt(across2)) * radial, height, dot(axis_, cross(radial, step)) / across2);
}

void Mantle::add_border_node(const Vec3 &outward, double height, double turn) {
  add_nodes(in_common_.rotation * outward, height, turn);
}

void Mantle::add_nodes(const Vec3 &outward, double height, double turn) {
  const double rise = height - from_;
  for (std::size_t k = 0; k < parts_; ++k) {
    const double z = from_ + part_[k] * rise, r = body_->radius_at(z), part = turn * rise * weight_[k] * r;
    nodes_->push_back({r * outward + z * axis_ + from_place_, part * (outward - body_->slope * axis_)});
  }
}

}  // namespace cmb
