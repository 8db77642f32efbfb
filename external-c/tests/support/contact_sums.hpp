// What contact points carry together, and bodies moved a little.
#pragma once

#include <vector>

#include "manifold/contact_set.hpp"
#include "poses.hpp"
#include "random_bodies.hpp"

namespace cmb::test {

struct Sums {
  Vec3 force, moment;  // at stiffness 1, the moment about the origin
};

inline Sums sum_of(const std::vector<ContactPoint> &points) {
  Sums sums;
  for (const ContactPoint &p : points) {
    const Vec3 force = p.weight * p.depth * p.normal;
    sums.force = sums.force + force;
    sums.moment = sums.moment + cross(p.position, force);
  }
  return sums;
}

// At exponent 1.
inline double stored_energy(const std::vector<ContactPoint> &points) {
  double energy = 0.0;
  for (const ContactPoint &p : points) energy += 0.5 * p.weight * p.depth * p.depth;
  return energy;
}

inline convex::Pose moved(const convex::Pose &pose, const Vec3 &shift, const Vec3 &turn) {
  const double angle = norm(turn);
  const Mat3 rotation = angle > 0.0 ? random_bodies::rotation_about((1.0 / angle) * turn, angle) : Mat3{};
  return {product(rotation, pose.rotation), pose.translation + shift};
}

}  // namespace cmb::test
