// The straight lines of a mantle, and where another mantle crosses them.
#pragma once

#include <cmath>

#include "manifold/revolved/mantle.hpp"
#include "math/trigonometric_polynomial.hpp"

namespace cmb {

// A ruling by its angle about the axis; a place of it by its height above the body's middle on a cylinder, by the inverse of its height
// below the apex on a cone. By that, too, the square of the distance from the other mantle's axis less that of its radius there is
// quadratic: its second coefficient is the same for all rulings, the others are trigonometric polynomials of the first and second degree,
// and so is the discriminant.
class MantleRulings {
 public:
  // `in_other`: from the body's frame to that of the other one.
  MantleRulings(const RevolvedBody &body, const RevolvedBody &other, const Pose &in_other);

  // A quarter of it: (first half coefficient)^2 - second * zeroth.
  const TrigonometricPolynomial &discriminant() const { return discriminant_; }
  double second() const { return second_; }

  // The quadratic's on one ruling.
  struct Ruling {
    double cosine, sine, first, zeroth;  // `first`: half of the coefficient
  };
  Ruling ruling(double angle) const;
  double discriminant_on(const Ruling &ruling) const { return ruling.first * ruling.first - second_ * ruling.zeroth; }
  // Of that one, as good as.
  double rounding_on(const Ruling &ruling) const {
    constexpr double rounding = 1e-15;
    return rounding * (std::fabs(ruling.first) * first_.size() + std::fabs(second_) * zeroth_.size());
  }
  // Where it is crossed: where the quadratic's derivative by the place is twice `growth`, a root of the discriminant.
  double place_on(const Ruling &ruling, double growth) const;
  // Half of the quadratic's derivative by the place.
  double growth_at(const Ruling &ruling, double place) const { return second_ * place + ruling.first; }
  // The quadratic's derivative by the angle.
  double change(const Ruling &ruling, double place) const;

  // Of a cone's apex.
  bool is_on_this_side(double place) const { return body_.is_cylinder() || place > 0.0; }
  double height_at(double place) const { return body_.is_cylinder() ? place : body_.half - 1.0 / place; }
  double place_at(double height) const { return body_.is_cylinder() ? height : 1.0 / (body_.half - height); }
  // How the height changes by the place.
  double rise(double place) const { return body_.is_cylinder() ? 1.0 : 1.0 / (place * place); }

 private:
  RevolvedBody body_;
  double second_ = 0.0;
  TrigonometricPolynomial first_, zeroth_, discriminant_;
};

}  // namespace cmb
