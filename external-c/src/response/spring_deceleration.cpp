#include "response/spring_deceleration.hpp"

#include <cmath>

#include "response/point_forces.hpp"

namespace cmb {

namespace {

// I^-1 t by the Cholesky factors of I; nothing where I is 0.
Vec3 angular_acceleration(const double *tensor, const Vec3 &t) {
  if (!(tensor[0] > 0.0)) return {};
  const double l00 = std::sqrt(tensor[0]);
  const double l10 = tensor[3] / l00, l20 = tensor[6] / l00;
  const double l11 = std::sqrt(tensor[4] - l10 * l10);
  const double l21 = (tensor[7] - l20 * l10) / l11;
  const double l22 = std::sqrt(tensor[8] - l20 * l20 - l21 * l21);
  const double x = t.x / l00;
  const double y = (t.y - l10 * x) / l11;
  const double z = (t.z - l20 * x - l21 * y) / l22;
  const double c = z / l22;
  const double b = (y - l21 * c) / l11;
  return {(x - l10 * b - l20 * c) / l00, b, c};
}

void add_body(const std::vector<ContactPoint> &points, double stiffness, double exponent, const Inertia &body,
              std::vector<double> &deceleration) {
  if (body.fixed) return;
  Vec3 force, torque;
  for (const ContactPoint &p : points) {
    const Vec3 spring = (p.weight * stiffness * depth_power(p.depth, exponent)) * p.normal;
    force = force + spring;
    torque = torque + cross(p.position - body.center, spring);
  }
  const convex::Mat3 &to_world = *body.to_world;
  const Vec3 turning = to_world * angular_acceleration(body.tensor, transposed_times(to_world, torque));
  for (std::size_t k = 0; k < points.size(); ++k) {
    const Vec3 acceleration = (1.0 / body.mass) * force + cross(turning, points[k].position - body.center);
    deceleration[k] += dot(acceleration, points[k].normal);
  }
}

}  // namespace

void spring_decelerations(const std::vector<ContactPoint> &points, double stiffness, double exponent, const Inertia &a,
                          const Inertia &b, std::vector<double> &deceleration) {
  deceleration.assign(points.size(), 0.0);
  add_body(points, stiffness, exponent, a, deceleration);
  add_body(points, stiffness, exponent, b, deceleration);
  for (double &value : deceleration) value = std::fmax(value, 0.0);
}

}  // namespace cmb
