#include "manifold/load_points.hpp"

#include <cmath>

#include "math/tetrahedron.hpp"

namespace cmb {

namespace {

constexpr int count = convex::tetrahedron_corner_count;
constexpr auto &corners = convex::tetrahedron_corners;

// A symmetric matrix of two rows, and a vector, in the plane perpendicular to the load.
struct Plane2 {
  double u = 0.0, v = 0.0;
};
struct Spread2 {
  double uu = 0.0, vv = 0.0, uv = 0.0;

  void add_square(const Plane2 &p) { uu += p.u * p.u, vv += p.v * p.v, uv += p.u * p.v; }
  Plane2 operator*(const Plane2 &p) const { return {uu * p.u + uv * p.v, uv * p.u + vv * p.v}; }
  // Positive semidefinite.
  Spread2 root() const {
    const double determinant = uu * vv - uv * uv, part = std::sqrt(determinant > 0.0 ? determinant : 0.0);
    const double trace = uu + vv + 2.0 * part;
    const double scale = trace > 0.0 ? 1.0 / std::sqrt(trace) : 0.0;
    return {scale * (uu + part), scale * (vv + part), scale * uv};
  }
  // What this one times is `right`; the matrix raised by a little so that it has one.
  Plane2 solve(const Plane2 &right) const {
    const double raise = 1e-12 * (uu + vv), a = uu + raise, b = vv + raise, determinant = a * b - uv * uv;
    if (!(determinant > 0.0)) return {};
    return {(b * right.u - uv * right.v) / determinant, (a * right.v - uv * right.u) / determinant};
  }
};

double deviation2_along(const convex::SymmetricMatrix &matrix, const Vec3 &way) {
  const double square = dot(way, convex::times(matrix, way));
  return square > 0.0 ? square : 0.0;
}

Spread2 spread_across(const convex::SymmetricMatrix &matrix, const Vec3 &u, const Vec3 &v) {
  const double(&spread)[6] = matrix.m;
  const auto form = [&spread](const Vec3 &p, const Vec3 &q) {
    return spread[0] * p.x * q.x + spread[1] * p.y * q.y + spread[2] * p.z * q.z + spread[3] * (p.y * q.z + p.z * q.y) +
           spread[4] * (p.z * q.x + p.x * q.z) + spread[5] * (p.x * q.y + p.y * q.x);
  };
  return {form(u, u), form(v, v), form(u, v)};
}

}  // namespace

bool append_load_points(const OverlapLoad &load, const Pose &axes, const convex::Mat3 &corner_axes, double sense,
                        std::vector<ContactPoint> &points) {
  const double size2 = norm2(load.force), size = std::sqrt(size2), energy = load.energy;
  if (!(size > 0.0) || !(energy > 0.0)) return false;
  const Vec3 along = (1.0 / size) * load.force, u = convex::any_perpendicular(along), v = cross(along, u);
  // The load's place, from the overlap's middle. Where the depth changes linearly over a surface, the place is three times as far from
  // that surface's middle as the overlap's middle is: there are the points, spread as corners of a rectangle.
  const Vec3 lever = (1.0 / size2) * cross(load.force, load.torque);
  const Plane2 place{dot(lever, u), dot(lever, v)}, half{0.5 * place.u, 0.5 * place.v};
  Spread2 surface = spread_across(load.spread, u, v);
  surface.add_square(half);
  surface.uu *= 3.0, surface.vv *= 3.0, surface.uv *= 3.0;
  const Spread2 root = surface.root();
  const Plane2 tilt = surface.solve({1.5 * place.u, 1.5 * place.v});
  Plane2 ways[count];
  double leans[count], most = 1.0;
  for (int k = 0; k < count; ++k) {
    const Vec3 corner = corner_axes * Vec3{corners[k][0], corners[k][1], corners[k][2]};
    ways[k] = root * Plane2{dot(corner, u), dot(corner, v)};
    leans[k] = tilt.u * ways[k].u + tilt.v * ways[k].v;
    most = -leans[k] > most ? -leans[k] : most;
  }
  // Loads are not negative: rather the points come nearer to the load.
  double shares[count], sum = 0.0, inertia = 0.0;
  Plane2 center;
  for (int k = 0; k < count; ++k) {
    shares[k] = (1.0 + leans[k] / most) / count;
    center.u += shares[k] * ways[k].u, center.v += shares[k] * ways[k].v;
  }
  Plane2 arms[count];
  for (int k = 0; k < count; ++k) {
    arms[k] = {ways[k].u - center.u, ways[k].v - center.v};
    inertia += shares[k] * (arms[k].u * arms[k].u + arms[k].v * arms[k].v);
  }
  // Loads by share: the load's direction, turned about it by what the twist asks for.
  const double twist = inertia > 0.0 ? dot(along, load.torque) / (size * inertia) : 0.0;
  double lengths[count];
  for (int k = 0; k < count; ++k) {
    lengths[k] = std::sqrt(1.0 + twist * twist * (arms[k].u * arms[k].u + arms[k].v * arms[k].v));
    sum += shares[k] * lengths[k];
  }
  // All are as deep as stores the energy; where bodies are that deep in each other that nothing pushes much, no deeper than this, or than the
  // overlap, which thin borders across each other are many times as soft as it is deep.
  constexpr double deepest = 4.0, deviations = 6.0;  // a pyramid is as high as five standard deviations
  const double stores = 2.0 * energy / (size * sum);
  const double most_deep = std::fmax(deepest * std::sqrt(2.0 * energy), deviations * std::sqrt(deviation2_along(load.spread, along)));
  const double depth = stores < most_deep ? stores : most_deep, by_share = size / depth;
  const Vec3 at = axes(load.middle + lever);
  const Vec3 world_along = axes.rotation * along, world_u = axes.rotation * u, world_v = axes.rotation * v;
  for (int k = 0; k < count; ++k) {
    if (!(shares[k] > 0.0)) continue;
    const Plane2 &arm = arms[k];
    const double part = 1.0 / lengths[k], turn = twist * part;
    const Vec3 direction = sense * (part * world_along + (turn * arm.u) * world_v - (turn * arm.v) * world_u);
    const Vec3 position = at + arm.u * world_u + arm.v * world_v;
    ContactPoint &point = points.emplace_back();  // written member by member, which does not wait for a copy
    point.depth = depth, point.weight = by_share * shares[k] * lengths[k];
    point.normal.x = direction.x, point.normal.y = direction.y, point.normal.z = direction.z;
    point.position.x = position.x, point.position.y = position.y, point.position.z = position.z;
  }
  return true;
}

}  // namespace cmb
