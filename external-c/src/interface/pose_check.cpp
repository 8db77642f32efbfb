#include "interface/pose_check.hpp"

#include <cmath>
#include <string>

#include "interface/call_guard.hpp"

namespace cmb {

namespace {

constexpr double rotation_tolerance = 1e-2;
constexpr double farthest_position = 1e12;  // m

// What is wrong with a body's pose; null if nothing.
const char *pose_problem(const double *position, const double *rotation) {
  for (int i = 0; i < 3; ++i) {
    if (!std::isfinite(position[i])) return "has a position that is not finite";
    if (std::fabs(position[i]) > farthest_position) return "is farther than 1e12 m from the origin";
  }
  for (int i = 0; i < 3; ++i) {
    const double *row = rotation + 3 * i;
    for (int j = i; j < 3; ++j) {
      const double *other = rotation + 3 * j;
      const double product = row[0] * other[0] + row[1] * other[1] + row[2] * other[2] - (i == j ? 1.0 : 0.0);
      if (!(std::fabs(product) <= rotation_tolerance)) return "has a rotation that is not orthonormal to 1e-2";
    }
  }
  const double *r = rotation;
  const double determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
                             r[2] * (r[3] * r[7] - r[4] * r[6]);
  return determinant > 0.0 ? nullptr : "has a rotation that is a reflection";
}

}  // namespace

cmb_status check_body_pose(std::size_t body, const double *position, const double *rotation) {
  const char *problem = pose_problem(position + 3 * body, rotation + 9 * body);
  if (problem == nullptr) return CMB_OK;
  return fail(CMB_ERROR_POSE, "body " + std::to_string(body + 1) + " " + problem +
                                  "; check the initial values, or the step size of the integrator");
}

}  // namespace cmb
