// Two numbers at once, as processors compute them: sums over many places take half as long.
#pragma once

#include <cmath>
#include <cstddef>

#include "math/symmetric_matrix.hpp"

namespace cmb::convex {

// Compilers' own vectors: operators work number by number, with the same bits as those of single ones.
using Lanes = double __attribute__((vector_size(16)));

inline double sum_of(Lanes v) { return v[0] + v[1]; }
inline Lanes magnitude(Lanes v) { return Lanes{std::fabs(v[0]), std::fabs(v[1])}; }
inline Lanes square_root(Lanes v) { return Lanes{std::sqrt(v[0]), std::sqrt(v[1])}; }

// Two vectors.
struct LaneVec3 {
  Lanes x = {0.0, 0.0}, y = {0.0, 0.0}, z = {0.0, 0.0};

  LaneVec3() = default;
  LaneVec3(Lanes all_x, Lanes all_y, Lanes all_z) : x(all_x), y(all_y), z(all_z) {}
  LaneVec3(const Vec3 &first, const Vec3 &second) : x{first.x, second.x}, y{first.y, second.y}, z{first.z, second.z} {}
  // The same one twice.
  explicit LaneVec3(const Vec3 &both) : LaneVec3(both, both) {}
};

inline LaneVec3 operator+(const LaneVec3 &a, const LaneVec3 &b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline LaneVec3 operator-(const LaneVec3 &a, const LaneVec3 &b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline LaneVec3 operator*(Lanes s, const LaneVec3 &a) { return {s * a.x, s * a.y, s * a.z}; }
inline Lanes dot(const LaneVec3 &a, const LaneVec3 &b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline LaneVec3 cross(const LaneVec3 &a, const LaneVec3 &b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline Lanes norm2(const LaneVec3 &a) { return dot(a, a); }
inline Vec3 sum_of(const LaneVec3 &v) { return {sum_of(v.x), sum_of(v.y), sum_of(v.z)}; }

inline LaneVec3 operator*(const Mat3 &m, const LaneVec3 &p) {
  const auto along = [&p](const Vec3 &row) { return row.x * p.x + row.y * p.y + row.z * p.z; };
  return {along(m.row[0]), along(m.row[1]), along(m.row[2])};
}
inline LaneVec3 times(const SymmetricMatrix &matrix, const LaneVec3 &p) {
  const double(&m)[6] = matrix.m;
  return {m[0] * p.x + m[5] * p.y + m[4] * p.z, m[5] * p.x + m[1] * p.y + m[3] * p.z, m[4] * p.x + m[3] * p.y + m[2] * p.z};
}

}  // namespace cmb::convex
