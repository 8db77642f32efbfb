#include "interface/pose_check.hpp"

#include <cmath>
#include <string>

#include "geometry/body_pose.hpp"
#include "interface/call_guard.hpp"

namespace cmb {

namespace {

constexpr double rotation_tolerance = 1e-2;
constexpr double farthest_position = 1e12;  // m

// What is wrong with a body's pose; null if nothing.
const char *pose_problem(const double *position, const GivenAxes &axes) {
  for (int i = 0; i < 3; ++i) {
    if (!(std::fabs(position[i]) <= farthest_position)) {
      return std::isfinite(position[i]) ? "is farther than 1e12 m from the origin" : "has a position that is not finite";
    }
  }
  for (const double product : {axes.xx - 1.0, axes.xy, axes.xz, axes.yy - 1.0, axes.yz, axes.zz - 1.0}) {
    if (!(std::fabs(product) <= rotation_tolerance)) return "has a rotation that is not orthonormal to 1e-2";
  }
  return dot(axes.x, cross(axes.y, axes.z)) > 0.0 ? nullptr : "has a rotation that is a reflection";
}

cmb_status refuse(std::size_t body, const char *problem) {
  return fail(CMB_ERROR_POSE, "body " + std::to_string(body + 1) + " " + problem +
                                  "; check the initial values, or the step size of the integrator");
}

}  // namespace

cmb_status check_body_pose(std::size_t body, const double *position, const double *rotation) {
  const char *problem = pose_problem(position + 3 * body, GivenAxes(rotation + 9 * body));
  return problem == nullptr ? CMB_OK : refuse(body, problem);
}

cmb_status read_body_pose(std::size_t body, const double *position, const double *rotation, convex::Pose &pose) {
  const GivenAxes axes(rotation + 9 * body);
  const char *problem = pose_problem(position + 3 * body, axes);
  if (problem != nullptr) return refuse(body, problem);
  pose = body_pose(position + 3 * body, axes);
  return CMB_OK;
}

}  // namespace cmb
