#include "c_api/pose_check.hpp"

#include <cmath>
#include <string>

#include "c_api/call_guard.hpp"
#include "math/body_pose.hpp"

namespace cmb {

namespace {

constexpr double rotation_tolerance = 1e-2;
constexpr double farthest_position = 1e12;  // m

bool are_orthonormal(const GivenAxes &axes) {
  for (const double product : {axes.xx - 1.0, axes.yy - 1.0, norm2(axes.z) - 1.0, axes.xy, dot(axes.x, axes.z), dot(axes.y, axes.z)}) {
    if (!(std::fabs(product) <= rotation_tolerance)) return false;
  }
  return true;
}

// What is wrong with a body's pose; null if nothing.
const char *pose_problem(const double *position, const GivenAxes &axes) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(position[i])) return "has a position that is not finite";
    if (std::fabs(position[i]) > farthest_position) return "is farther than 1e12 m from the origin";
  }
  if (!are_orthonormal(axes)) return "has a rotation that is not orthonormal to 1e-2";
  return dot(axes.z, cross(axes.x, axes.y)) > 0.0 ? nullptr : "has a rotation that is a reflection";
}

double sum_of_sizes(double x, double y, double z) { return std::fabs(x) + std::fabs(y) + std::fabs(z); }

// Whether nothing is wrong by far, found with few comparisons; sums are not numbers where a term is not. `z`, perpendicular to
// the first two axes, is the third one then.
bool is_sound(const double *position, const GivenAxes &axes, const convex::Vec3 &z) {
  constexpr double slight = 0.1 * rotation_tolerance;
  return (sum_of_sizes(position[0], position[1], position[2]) <= farthest_position) &
         (sum_of_sizes(axes.xx - 1.0, axes.yy - 1.0, axes.xy) <= slight) &
         (sum_of_sizes(axes.z.x - z.x, axes.z.y - z.y, axes.z.z - z.z) <= slight);
}

cmb_status refuse(std::size_t body, const char *problem) {
  return fail(CMB_ERROR_POSE, "body " + std::to_string(body + 1) + " " + problem +
                                  "; check the initial values, or the step size of the integrator");
}

}  // namespace

cmb_status check_body_pose(std::size_t body, const double *position, const double *rotation) {
  convex::Pose pose;
  return read_body_pose(body, position, rotation, pose);
}

cmb_status read_body_pose(std::size_t body, const double *position, const double *rotation, convex::Pose &pose) {
  const GivenAxes axes(rotation + 9 * body);
  pose = body_pose(position + 3 * body, axes);
  if (is_sound(position + 3 * body, axes, pose.rotation.column(2))) return CMB_OK;
  const char *problem = pose_problem(position + 3 * body, axes);
  return problem == nullptr ? CMB_OK : refuse(body, problem);
}

cmb_status check_poses(const cmb_poses *poses, std::size_t body_count) {
  if (poses == nullptr) return fail(CMB_ERROR_ARGUMENT, "poses is NULL");
  if (poses->body_count != body_count) {
    return fail(CMB_ERROR_ARGUMENT, "poses of " + std::to_string(poses->body_count) + " bodies for a scene of " +
                                        std::to_string(body_count));
  }
  if (body_count > 0 && (poses->position == nullptr || poses->rotation == nullptr)) {
    return fail(CMB_ERROR_ARGUMENT, "position or rotation is NULL");
  }
  return CMB_OK;
}

}  // namespace cmb
