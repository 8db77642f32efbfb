#include "interface/pose_check.hpp"

#include <cmath>
#include <string>

#include "geometry/body_pose.hpp"
#include "interface/call_guard.hpp"

namespace cmb {

namespace {

constexpr double rotation_tolerance = 1e-2;
constexpr double farthest_position = 1e12;  // m

// What is wrong with a body's pose that is not as it should be.
const char *pose_problem(const double *position, const GivenAxes &axes) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(position[i])) return "has a position that is not finite";
    if (std::fabs(position[i]) > farthest_position) return "is farther than 1e12 m from the origin";
  }
  return axes.are_orthonormal(rotation_tolerance) ? "has a rotation that is a reflection"
                                                  : "has a rotation that is not orthonormal to 1e-2";
}

// Without a branch for each number: they all are as they should be but for a wrong call.
bool is_near(const double *position) {
  return (std::fabs(position[0]) <= farthest_position) & (std::fabs(position[1]) <= farthest_position) &
         (std::fabs(position[2]) <= farthest_position);
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
  // The third axis is the product of the first two.
  if (is_near(position + 3 * body) & axes.are_orthonormal(rotation_tolerance) & (dot(axes.z, pose.rotation.column(2)) > 0.0)) {
    return CMB_OK;
  }
  return refuse(body, pose_problem(position + 3 * body, axes));
}

}  // namespace cmb
