// Loads that push in many directions, as few points.
#pragma once

#include <cmath>
#include <cstddef>

#include "manifold/contact_set.hpp"

namespace cmb::mesh {

// Sums of loads by the six directions of the axes, to which a load gives the squares of its normal's components (they sum to
// 1): they change continuously with the loads. Each becomes one point with the sum of their forces, at the place that keeps
// their moment (but for what turns about the force). Places are relative to a centre of the caller's.
class DirectionSums {
 public:
  static constexpr std::size_t directions = 6;

  // `load`, `energy`: integrals of depth and depth squared; `moment`: of depth times the place, which lies `depth` behind
  // the surface that pushes along the unit `normal`.
  void add(double load, double energy, const Vec3 &moment, const Vec3 &normal) {
    for (int axis = 0; axis < 3; ++axis) {
      const double component = normal[axis], part = component * component;
      if (!(part > 0.0)) continue;
      Sum &sum = sums_[2 * axis + (component > 0.0 ? 1 : 0)];
      sum.load += part * load;
      sum.energy += part * energy;
      sum.moment = sum.moment + part * moment;
      sum.force = sum.force + (part * load) * normal;
      sum.torque = sum.torque + part * cross(moment, normal);
    }
  }

  // The direction's point with its load multiplied by `scale`; false where nothing pushes. In the frame of the sums.
  bool point(std::size_t direction, const Vec3 &center, double scale, ContactPoint &result) const {
    const Sum &sum = sums_[direction];
    // By parts of the greatest component: squares of loads of bodies that hardly touch would underflow.
    const double greatest = std::fmax(std::fabs(sum.force.x), std::fmax(std::fabs(sum.force.y), std::fabs(sum.force.z)));
    if (!(sum.load > 0.0) || !(greatest > 0.0)) return false;
    const double depth = sum.energy / sum.load;
    if (!(depth > 0.0)) return false;
    const Vec3 parts{sum.force.x / greatest, sum.force.y / greatest, sum.force.z / greatest};
    const double length = norm(parts), force = greatest * length;
    const Vec3 normal{parts.x / length, parts.y / length, parts.z / length};
    const Vec3 middle{sum.moment.x / sum.load, sum.moment.y / sum.load, sum.moment.z / sum.load};
    const Vec3 rest = sum.torque - cross(middle, sum.force);
    const Vec3 aside = cross(normal, {rest.x / force, rest.y / force, rest.z / force});
    const Vec3 place = center + middle + aside + (0.5 * depth) * normal;
    result = {depth, scale * force / depth, normal, place};
    return result.weight > 0.0;
  }

 private:
  struct Sum {
    double load = 0.0, energy = 0.0;
    Vec3 moment, force, torque;
  };
  Sum sums_[directions];
};

}  // namespace cmb::mesh
