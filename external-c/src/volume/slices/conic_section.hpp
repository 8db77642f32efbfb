// Quadrics and their sections.
#pragma once

#include "math/vector3.hpp"

namespace cmb::overlap {

using convex::Vec3;

// A part of a line p + s d; empty where it does not begin before it ends.
struct Stretch {
  double begin = 0.0, end = 0.0;
  bool empty() const { return !(begin < end); }
};

// The solid f1^2 + f2^2 + third f3^2 <= level with f = origin + x p.x + y p.y + z p.z: a ball in stretched axes (third 1,
// level 1), a cylinder (0, 1), or a cone towards falling f3 with its apex at f = 0 (-1, 0).
struct Quadric {
  Vec3 origin, x, y, z;
  double third = 1.0, level = 1.0;

  Vec3 at(const Vec3 &p) const { return origin + along(p); }
  Vec3 along(const Vec3 &d) const { return d.x * x + d.y * y + d.z * z; }
  double product(const Vec3 &f, const Vec3 &g) const { return f.x * g.x + f.y * g.y + third * f.z * g.z; }
  // Of the line f + s e in those axes.
  Stretch stretch(const Vec3 &f, const Vec3 &e) const;
};

// A quadric cut by a plane y = const: a z^2 + 2 b z + c <= 0, b and c being polynomials of x, for the x where
// D = b^2 - a c >= 0.
class Conic {
 public:
  // For x in [low, high].
  Conic(const Quadric &quadric, double y, double low, double high);
  Conic() = default;

  // The x it has points for lie in this stretch.
  const Stretch &reach() const { return reach_; }
  // z of both sides; infinite where there is none.
  Stretch at(double x) const;

  // Calls visit(x, z, weight) at the nodes of a rule for integrals over x of cubic polynomials in x and z along the upper
  // or the lower side, from `from` to `to` within reach(); to about 1e-11.
  template <typename Visit>
  void integrate(bool upper, double from, double to, Visit &&visit) const;

  // Where this conic meets another one: sides included that do not belong to the solids, and places that are none. Writes at
  // most 7 between low and high and returns their number.
  int crossings(const Conic &other, double low, double high, double *x) const;

  // Places of reach() where the solid changes: its ends. At most two.
  int ends(double *x) const;

 private:
  enum class Kind { empty, wall, level, parabola, ellipse, hyperbola, open_hyperbola };
  double b_at(double x) const { return b0_ + b1_ * x; }
  double c_at(double x) const { return c0_ + x * (2.0 * c1_ + x * c2_); }
  // A side's z, `root` being that of D.
  double side(bool upper, double x, double root) const;
  void classify(double low, double high);

  Kind kind_ = Kind::empty;
  bool one_nappe_ = false;  // of a cone; `apex_` + slopes tell which
  double axial0_ = 0.0, axial_x_ = 0.0, axial_z_ = 0.0;
  double a_ = 0.0, b0_ = 0.0, b1_ = 0.0, c0_ = 0.0, c1_ = 0.0, c2_ = 0.0;
  double d0_ = 0.0, d1_ = 0.0, d2_ = 0.0;
  double end_[2] = {0.0, 0.0};  // of reach: D = 0 there
  bool from_left_ = true;       // parabola, hyperbola: it reaches from end_[0] to the right, else to the left
  double size_ = 0.0;           // ellipse: of reach; hyperbola: between D's roots; open: of its waist
  Stretch reach_;
};

}  // namespace cmb::overlap

#include "volume/slices/conic_integral.hpp"
