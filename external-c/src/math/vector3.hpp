// Fixed-size vector algebra of the convex-body algorithms.
#pragma once

#include <cmath>

namespace cmb::convex {

struct Vec3 {
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;

  double operator[](int axis) const { return axis == 0 ? x : axis == 1 ? y : z; }
  void set(int axis, double value) { (axis == 0 ? x : axis == 1 ? y : z) = value; }
};

inline Vec3 operator+(const Vec3 &a, const Vec3 &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Vec3 operator-(const Vec3 &a, const Vec3 &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vec3 operator-(const Vec3 &a) { return {-a.x, -a.y, -a.z}; }
inline Vec3 operator*(double s, const Vec3 &a) { return {s * a.x, s * a.y, s * a.z}; }
inline double dot(const Vec3 &a, const Vec3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Vec3 cross(const Vec3 &a, const Vec3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm2(const Vec3 &a) { return dot(a, a); }
inline double norm(const Vec3 &a) { return std::sqrt(norm2(a)); }
inline bool is_finite(const Vec3 &a) { return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z); }

// The unit vector along a, or `otherwise` where a is zero.
inline Vec3 normalized(const Vec3 &a, const Vec3 &otherwise = {0.0, 0.0, 1.0}) {
  const double length = norm(a);
  return length > 0.0 ? (1.0 / length) * a : otherwise;
}

// A unit vector perpendicular to the unit vector a.
inline Vec3 any_perpendicular(const Vec3 &a) {
  const double ax = std::fabs(a.x), ay = std::fabs(a.y), az = std::fabs(a.z);
  const Vec3 axis = (ax <= ay && ax <= az) ? Vec3{1, 0, 0} : (ay <= az ? Vec3{0, 1, 0} : Vec3{0, 0, 1});
  return normalized(cross(a, axis));
}

// The direction perpendicular to the unit vectors a and b, unit, accurate to rounding with respect
// to both even where they are nearly parallel. Returns false where they are parallel to rounding.
inline bool common_perpendicular(const Vec3 &a, const Vec3 &b, Vec3 &result) {
  const Vec3 across = b - dot(a, b) * a;  // absolute error of rounding, whatever the angle
  const double sine = norm(across);
  if (!(sine > 1e-13)) return false;
  result = normalized(cross(a, (1.0 / sine) * across));
  return true;
}

// A 3x3 matrix by rows.
struct Mat3 {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

  Vec3 column(int j) const { return {row[0][j], row[1][j], row[2][j]}; }
};

inline Vec3 operator*(const Mat3 &m, const Vec3 &v) { return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)}; }
// transpose(m) * v
inline Vec3 transposed_times(const Mat3 &m, const Vec3 &v) {
  return v.x * m.row[0] + v.y * m.row[1] + v.z * m.row[2];
}
inline Mat3 transposed(const Mat3 &m) { return {{m.column(0), m.column(1), m.column(2)}}; }

// A rigid pose: point_in_a = rotation * point_in_b + translation.
struct Pose {
  Mat3 rotation;
  Vec3 translation;

  Vec3 operator()(const Vec3 &p) const { return rotation * p + translation; }
  Pose inverse() const { return {transposed(rotation), -transposed_times(rotation, translation)}; }
};

}  // namespace cmb::convex
