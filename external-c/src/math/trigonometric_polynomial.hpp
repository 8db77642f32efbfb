// Trigonometric polynomials of the second degree.
#pragma once

#include <cmath>

namespace cmb {

// constant + cosine cos(a) + sine sin(a) + cosine2 cos(2 a) + sine2 sin(2 a)
struct TrigonometricPolynomial {
  double constant = 0.0, cosine = 0.0, sine = 0.0, cosine2 = 0.0, sine2 = 0.0;

  // By the angle's cosine and sine.
  double at(double c, double s) const { return constant + cosine * c + sine * s + cosine2 * (c * c - s * s) + 2.0 * sine2 * c * s; }
  double slope_at(double c, double s) const {
    return sine * c - cosine * s + 2.0 * (sine2 * (c * c - s * s) - 2.0 * cosine2 * c * s);
  }
  // No value is greater.
  double size() const {
    return std::fabs(constant) + std::fabs(cosine) + std::fabs(sine) + std::fabs(cosine2) + std::fabs(sine2);
  }
  // The same with angles that count from `origin`.
  TrigonometricPolynomial from(double origin) const {
    const double c = std::cos(origin), s = std::sin(origin), c2 = c * c - s * s, s2 = 2.0 * c * s;
    return {constant, cosine * c + sine * s, sine * c - cosine * s, cosine2 * c2 + sine2 * s2, sine2 * c2 - cosine2 * s2};
  }
  // The angles less than a right one from 0 where the sign changes, ascending; at most four, whose number is returned. By the tangent of
  // half the angle it is a polynomial of the fourth degree.
  int sign_changes_ahead(double *angle) const;
};

}  // namespace cmb
