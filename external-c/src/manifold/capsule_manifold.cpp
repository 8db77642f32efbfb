#include "manifold/capsule_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/axis_share.hpp"

namespace cmb {

bool capsule_on_capsule(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, const ConvexAnswer &answer,
                        std::vector<ContactPoint> &points) {
  const double radius[2] = {a.body.radius, b.body.radius}, half[2] = {a.body.half.z, b.body.half.z};
  const double reach = radius[0] + radius[1], depth = -answer.distance, apart = reach - depth;
  if (!(apart > 1e-9 * reach)) return false;
  const Vec3 axis[2] = {pose_a.rotation.column(2), pose_b.rotation.column(2)};
  const Vec3 &normal = answer.normal, between = pose_b.translation - pose_a.translation;
  const double cosine = dot(axis[0], axis[1]);
  // The axes' places where they are nearest, and the gap there along each axis, which is 0 but at an end.
  const double at[2] = {dot(answer.point_a - pose_a.translation, axis[0]) + radius[0] * dot(normal, axis[0]),
                        dot(answer.point_b - pose_b.translation, axis[1]) - radius[1] * dot(normal, axis[1])};
  const double lean[2] = {dot(normal, axis[0]), -dot(normal, axis[1])};
  const double foot[2] = {dot(between, axis[0]), -dot(between, axis[1])};  // of the other's middle
  // A station on an axis, `way` from the nearest place, and the place opposite it on the other axis.
  struct Place {
    double way, opposite, gap;
  };
  const auto place = [&](int own, double way) {
    const int other = 1 - own;
    const double opposite = std::clamp((at[own] + way) * cosine + foot[other], -half[other], half[other]) - at[other];
    const double gap2 = apart * apart + way * way + opposite * opposite - 2.0 * way * opposite * cosine +
                        2.0 * apart * (way * lean[own] + opposite * lean[other]);
    return Place{way, opposite, std::sqrt(gap2)};
  };
  // Of both axes in turn, the stations before and beyond the nearest place: the farther foot of the other's ends, or the end.
  Place next[4];
  double end[4];
  for (int k = 0; k < 4; ++k) {
    const int own = k / 2;
    const double sense = k % 2 == 0 ? -1.0 : 1.0;
    end[k] = half[own] - sense * at[own];
    const double foot_of_end = sense * (foot[own] - at[own]) + std::fabs(cosine) * half[1 - own];
    const double way = std::min(foot_of_end > station_spacing * half[own] ? foot_of_end : end[k], end[k]);
    next[k] = place(own, sense * way);
  }
  const Vec3 witness = 0.5 * (answer.point_a + answer.point_b);
  for (int own = 0; own < 2; ++own) {
    const double spacing = station_spacing * half[own];
    const std::size_t first = points.size();
    const auto add = [&](const Place &p, double weight) {
      const double way_a = own == 0 ? p.way : p.opposite, way_b = own == 0 ? p.opposite : p.way;
      const Vec3 there = (1.0 / p.gap) * (apart * normal + way_a * axis[0] - way_b * axis[1]);
      const Vec3 on_a = answer.point_a + radius[0] * (normal - there) + way_a * axis[0];
      const Vec3 on_b = answer.point_b - radius[1] * (normal - there) + way_b * axis[1];
      points.push_back({reach - p.gap, 0.5 * weight, there, 0.5 * (on_a + on_b)});
      return weight * (reach - p.gap);
    };
    // The part of the inclinations under which the inner of two stations is deeper; each side's, and what its change misses.
    double inner[2], load = 0.0, missing = 0.0;
    for (int side = 0; side < 2; ++side) {
      const int k = 2 * own + side;
      const double sense = side == 0 ? -1.0 : 1.0, aside = sense * next[k].way;
      const double rise = std::min(1.0, (next[k].gap - apart) / std::max(aside, spacing));
      const double sine = aside > spacing ? rise : 1.0;  // nothing further on is never deeper
      const double outer = std::max(0.0, reach - next[k].gap);
      inner[side] = 0.5 * (1.0 + end_share_difference(sine));
      missing += 0.25 * sense * end_share_slope(sine) * (outer * outer - depth * depth);
      if (!(outer > 0.0) || !(aside > spacing)) continue;
      double beyond = 1.0;
      if (end[k] - aside > spacing) {
        const Place last = place(own, sense * end[k]);
        const double rest = std::max(0.0, reach - last.gap);
        const double steeper = std::min(1.0, (last.gap - next[k].gap) / (end[k] - aside));
        beyond = std::max(inner[side], 0.5 * (1.0 + end_share_difference(steeper)));
        missing += 0.25 * sense * end_share_slope(steeper) * (rest * rest - outer * outer);
        if (rest > 0.0 && beyond < 1.0) load += add(last, 1.0 - beyond);
      }
      if (beyond > inner[side]) load += add(next[k], beyond - inner[side]);
    }
    // Shares that change with the inclination alone ask for a torque; a shift along the axis supplies it.
    const double weight = inner[0] + inner[1] - 1.0;
    if (weight > 0.0) {
      load += weight * depth;
      ContactPoint &point = points.emplace_back();
      point.depth = depth;
      point.weight = 0.5 * weight;
      point.normal = normal;
      point.position = witness + (missing / load) * (axis[own] - dot(axis[own], normal) * normal);
    }
    const std::size_t outer_end = points.size() - (weight > 0.0 ? 1 : 0);
    for (std::size_t i = first; i < outer_end; ++i) {
      ContactPoint &point = points[i];
      point.position = point.position + (missing / load) * (axis[own] - dot(axis[own], point.normal) * point.normal);
    }
  }
  return true;
}

}  // namespace cmb
