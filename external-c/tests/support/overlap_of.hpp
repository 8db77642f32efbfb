// Overlaps through the C interface.
#pragma once

#include "contact_multibody.h"
#include "engine_calls.hpp"
#include "scene_query.hpp"

namespace cmb::test {

inline Vec3 vector_of(const double *v) { return {v[0], v[1], v[2]}; }

inline cmb_overlap overlap_of(const PairScene &scene, const BodyPose &a, const BodyPose &b) {
  const BodyPose *poses[2] = {&a, &b};
  double position[6], rotation[18];
  for (int body = 0; body < 2; ++body) {
    for (int i = 0; i < 3; ++i) {
      position[3 * body + i] = poses[body]->position[i];
      for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * i + j] = poses[body]->rotation.row[j][i];
    }
  }
  cmb_overlap result;
  EXPECT_EQ(query_overlap(scene.handle(), 1, position, rotation, 2, &result), CMB_OK) << cmb_last_error();
  EXPECT_EQ(result.known, 1);
  return result;
}

// The contact normal, from B to A.
inline Vec3 normal_of(const PairScene &scene, const BodyPose &a, const BodyPose &b) {
  const BodyPose *poses[2] = {&a, &b};
  double position[6], rotation[18], distance, depth, weight, normal[3], point[3];
  for (int body = 0; body < 2; ++body) {
    for (int i = 0; i < 3; ++i) {
      position[3 * body + i] = poses[body]->position[i];
      for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * i + j] = poses[body]->rotation.row[j][i];
    }
  }
  EXPECT_EQ(query_scene(scene.handle(), position, rotation, 2, 1, 1, &distance, &depth, &weight, normal, point), CMB_OK);
  return vector_of(normal);
}

// The pose of a body that moves with the frame: first the pose, then the motion.
inline BodyPose moved_by(const BodyPose &motion, const BodyPose &pose) {
  return {motion.position + motion.rotation * pose.position, product(motion.rotation, pose.rotation)};
}

}  // namespace cmb::test
