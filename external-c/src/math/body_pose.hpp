// Where a body is, from the arrays of the C interface.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/vector3.hpp"

namespace cmb {

// The rows of a rotation matrix, world to body: the body's axes in the world, nearly orthonormal; and products of the first
// two.
struct GivenAxes {
  convex::Vec3 x, y, z;
  double xx, yy, xy;

  explicit GivenAxes(const double *rotation)
      : x{rotation[0], rotation[1], rotation[2]},
        y{rotation[3], rotation[4], rotation[5]},
        z{rotation[6], rotation[7], rotation[8]},
        xx(norm2(x)),
        yy(norm2(y)),
        xy(dot(x, y)) {}
};

// The axes of a body, or of two at once, that are orthonormal to 1e-8 made so to rounding: x keeps its direction, y its plane with x.
// Squares of what is missing are lost in rounding: one step of Newton's for the inverse root will do.
template <typename Vector, typename Number>
void straighten(const Vector &given_x, const Vector &given_y, Number xx, Number yy, Number xy, Vector &x, Vector &y) {
  x = (1.5 - 0.5 * xx) * given_x;
  y = (1.5 - 0.5 * yy) * (given_y - xy * x);
}
constexpr double hardly_crooked = 1e-8;

// The pose of a body: point_in_world = pose(point_in_body). Its rotation is made orthonormal to rounding: x keeps its
// direction, y its plane with x.
inline convex::Pose body_pose(const double *position, const GivenAxes &axes) {
  using convex::Vec3;
  Vec3 x, y;
  const double largest = std::max({std::fabs(axes.xx - 1.0), std::fabs(axes.yy - 1.0), std::fabs(axes.xy)});
  if (largest <= hardly_crooked) {
    straighten(axes.x, axes.y, axes.xx, axes.yy, axes.xy, x, y);
  } else {
    x = normalized(axes.x);
    y = normalized(axes.y - dot(axes.y, x) * x);
  }
  const Vec3 z = cross(x, y);
  return {{{{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}}}, {position[0], position[1], position[2]}};
}

inline convex::Pose body_pose(const double *position, const double *rotation) {
  return body_pose(position, GivenAxes(rotation));
}

}  // namespace cmb
