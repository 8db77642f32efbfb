#include "mesh/elastic/elastic_points.hpp"

#include <cmath>

#include "math/symmetric_matrix.hpp"

namespace cmb::mesh {

namespace {

// The solution of matrix * x = right, the matrix raised by a little so that it has one.
Vec3 solve_raised(convex::SymmetricMatrix matrix, const Vec3 &right) {
  matrix.add_to_diagonal(1e-14 * matrix.trace());
  Vec3 x;
  return matrix.solve(right, 0.0, x) ? x : Vec3{};
}

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
// depth. Then what the patches carry takes its place in part.
Wrench pushing(const WedgeEnergy &stored, double radius, const std::vector<LoadPoint> &points) {
  constexpr double least_push = 0.05, most_off = 4.0;  // parts of the patches' load
  const double load = load_of(points);
  const Wrench &wrench = stored.wrench();
  Wrench patches;
  for (const LoadPoint &point : points) patches.add(point.force, point.place);
  const Vec3 force = wrench.force - patches.force, torque = wrench.torque - patches.torque;
  const double own = norm2(patches.force), along = dot(force, patches.force);
  double part = 1.0;
  // Patches that oppose each other need not push together.
  const double least = (least_push - 1.0) * own - (load * load - own);
  if (part * along < least) part = least / along;
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

// Shifts the points so that their torque comes near `torque`, which leaves the sum of forces. share(part) says how far a point of that load
// goes by what the torque asks for; none goes farther than `farthest` in a step. Of points of hardly any load, whose normals differ from all
// others', only a long way does much for the torque, and farther off friction would do there what it does not do at the body.
template <typename Share>
void shift(std::vector<LoadPoint> &points, const Vec3 &torque, double load, double farthest, Share &&share) {
  convex::SymmetricMatrix spread, across;
  const Vec3 center = center_of(points, load);
  for (const LoadPoint &point : points) {
    const double part = norm(point.force);
    if (!(part > 0.0)) continue;
    spread.add_inertia(part, point.place - center);
    across.add_inertia(part * share(part), (1.0 / part) * point.force);
  }
  // Shifting comes first: it counts as far as the points are apart, times this. In several steps what shifts along the surface have to do is
  // done to rounding all the same.
  constexpr double prefer_shift = 20.0;
  constexpr int steps = 6;
  const double reach2 = prefer_shift * spread.trace() / load;
  convex::SymmetricMatrix both = spread;
  both.add(reach2, across);
  for (int step = 0; step < steps; ++step) {
    const Vec3 turn = solve_raised(both, missing_torque(points, torque));
    for (LoadPoint &point : points) {
      const double part = norm(point.force);
      if (!(part > 0.0)) continue;
      const Vec3 way = (reach2 * share(part) / part) * cross(point.force, turn);
      const double length = norm(way);
      point.place = point.place + (length > farthest ? farthest / length : 1.0) * way;
    }
  }
}

// Makes their torque `torque`, which leaves the sum of forces. `radius`: of the body.
void match_torque(std::vector<LoadPoint> &points, const Vec3 &torque, double radius) {
  const double load = load_of(points);
  if (!(load > 0.0)) return;
  constexpr double held = 0.2;  // of the load: a point that carries this goes half the way
  shift(points, torque, load, HUGE_VAL, [load](double part) { return part / (part + held * load); });
  const Vec3 shifted = center_of(points, load);
  convex::SymmetricMatrix inertia;
  for (const LoadPoint &point : points) inertia.add_inertia(norm(point.force), point.place - shifted);
  const Vec3 twist = solve_raised(inertia, missing_torque(points, torque));
  // Normals tilt by half at most, in the mean.
  double tilt2 = 0.0;
  for (const LoadPoint &point : points) tilt2 += norm(point.force) / load * norm2(cross(twist, point.place - shifted));
  const double part = tilt2 > 0.25 ? 0.5 / std::sqrt(tilt2) : 1.0;
  for (LoadPoint &point : points) point.force = point.force + (part * norm(point.force)) * cross(twist, point.place - shifted);
  // What is left is real where loads oppose each other in a tight place: all points together take it, no farther than the body is large.
  if (part < 1.0) shift(points, torque, load, radius, [](double) { return 1.0; });
}

}  // namespace

double append_elastic_points(const WedgeIntegrals &overlap, const WedgeEnergy &stored, const Pose &pose, std::vector<LoadPoint> &points,
                             ContactSet &result) {
  points.clear();
  stored.patches().append(points);
  const double load = load_of(points);
  if (!(load > 0.0)) return 0.0;
  const Wrench wrench = pushing(stored, overlap.radius(), points);
  match_force(points, wrench.force, stored.energy());
  match_torque(points, wrench.torque, overlap.radius());
  double in_points = 0.0;
  for (const LoadPoint &point : points) in_points += 0.5 * norm(point.force) * point.depth;
  // Where the patches as good as vanish, as those of a wall right through the body, they cannot store the energy: on faces, edges and corners
  // of meshes points are up to 2.3 times as deep as the deepest place.
  constexpr double most_deep = 4.0;
  const double deeper = stored.energy() / in_points, most = most_deep * overlap.lowest();
  for (const LoadPoint &point : points) {
    const double force = norm(point.force), depth = std::fmin(deeper * point.depth, most);
    if (!(force > 0.0) || !(depth > 0.0)) continue;
    const Vec3 normal{point.force.x / force, point.force.y / force, point.force.z / force};
    result.points.push_back(
        {depth, force / depth, pose.rotation * normal, pose(overlap.origin() + point.place)});
  }
  result.distance = -overlap.deepest();
  result.normal = pose.rotation * overlap.deepest_normal();
  result.witness = pose(overlap.deepest_place() + (0.5 * overlap.deepest()) * overlap.deepest_normal());
  constexpr double part_by_area = 0.5;  // with more, bodies come to rest between the sides of a wall more often (test_pierced_mesh)
  return part_by_area * load;
}

}  // namespace cmb::mesh
