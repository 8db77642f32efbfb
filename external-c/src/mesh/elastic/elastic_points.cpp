#include "mesh/elastic/elastic_points.hpp"

#include <cmath>

namespace cmb::mesh {

namespace {

// A symmetric matrix that is summed up: xx, yy, zz, yz, zx, xy.
struct Symmetric {
  double m[6] = {};

  // part * (|r|^2 - r r^T)
  void add_inertia(double part, const Vec3 &r) {
    const double r2 = norm2(r);
    for (int k = 0; k < 3; ++k) {
      m[k] += part * (r2 - r[k] * r[k]);
      m[3 + k] -= part * r[(k + 1) % 3] * r[(k + 2) % 3];
    }
  }
  double trace() const { return m[0] + m[1] + m[2]; }

  // The solution of matrix * x = right, the matrix raised by a little so that it has one.
  Vec3 solve(const Vec3 &right) const {
    const double raise = 1e-14 * trace();
    const double xx = m[0] + raise, yy = m[1] + raise, zz = m[2] + raise;
    const Vec3 a{yy * zz - m[3] * m[3], m[4] * m[3] - m[5] * zz, m[5] * m[3] - m[4] * yy};
    const double determinant = xx * a.x + m[5] * a.y + m[4] * a.z;
    if (!(determinant > 0.0)) return {};
    const Vec3 b{a.y, xx * zz - m[4] * m[4], m[4] * m[5] - xx * m[3]};
    const Vec3 c{a.z, b.z, xx * yy - m[5] * m[5]};
    return {dot(a, right) / determinant, dot(b, right) / determinant, dot(c, right) / determinant};
  }
};

double load_of(const std::vector<LoadPoint> &points) {
  double load = 0.0;
  for (const LoadPoint &point : points) load += norm(point.force);
  return load;
}

Vec3 missing_torque(const std::vector<LoadPoint> &points, const Vec3 &torque) {
  Vec3 missing = torque;
  for (const LoadPoint &point : points) missing = missing - cross(point.place, point.force);
  return missing;
}

// The overlap's wrench as far as it does not pull: where a wide shallow contact has joined a narrow deep one the energy falls with
// depth. Then, and where depths are rounding, what the patches carry takes its place in part.
Wrench pushing(const Wrench &wrench, const std::vector<LoadPoint> &points, double radius) {
  constexpr double least_push = 0.05, most_off = 4.0;  // parts of the patches' load
  const double load = load_of(points);
  Wrench patches;
  for (const LoadPoint &point : points) patches.add(point.force, point.place);
  const Vec3 force = wrench.force - patches.force, torque = wrench.torque - patches.torque;
  const double own = norm2(patches.force), along = dot(force, patches.force);
  double part = 1.0;
  // Patches that oppose each other need not push together.
  const double least = (least_push - 1.0) * own - (load * load - own);
  if (along < least) part = least / along;
  const double off = norm(force) + norm(torque) / radius;
  if (part * off > most_off * load) part = most_off * load / off;
  return {patches.force + part * force, patches.torque + part * torque};
}

// Makes the forces sum to `force`.
void match_force(std::vector<LoadPoint> &points, const Vec3 &force, double energy) {
  const double load = load_of(points);
  Vec3 sum;
  double stored = 0.0;
  for (const LoadPoint &point : points) {
    sum = sum + point.force;
    stored += 0.5 * norm(point.force) * point.depth;
  }
  // Along one normal the force tells the scale, where forces oppose each other the energy.
  const double scale = (dot(force, sum) + energy / stored * std::fmax(0.0, load * load - norm2(sum))) / (load * load);
  const Vec3 rest = (1.0 / load) * (force - scale * sum);
  for (LoadPoint &point : points) point.force = scale * point.force + norm(point.force) * rest;
}

Vec3 center_of(const std::vector<LoadPoint> &points, double load) {
  Vec3 center;
  for (const LoadPoint &point : points) center = center + (norm(point.force) / load) * point.place;
  return center;
}

// Makes their torque `torque`, which leaves the sum of forces.
void match_torque(std::vector<LoadPoint> &points, const Vec3 &torque) {
  const double load = load_of(points);
  if (!(load > 0.0)) return;
  Symmetric spread, across;
  const Vec3 center = center_of(points, load);
  for (const LoadPoint &point : points) {
    const double part = norm(point.force);
    if (!(part > 0.0)) continue;
    spread.add_inertia(part, point.place - center);
    across.add_inertia(part, (1.0 / part) * point.force);
  }
  // Shifting comes first: it counts as far as the points are apart, times this.
  constexpr double prefer_shift = 1e6;
  const double reach2 = prefer_shift * spread.trace() / load;
  Symmetric both = spread;
  for (int k = 0; k < 6; ++k) both.m[k] += reach2 * across.m[k];
  const Vec3 turn = both.solve(missing_torque(points, torque));
  for (LoadPoint &point : points) {
    const double part = norm(point.force);
    if (part > 0.0) point.place = point.place + reach2 / part * cross(point.force, turn);
  }
  const Vec3 shifted = center_of(points, load);
  Symmetric inertia;
  for (const LoadPoint &point : points) inertia.add_inertia(norm(point.force), point.place - shifted);
  const Vec3 twist = inertia.solve(missing_torque(points, torque));
  // Normals tilt by half at most: more is rounding.
  double most = 0.0;
  for (const LoadPoint &point : points) most = std::fmax(most, norm2(cross(twist, point.place - shifted)));
  const double part = most > 0.25 ? 0.5 / std::sqrt(most) : 1.0;
  for (LoadPoint &point : points) point.force = point.force + (part * norm(point.force)) * cross(twist, point.place - shifted);
}

}  // namespace

double append_elastic_points(const WedgeOverlap &overlap, const Pose &pose, std::vector<LoadPoint> &points, ContactSet &result) {
  points.clear();
  overlap.patches().append(points);
  const double load = load_of(points);
  if (!(load > 0.0)) return 0.0;
  const Wrench wrench = pushing(overlap.wrench(), points, overlap.radius());
  match_force(points, wrench.force, overlap.energy());
  match_torque(points, wrench.torque);
  double stored = 0.0;
  for (const LoadPoint &point : points) stored += 0.5 * norm(point.force) * point.depth;
  const double deeper = overlap.energy() / stored;
  for (const LoadPoint &point : points) {
    const double force = norm(point.force), depth = deeper * point.depth;
    if (!(force > 0.0) || !(depth > 0.0)) continue;
    const Vec3 normal{point.force.x / force, point.force.y / force, point.force.z / force};
    result.points.push_back(
        {depth, force / depth, pose.rotation * normal, pose(overlap.patches().origin() + point.place)});
  }
  result.distance = -overlap.deepest();
  result.normal = pose.rotation * overlap.deepest_normal();
  result.witness = pose(overlap.deepest_place() + (0.5 * overlap.deepest()) * overlap.deepest_normal());
  return load;
}

}  // namespace cmb::mesh
