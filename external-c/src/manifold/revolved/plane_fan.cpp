#include "manifold/revolved/plane_fan.hpp"

#include "math/gauss_rule.hpp"

namespace cmb {

// A triangle of the fan, by the rule of seven places that is exact to the fifth degree (Radon 1948).
void PlaneFan::add_segment(const Vec3 &from, const Vec3 &to) {
  begin(from);
  const Vec3 p = from - apex_, q = to - apex_, apex = apex_ - place_;
  const double area = 0.5 * dot(normal_, cross(p, q));
  if (area == 0.0) return;
  constexpr struct {
    double weight, near;
  } rule[2] = {{0.125939180544827153, 0.101286507323456339}, {0.132394152788506181, 0.470142064105115090}};
  nodes_->push_back({apex + (1.0 / 3.0) * (p + q), (0.225 * area) * normal_});
  for (const auto &node : rule) {
    const double far = 1.0 - 2.0 * node.near;
    const Vec3 part = (node.weight * area) * normal_;
    nodes_->push_back({apex + node.near * (p + q), part});
    nodes_->push_back({apex + far * p + node.near * q, part});
    nodes_->push_back({apex + node.near * p + far * q, part});
  }
}

void PlaneFan::add_curve_node(const Vec3 &at, const Vec3 &step) {
  begin(at);
  const Vec3 way = at - apex_, apex = apex_ - place_;
  const double area = dot(normal_, cross(way, step));
  // Moments of the mantle's squares are of the fifth degree, and the fan adds one.
  const auto &rule = overlap::gauss_rule<4>;
  for (std::size_t k = 0; k < 4; ++k) {
    const double part = rule.node[k];
    nodes_->push_back({apex + part * way, (rule.weight[k] * part * area) * normal_});
  }
}

}  // namespace cmb
