#include "manifold/revolved/mantle.hpp"

#include <algorithm>
#include <cmath>

#include "math/gauss_rule.hpp"

namespace cmb {

Mantle::Mantle(const RevolvedBody &body, const Pose &in_common, const Vec3 &place, std::vector<OverlapSurface::Node> &nodes)
    : body_(&body),
      in_common_(in_common),
      nodes_(&nodes),
      place_(transposed_times(in_common.rotation, place - in_common.translation)),
      from_(std::clamp(place_.z, -body.half, body.half)) {}

void Mantle::add_border_node(const Vec3 &at, const Vec3 &step) {
  const Vec3 p = transposed_times(in_common_.rotation, at - in_common_.translation), way = transposed_times(in_common_.rotation, step);
  const double across2 = p.x * p.x + p.y * p.y, across = std::sqrt(across2);
  if (!(across > 0.0)) return;
  add_border_node({p.x / across, p.y / across, 0.0}, p.z, (p.x * way.y - p.y * way.x) / across2);
}

void Mantle::add_border_node(const Vec3 &outward, double height, double turn) {
  using overlap::GaussNodes;
  const double rise = height - from_;
  const GaussNodes heights = body_->is_cylinder() ? GaussNodes(overlap::gauss_rule<3>) : GaussNodes(overlap::gauss_rule<4>);
  for (std::size_t k = 0; k < heights.count; ++k) {
    const double z = from_ + heights.node[k] * rise, r = body_->radius_at(z), part = turn * rise * heights.weight[k] * r;
    const Vec3 at{r * outward.x - place_.x, r * outward.y - place_.y, z - place_.z};
    const Vec3 area{part * outward.x, part * outward.y, -part * body_->slope};
    nodes_->push_back({in_common_.rotation * at, in_common_.rotation * area});
  }
}

}  // namespace cmb
