// Two boxes as seen along the fifteen directions that may part them: each box's axes, and the cross products of an axis of
// each.
#pragma once

#include <cmath>

#include "math/vector3.hpp"

namespace cmb::convex {

// By half lengths of both boxes, centred at the origins of their frames; B's pose in A's frame.
class BoxPair {
 public:
  BoxPair(const Vec3 &half_a, const Vec3 &half_b, const Pose &b_in_a) : a_(half_a), b_(half_b), pose_(b_in_a) {
    const Mat3 &r = b_in_a.rotation;
    const Vec3 t = b_in_a.translation, t_in_b = transposed_times(r, t);
    for (int i = 0; i < 3; ++i) {
      rotation[i][0] = r.row[i].x, rotation[i][1] = r.row[i].y, rotation[i][2] = r.row[i].z;
      for (int j = 0; j < 3; ++j) absolute[i][j] = std::fabs(rotation[i][j]);
    }
    a[0] = half_a.x, a[1] = half_a.y, a[2] = half_a.z;
    b[0] = half_b.x, b[1] = half_b.y, b[2] = half_b.z;
    shift_a[0] = t.x, shift_a[1] = t.y, shift_a[2] = t.z;
    shift_b[0] = t_in_b.x, shift_b[1] = t_in_b.y, shift_b[2] = t_in_b.z;
    for (int i = 0; i < 3; ++i) {
      reach_of_b[i] = b[0] * absolute[i][0] + b[1] * absolute[i][1] + b[2] * absolute[i][2];
      reach_of_a[i] = a[0] * absolute[0][i] + a[1] * absolute[1][i] + a[2] * absolute[2][i];
    }
  }

  const Vec3 &half_a() const { return a_; }
  const Vec3 &half_b() const { return b_; }
  const Pose &b_in_a() const { return pose_; }

  static constexpr int next[3] = {1, 2, 0};
  // Of the cross product of A's axis i and B's axis j.
  Vec3 across_direction(int i, int j) const {
    Vec3 direction;
    direction.set(next[i], -rotation[next[next[i]]][j]);
    direction.set(next[next[i]], rotation[next[i]][j]);
    return direction;
  }

  double a[3], b[3];                          // half lengths
  double rotation[3][3], absolute[3][3];      // [i][j]: of B's axis j the component along A's axis i
  double shift_a[3], shift_b[3];              // B's middle from A's, along A's and along B's axes
  double reach_of_b[3], reach_of_a[3];        // half of B's extent along A's axes, of A's along B's axes

 private:
  Vec3 a_, b_;
  Pose pose_;
};

// Along the cross product of A's axis i and B's axis j, which is not a unit vector: how far both boxes reach together, where
// B's middle is seen from A's, and the square of the product's length.
struct AcrossEdges {
  struct {
    double reach, shift, length2;
  } of[3][3];

  void find(const BoxPair &boxes) {
    for (int i = 0; i < 3; ++i) {
      const int i1 = BoxPair::next[i], i2 = BoxPair::next[i1];
      for (int j = 0; j < 3; ++j) {
        const int j1 = BoxPair::next[j], j2 = BoxPair::next[j1];
        // The product's components along A's axes i, i1, i2 are 0, -z, y.
        const double y = boxes.rotation[i1][j], z = boxes.rotation[i2][j];
        of[i][j].reach = boxes.a[i1] * boxes.absolute[i2][j] + boxes.a[i2] * boxes.absolute[i1][j] +
                         boxes.b[j1] * boxes.absolute[i][j2] + boxes.b[j2] * boxes.absolute[i][j1];
        of[i][j].shift = boxes.shift_a[i2] * y - boxes.shift_a[i1] * z;
        of[i][j].length2 = y * y + z * z;
      }
    }
  }
};

}  // namespace cmb::convex
