// Real roots of polynomials of small degree.
#pragma once

namespace cmb::overlap {

// The real roots in (low, high) of coefficient[0] + ... + coefficient[degree] x^degree where its sign changes, ascending, to
// rounding; degree <= 4. Writes at most `degree` of them to `root` and returns their number.
int sign_changes(const double *coefficient, int degree, double low, double high, double *root);

}  // namespace cmb::overlap
