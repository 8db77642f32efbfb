// Poses as callers give them.
#pragma once

#include <cstddef>

#include "contact_multibody.h"
#include "math/vector3.hpp"

namespace cmb {

// CMB_OK, or CMB_ERROR_POSE with an error text that names the body (0-based index into the arrays).
cmb_status check_body_pose(std::size_t body, const double *position, const double *rotation);

// The same, and gives the pose.
cmb_status read_body_pose(std::size_t body, const double *position, const double *rotation, convex::Pose &pose);

// The same of all bodies, into `read`.
cmb_status read_body_poses(const cmb_poses &poses, convex::Pose *read);

// Refuses poses that are missing or not those of `body_count` bodies; what they say is not looked at.
cmb_status check_poses_closely(const cmb_poses *poses, std::size_t body_count);
inline cmb_status check_poses(const cmb_poses *poses, std::size_t body_count) {
  const bool are_given = poses != nullptr && poses->body_count == body_count && poses->position != nullptr && poses->rotation != nullptr;
  return are_given ? CMB_OK : check_poses_closely(poses, body_count);
}

}  // namespace cmb
