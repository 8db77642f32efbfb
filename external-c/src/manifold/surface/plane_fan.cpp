#include "manifold/surface/plane_fan.hpp"

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
  nodes_->add(apex + (1.0 / 3.0) * (p + q), (0.225 * area) * normal_);
  for (const auto &node : rule) {
    const double far = 1.0 - 2.0 * node.near;
    const Vec3 part = (node.weight * area) * normal_;
    nodes_->add(apex + node.near * (p + q), part);
    nodes_->add(apex + far * p + node.near * q, part);
    nodes_->add(apex + node.near * p + far * q, part);
  }
}

void PlaneFan::add_curve_node(const Vec3 &at, const Vec3 &step) {
  begin(at);
  const Vec3 way = at - apex_, apex = apex_ - place_;
  const double area = dot(normal_, cross(way, step));
  // From the apex on the fan widens linearly: Gauss' rule for that weight (Gauss-Jacobi), exact to the fifth degree, which moments of the
  // mantle's squares are of.
  constexpr struct {
    double part, weight;
  } rule[3] = {{0.212340538239152944, 0.0698269799014541225},
               {0.590533135559265289, 0.229241106359586247},
               {0.911412040487296053, 0.200931913738958963}};
  for (const auto &node : rule) nodes_->add(apex + node.part * way, (node.weight * area) * normal_);
}

}  // namespace cmb
