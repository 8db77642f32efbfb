#include "response/spring_deceleration.hpp"

#include <cmath>

#include "response/point_forces.hpp"

namespace cmb {

namespace {

// I^-1 t by the Cholesky factors of I; nothing where I is 0.
Vec3 angular_acceleration(const double *tensor, const Vec3 &t) {
  if (!(tensor[0] > 0.0)) return {};
  if (tensor[3] == 0.0 && tensor[6] == 0.0 && tensor[7] == 0.0) {  // as of most bodies, and a third of the time
    return {t.x / tensor[0], t.y / tensor[4], t.z / tensor[8]};
  }
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

// The least deceleration of a point by the one its own spring would cause. Springs of other points may lever a point
// into its contact; without this bound the force would jump where the speed of such a point passes zero.
constexpr double least_share = 0.1;

Vec3 spring_force(const ContactPoint &point, double stiffness, double exponent) {
  return (point.weight * stiffness * depth_power(point.depth, exponent)) * point.normal;
}

// Of a body under a torque about its centre of mass, world axes.
Vec3 turning_under(const Vec3 &torque, const Inertia &body) {
  const convex::Mat3 &to_world = *body.to_world;
  return to_world * angular_acceleration(body.tensor, transposed_times(to_world, torque));
}

// Of a body's point under the spring of that point alone.
double deceleration_alone(const ContactPoint &point, double stiffness, double exponent, const Inertia &body) {
  if (body.fixed) return 0.0;
  const Vec3 spring = spring_force(point, stiffness, exponent), arm = point.position - body.center;
  return dot((1.0 / body.mass) * spring + cross(turning_under(cross(arm, spring), body), arm), point.normal);
}

void add_body(const std::vector<ContactPoint> &points, double stiffness, double exponent, const Inertia &body,
              std::vector<double> &deceleration) {
  if (body.fixed) return;
  Vec3 force, torque;
  for (const ContactPoint &p : points) {
    const Vec3 spring = spring_force(p, stiffness, exponent);
    force = force + spring;
    torque = torque + cross(p.position - body.center, spring);
  }
  const Vec3 turning = turning_under(torque, body);
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
  if (points.size() == 1) return;
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double alone =
        deceleration_alone(points[k], stiffness, exponent, a) + deceleration_alone(points[k], stiffness, exponent, b);
    deceleration[k] = std::fmax(deceleration[k], least_share * alone);
  }
}

}  // namespace cmb
