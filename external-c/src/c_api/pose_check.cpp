#include "c_api/pose_check.hpp"

#include <cmath>
#include <string>

#include "c_api/call_guard.hpp"
#include "math/body_pose.hpp"
#include "math/lanes.hpp"

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

constexpr double slight = 0.1 * rotation_tolerance;

convex::Lanes sizes(const convex::LaneVec3 &v) { return convex::magnitude(v.x) + convex::magnitude(v.y) + convex::magnitude(v.z); }

double sum_of_sizes(double x, double y, double z) { return std::fabs(x) + std::fabs(y) + std::fabs(z); }

// Whether nothing is wrong by far, found with few comparisons; sums are not numbers where a term is not. `z`, perpendicular to
// the first two axes, is the third one then.
bool is_sound(const double *position, const GivenAxes &axes, const convex::Vec3 &z) {
  return (sum_of_sizes(position[0], position[1], position[2]) <= farthest_position) &
         (sum_of_sizes(axes.xx - 1.0, axes.yy - 1.0, axes.xy) <= slight) &
         (sum_of_sizes(axes.z.x - z.x, axes.z.y - z.y, axes.z.z - z.z) <= slight);
}

// The axes and positions of two bodies.
convex::LaneVec3 row_of_two(const double *first, const double *second) {
  return {convex::Lanes{first[0], second[0]}, convex::Lanes{first[1], second[1]}, convex::Lanes{first[2], second[2]}};
}

void set_pose(convex::Pose &pose, const convex::LaneVec3 &x, const convex::LaneVec3 &y, const convex::LaneVec3 &z,
              const convex::LaneVec3 &position, int lane) {
  pose.rotation.row[0] = {x.x[lane], y.x[lane], z.x[lane]};
  pose.rotation.row[1] = {x.y[lane], y.y[lane], z.y[lane]};
  pose.rotation.row[2] = {x.z[lane], y.z[lane], z.z[lane]};
  pose.translation = {position.x[lane], position.y[lane], position.z[lane]};
}

// As read_body_pose of two bodies at once, to the bit; false where an axis of either needs more than to be straightened, or where
// anything is wrong.
bool read_two_straight(std::size_t first, std::size_t second, const double *position, const double *rotation, convex::Pose *read) {
  using convex::LaneVec3;
  using convex::Lanes;
  using convex::magnitude;
  const double *const of_first = rotation + 9 * first, *const of_second = rotation + 9 * second;
  const LaneVec3 given_x = row_of_two(of_first, of_second), given_y = row_of_two(of_first + 3, of_second + 3),
                 given_z = row_of_two(of_first + 6, of_second + 6), at = row_of_two(position + 3 * first, position + 3 * second);
  const Lanes xx = norm2(given_x), yy = norm2(given_y), xy = dot(given_x, given_y);
  LaneVec3 x, y;
  straighten(given_x, given_y, xx, yy, xy, x, y);
  const LaneVec3 z = cross(x, y), off = given_z - z;
  const auto sound = (magnitude(xx - 1.0) <= hardly_crooked) & (magnitude(yy - 1.0) <= hardly_crooked) & (magnitude(xy) <= hardly_crooked) &
                     (sizes(at) <= farthest_position) & (sizes(off) <= slight);
  if ((sound[0] & sound[1]) == 0) return false;
  set_pose(read[first], x, y, z, at, 0);
  set_pose(read[second], x, y, z, at, 1);
  return true;
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

cmb_status read_body_poses(const cmb_poses &poses, convex::Pose *read) {
  const std::size_t count = poses.body_count;
  for (std::size_t first = 0; first < count; first += 2) {
    // An odd one goes with itself.
    const std::size_t second = first + 1 < count ? first + 1 : first;
    if (read_two_straight(first, second, poses.position, poses.rotation, read)) continue;
    for (std::size_t body = first; body <= second; ++body) {
      const cmb_status status = read_body_pose(body, poses.position, poses.rotation, read[body]);
      if (status != CMB_OK) return status;
    }
  }
  return CMB_OK;
}

cmb_status check_poses_closely(const cmb_poses *poses, std::size_t body_count) {
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
