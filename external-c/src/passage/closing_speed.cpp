#include "passage/closing_speed.hpp"

#include <cmath>

namespace cmb {

namespace {

bool is_lone_plane(const BodyShapes &shapes) { return shapes.size() == 1 && shapes[0].kind == ShapeKind::halfspace; }

bool rests(const BodyMotion &motion) {
  return norm2(motion.velocity) == 0.0 && norm2(motion.angular_velocity) == 0.0;
}

Vec3 center_velocity(const TurningReach &reach, const BodyMotion &motion) {
  return motion.velocity + cross(motion.angular_velocity, motion.pose.rotation * reach.center);
}

// How fast turning moves points of the body; `room` stands for the radius of what has none.
double turning_speed(const TurningReach &reach, const BodyMotion &motion, double room) {
  const Vec3 &w = motion.angular_velocity;
  if (norm2(w) == 0.0) return 0.0;
  const double rate = reach.has_axis ? norm(cross(w, motion.pose.rotation * reach.axis)) : norm(w);
  return rate * (std::isfinite(reach.radius) ? reach.radius : room);
}

// Over a plane at rest heights alone count: neither sliding nor turning about its normal changes them.
ClosingSpeed over_plane(const Shape &plane, const BodyMotion &at, const TurningReach &reach, const BodyMotion &motion) {
  const Vec3 normal = at.pose.rotation * plane.in_body.rotation.column(2);
  const Vec3 velocity = center_velocity(reach, motion);
  const double turning = reach.has_axis ? turning_speed(reach, motion, 0.0) : HUGE_VAL;
  const double tilting = norm(cross(motion.angular_velocity, normal));
  const double by_tilt = tilting == 0.0 || reach.radius == 0.0 ? 0.0 : tilting * reach.radius;
  return {velocity, std::fabs(dot(velocity, normal)) + std::fmin(turning, by_tilt)};
}

}  // namespace

TurningReach turning_reach(const Scene &scene, std::size_t body) {
  const BodyShapes &shapes = scene.bodies[body];
  const BodyBounds &bounds = scene.bounds[body];
  if (shapes.size() != 1 || shapes[0].kind == ShapeKind::halfspace) return {bounds.center, {}, bounds.radius, false};
  const Shape &shape = shapes[0];
  const Vec3 center = shape.in_body(shape.bound_center), axis = shape.in_body.rotation.column(2);
  switch (shape.kind) {
    case ShapeKind::sphere: return {center, axis, 0.0, false};
    case ShapeKind::capsule:
    case ShapeKind::cylinder:
    case ShapeKind::cone: return {center, axis, shape.bound_radius, true};
    default: return {center, axis, shape.bound_radius, false};
  }
}

ClosingSpeed closing_speed(const Scene &scene, std::size_t a, const TurningReach &reach_a, const BodyMotion &motion_a,
                           std::size_t b, const TurningReach &reach_b, const BodyMotion &motion_b) {
  if (is_lone_plane(scene.bodies[b]) && rests(motion_b)) return over_plane(scene.bodies[b][0], motion_b, reach_a, motion_a);
  if (is_lone_plane(scene.bodies[a]) && rests(motion_a)) return over_plane(scene.bodies[a][0], motion_a, reach_b, motion_b);
  const Vec3 velocity = center_velocity(reach_a, motion_a) - center_velocity(reach_b, motion_b);
  const double apart = norm(motion_a.pose(reach_a.center) - motion_b.pose(reach_b.center));
  return {velocity, norm(velocity) + turning_speed(reach_a, motion_a, apart + reach_b.radius) +
                        turning_speed(reach_b, motion_b, apart + reach_a.radius)};
}

}  // namespace cmb
