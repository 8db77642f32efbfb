#include "narrowphase/multicontact/unilateral_springs.hpp"

#include <cmath>

namespace cmb::convex {

namespace {

constexpr int most_springs = 32, most_steps = 40, most_halvings = 40;
// A stiffness across the load that holds what no spring does, where directions lie in a plane.
constexpr double loose = 1e-10;

}  // namespace

bool solve_unilateral_springs(const Vec3 &load, const Vec3 *directions, const double *stiffness, int count, double *force) {
  if (count > most_springs) return false;
  // Axes along and across the load, in which a matrix with a spring much stiffer than the others along it is graded.
  const Vec3 across = any_perpendicular(load), aside = cross(load, across);
  Vec3 d[most_springs];
  for (int k = 0; k < count; ++k) d[k] = {dot(directions[k], load), dot(directions[k], across), dot(directions[k], aside)};
  bool pressing[most_springs];
  for (int k = 0; k < count; ++k) pressing[k] = d[k].x > 0.0;
  // Newton's method on the energy, which is convex and quadratic in parts; how it rises at v along a way:
  const auto slope = [&](const Vec3 &v, const Vec3 &way) {
    double sum = loose * (v.y * way.y + v.z * way.z) - way.x;
    for (int k = 0; k < count; ++k) sum += stiffness[k] * std::fmax(0.0, dot(d[k], v)) * dot(d[k], way);
    return sum;
  };
  Vec3 v;
  for (int step = 0; step < most_steps; ++step) {
    double xx = 0.0, xy = 0.0, xz = 0.0, yy = loose, yz = 0.0, zz = loose;
    for (int k = 0; k < count; ++k) {
      if (!pressing[k]) continue;
      const Vec3 s = stiffness[k] * d[k];
      xx += s.x * d[k].x, xy += s.x * d[k].y, xz += s.x * d[k].z;
      yy += s.y * d[k].y, yz += s.y * d[k].z, zz += s.z * d[k].z;
    }
    if (!(xx > 0.0)) return false;
    const double ly = xy / xx, lz = xz / xx, y = yy - ly * xy, mixed = yz - ly * xz;
    if (!(y > 0.0)) return false;
    const double l = mixed / y, z = zz - lz * xz - l * mixed;
    if (!(z > 0.0)) return false;
    const auto solve = [&](const Vec3 &right) {
      const double middle = right.y - ly * right.x;
      Vec3 way;
      way.z = (right.z - lz * right.x - l * middle) / z;
      way.y = middle / y - l * way.z;
      way.x = right.x / xx - ly * way.y - lz * way.z;
      return way;
    };
    Vec3 to = solve({1.0, 0.0, 0.0});
    bool same = true;
    for (int k = 0; k < count; ++k) same = same && (dot(d[k], to) > 0.0) == pressing[k];
    if (same) {
      // What the loose stiffness has taken, too.
      for (int correction = 0; correction < 2; ++correction) {
        Vec3 rest{1.0, 0.0, 0.0};
        for (int k = 0; k < count; ++k) {
          if (pressing[k]) rest = rest - (stiffness[k] * dot(d[k], to)) * d[k];
        }
        to = to + solve(rest);
      }
      for (int k = 0; k < count; ++k) force[k] = pressing[k] ? std::fmax(0.0, stiffness[k] * dot(d[k], to)) : 0.0;
      return true;
    }
    // As far as the energy falls.
    const Vec3 way = to - v;
    double low = 0.0, high = 1.0;
    if (slope(to, way) > 0.0) {
      for (int halving = 0; halving < most_halvings; ++halving) {
        const double middle = 0.5 * (low + high);
        (slope(v + middle * way, way) > 0.0 ? high : low) = middle;
      }
    }
    v = v + high * way;
    for (int k = 0; k < count; ++k) pressing[k] = dot(d[k], v) > 0.0;
  }
  return false;
}

}  // namespace cmb::convex
