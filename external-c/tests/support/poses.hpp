// Poses of bodies, and numbers as descriptors take them.
#pragma once

#include <cmath>
#include <cstdio>
#include <string>

#include "math/vector3.hpp"

namespace cmb::test {

using convex::Mat3;
using convex::Vec3;

// A number as descriptors take it, with all its digits.
inline std::string digits(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// The hull of points spread evenly on a sphere of radius 0.5: Fibonacci's lattice.
inline std::string tessellated_ball(int corners) {
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < corners; ++k) {
    const double z = 1.0 - (2.0 * k + 1.0) / corners, across = std::sqrt(1.0 - z * z), turn = 2.399963229728653 * k;
    text += (k > 0 ? "," : "") + digits(0.5 * across * std::cos(turn)) + "," + digits(0.5 * across * std::sin(turn)) + "," +
            digits(0.5 * z);
  }
  return text;
}

// A body's pose: `rotation` maps body to world.
struct BodyPose {
  Vec3 position;
  Mat3 rotation;
};

// Rotation by `angle` about the unit vector `axis`.
inline Mat3 rotation_about(const Vec3 &axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Mat3 result;
  for (int i = 0; i < 3; ++i) {
    Vec3 e;
    e.set(i, 1.0);
    const Vec3 turned = c * e + s * cross(axis, e) + ((1.0 - c) * dot(axis, e)) * axis;
    for (int j = 0; j < 3; ++j) result.row[j].set(i, turned[j]);
  }
  return result;
}

inline Mat3 product(const Mat3 &a, const Mat3 &b) {
  Mat3 result;
  for (int j = 0; j < 3; ++j) {
    const Vec3 column = a * b.column(j);
    for (int i = 0; i < 3; ++i) result.row[i].set(j, column[i]);
  }
  return result;
}

}  // namespace cmb::test
