// Symmetric 3x3 matrices that are summed up, as inertias and normal equations are.
#pragma once

#include "math/vector3.hpp"

namespace cmb::convex {

struct SymmetricMatrix {
  double m[6] = {};  // xx, yy, zz, yz, zx, xy

  double trace() const { return m[0] + m[1] + m[2]; }

  void add(double part, const SymmetricMatrix &other) {
    for (int k = 0; k < 6; ++k) m[k] += part * other.m[k];
  }
  // part * r r^T
  void add_square(double part, const Vec3 &r) {
    for (int k = 0; k < 3; ++k) {
      m[k] += part * r[k] * r[k];
      m[3 + k] += part * r[(k + 1) % 3] * r[(k + 2) % 3];
    }
  }
  // part * (|r|^2 - r r^T)
  void add_inertia(double part, const Vec3 &r) {
    const double r2 = norm2(r);
    for (int k = 0; k < 3; ++k) {
      m[k] += part * (r2 - r[k] * r[k]);
      m[3 + k] -= part * r[(k + 1) % 3] * r[(k + 2) % 3];
    }
  }
  // Raises the eigenvalues.
  void add_to_diagonal(double raise) {
    for (int k = 0; k < 3; ++k) m[k] += raise;
  }

  // Solves matrix * x = right by Cramer's rule. False where the determinant is not above `least`.
  bool solve(const Vec3 &right, double least, Vec3 &x) const {
    const double xx = m[0], yy = m[1], zz = m[2], yz = m[3], zx = m[4], xy = m[5];
    const Vec3 a{yy * zz - yz * yz, zx * yz - xy * zz, xy * yz - zx * yy};
    const double determinant = xx * a.x + xy * a.y + zx * a.z;
    if (!(determinant > least)) return false;
    const Vec3 b{a.y, xx * zz - zx * zx, zx * xy - xx * yz};
    const Vec3 c{a.z, b.z, xx * yy - xy * xy};
    x = {dot(a, right) / determinant, dot(b, right) / determinant, dot(c, right) / determinant};
    return true;
  }
};

inline Vec3 times(const SymmetricMatrix &matrix, const Vec3 &p) {
  const double(&m)[6] = matrix.m;
  return {m[0] * p.x + m[5] * p.y + m[4] * p.z, m[5] * p.x + m[1] * p.y + m[3] * p.z, m[4] * p.x + m[3] * p.y + m[2] * p.z};
}

}  // namespace cmb::convex
