#include "math/trigonometric_polynomial.hpp"

#include "math/polynomial_roots.hpp"

namespace cmb {

int TrigonometricPolynomial::sign_changes_ahead(double *angle) const {
  const double coefficient[5] = {constant + cosine + cosine2, 2.0 * sine + 4.0 * sine2, 2.0 * constant - 6.0 * cosine2,
                                 2.0 * sine - 4.0 * sine2, constant - cosine + cosine2};
  const int count = overlap::sign_changes(coefficient, 4, -1.0, 1.0, angle);
  for (int k = 0; k < count; ++k) angle[k] = 2.0 * std::atan(angle[k]);
  return count;
}

}  // namespace cmb
