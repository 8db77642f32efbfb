#include <algorithm>
#include <utility>

#include "backend/distance_backend.hpp"
#include "math/pose_algebra.hpp"
#include "narrowphase/analytic/closed_form_distance.hpp"
#include "shape/pair_table.hpp"

namespace cmb {

namespace {

// `if_together` is the normal where the centres coincide.
void between_spheres(double radius_a, const Vec3 &center_a, double radius_b, const Vec3 &center_b,
                     const Vec3 &if_together, SignedDistance &answer) {
  const Vec3 apart = center_a - center_b;
  const double length = norm(apart);
  answer.distance = length - radius_a - radius_b;
  answer.normal = length > 0.0 ? (1.0 / length) * apart : if_together;
  answer.point_a = center_a - radius_a * answer.normal;
  answer.point_b = center_b + radius_b * answer.normal;
  answer.proven = true;
  answer.interior_ball = radius_a + radius_b;
}

// The place of a capsule's axis nearest to p.
Vec3 nearest_on_axis(const Shape &capsule, const Pose &pose, const Vec3 &p) {
  const Vec3 axis = pose.rotation.column(2);
  const double half = capsule.body.half.z;
  return pose.translation + std::clamp(dot(axis, p - pose.translation), -half, half) * axis;
}

// What was found in the frame of A, which is at `frame`.
void set_answer(const convex::SignedDistance &found, const Pose &frame, SignedDistance &answer) {
  answer.distance = found.distance;
  answer.normal = frame.rotation * found.normal;
  answer.point_a = frame(found.point_a);
  answer.point_b = frame(found.point_b);
  answer.proven = found.proven;
  answer.interior_ball = found.interior_ball;
}

void between_capsules(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, SignedDistance &answer) {
  const convex::CoreDistance axes =
      convex::distance_of_segments(pose_a.rotation.column(2), a.body.half.z, pose_b.rotation.column(2), b.body.half.z,
                                   pose_b.translation - pose_a.translation);
  const double radius_a = a.body.radius, radius_b = b.body.radius;
  answer.distance = axes.distance - radius_a - radius_b;
  answer.normal = -axes.direction;
  answer.point_a = pose_a.translation + axes.a + radius_a * axes.direction;
  answer.point_b = pose_a.translation + axes.b - radius_b * axes.direction;
  answer.proven = axes.proven;
  answer.interior_ball = radius_a + radius_b;
}

// Of a shape that has_point_formula, A, and a ball, B; or of the ball and that shape, where `reversed`.
void to_ball(const Shape &a, const Pose &pose_a, double radius_b, const Vec3 &center_b, bool reversed, SignedDistance &answer) {
  const Vec3 center = transposed_times(pose_a.rotation, center_b - pose_a.translation);
  Vec3 direction;
  double distance;
  if (a.kind == ShapeKind::box) {
    distance = convex::box_to_point(a.body.half, center, direction);
  } else {
    const convex::CoreDistance core = convex::distance_of_point(a.body, center);
    distance = core.distance, direction = core.direction;
  }
  // Both points lie on the line through the centre.
  const Vec3 outward = pose_a.rotation * direction;
  const Vec3 of_a = center_b - (distance - a.body.radius) * outward, of_b = center_b - radius_b * outward;
  answer.distance = distance - a.body.radius - radius_b;
  answer.normal = reversed ? outward : -outward;
  answer.point_a = reversed ? of_b : of_a;
  answer.point_b = reversed ? of_a : of_b;
  answer.proven = true;
  answer.interior_ball = a.body.radius + radius_b;
}

}  // namespace

void find_exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b, BackendScratch &scratch,
                         SignedDistance &answer) {
  const PairEntry pair = pair_entry(a, b);
  const Vec3 &center_a = pose_a.translation, &center_b = pose_b.translation;
  switch (pair.method) {
    case PairMethod::sphere_sphere:
      between_spheres(a.body.radius, center_a, b.body.radius, center_b, {0, 0, 1}, answer);
      return;
    case PairMethod::sphere_capsule:
      if (pair.exchanged) {
        between_spheres(a.body.radius, nearest_on_axis(a, pose_a, center_b), b.body.radius, center_b,
                        pose_a.rotation.column(0), answer);
      } else {
        between_spheres(a.body.radius, center_a, b.body.radius, nearest_on_axis(b, pose_b, center_a),
                        pose_b.rotation.column(0), answer);
      }
      return;
    case PairMethod::capsule_capsule: between_capsules(a, pose_a, b, pose_b, answer); return;
    case PairMethod::sphere_core:
      if (pair.exchanged) {
        to_ball(a, pose_a, b.body.radius, center_b, false, answer);
      } else {
        to_ball(b, pose_b, a.body.radius, center_a, true, answer);
      }
      return;
    default: break;
  }
  const convex::SignedDistance found =
      convex::signed_distance(a.body, b.body, relative_pose(pose_a, pose_b), scratch.distance);
  set_answer(found, pose_a, answer);
}

SignedDistance exact_distance(const Shape &a, const Pose &pose_a, const Shape &b, const Pose &pose_b,
                            BackendScratch &scratch) {
  SignedDistance answer;
  find_exact_distance(a, pose_a, b, pose_b, scratch, answer);
  return answer;
}

}  // namespace cmb
