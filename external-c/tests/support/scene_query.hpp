// A scene, asked through the C interface.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "contact_multibody.h"
#include "engine_calls.hpp"
#include "poses.hpp"

namespace cmb::test {

struct Point {
  double depth = 0.0;
  double weight = 0.0;
  Vec3 normal;
  Vec3 position;
};

// One pair's contact with the slots in use.
struct Contact {
  double distance = 0.0;
  std::vector<Point> points;

  double total_weight() const {
    double sum = 0.0;
    for (const Point &p : points) sum += p.weight;
    return sum;
  }
  // Sum of weight * depth * normal: the force at stiffness 1.
  Vec3 load() const {
    Vec3 sum;
    for (const Point &p : points) sum = sum + (p.weight * p.depth) * p.normal;
    return sum;
  }
  // Its moment about `origin`.
  Vec3 moment(const Vec3 &origin) const {
    Vec3 sum;
    for (const Point &p : points) sum = sum + cross(p.position - origin, (p.weight * p.depth) * p.normal);
    return sum;
  }
  double energy() const {
    double sum = 0.0;
    for (const Point &p : points) sum += 0.5 * p.weight * p.depth * p.depth;
    return sum;
  }
};

inline cmb_scene intern(const std::vector<std::string> &geometry, const std::vector<int> &pairs,
                        cmb_backend backend = CMB_BACKEND_AUTO) {
  std::vector<const char *> texts;
  for (const std::string &text : geometry) texts.push_back(text.c_str());
  cmb_scene scene{};
  const cmb_status status =
      intern_scene(texts.data(), texts.size(), pairs.data(), pairs.size() / 2, backend, &scene);
  EXPECT_EQ(status, CMB_OK) << cmb_last_error();
  return scene;
}

// The poses of bodies A and B as the C interface takes them.
struct PairPoses {
  double position[6], rotation[18];

  PairPoses(const BodyPose &a, const BodyPose &b) {
    const BodyPose *poses[2] = {&a, &b};
    for (int body = 0; body < 2; ++body) {
      for (int i = 0; i < 3; ++i) {
        position[3 * body + i] = poses[body]->position[i];
        for (int j = 0; j < 3; ++j) rotation[9 * body + 3 * i + j] = poses[body]->rotation.row[j][i];
      }
    }
  }
};

// Two bodies A and B.
class PairScene {
 public:
  PairScene(const std::string &a, const std::string &b, cmb_backend backend = CMB_BACKEND_AUTO)
      : scene_(intern({a, b}, {1, 2}, backend)) {}

  cmb_scene handle() const { return scene_; }

  Contact query(const BodyPose &a, const BodyPose &b, std::size_t capacity = 32) const {
    const PairPoses poses(a, b);
    Contact contact;
    std::vector<double> depth(capacity), weight(capacity), normal(3 * capacity), point(3 * capacity);
    const cmb_status status = query_scene(scene_, poses.position, poses.rotation, 2, 1, capacity, &contact.distance,
                                              depth.data(), weight.data(), normal.data(), point.data());
    EXPECT_EQ(status, CMB_OK) << cmb_last_error();
    for (std::size_t k = 0; k < capacity; ++k) {
      const Vec3 n{normal[3 * k], normal[3 * k + 1], normal[3 * k + 2]};
      // Millions of them: GoogleTest is told of those alone that are wrong.
      if (!(std::fabs(norm(n) - 1.0) <= 1e-12 && depth[k] >= 0.0 && weight[k] >= 0.0)) {
        ADD_FAILURE() << "point " << k << ": depth " << depth[k] << ", weight " << weight[k] << ", normal of length "
                      << norm(n);
      }
      if (weight[k] > 0.0) {
        contact.points.push_back({depth[k], weight[k], n, {point[3 * k], point[3 * k + 1], point[3 * k + 2]}});
      }
    }
    return contact;
  }

 private:
  cmb_scene scene_;
};

}  // namespace cmb::test
