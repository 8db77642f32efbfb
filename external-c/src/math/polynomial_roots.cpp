#include "math/polynomial_roots.hpp"

#include <cmath>

namespace cmb::overlap {

namespace {

double value_at(const double *coefficient, int degree, double x) {
  double value = coefficient[degree];
  for (int k = degree - 1; k >= 0; --k) value = value * x + coefficient[k];
  return value;
}

// Newton's steps, kept between places of opposite sign; the polynomial is monotonous in between.
double root_between(const double *coefficient, const double *slope, int degree, double low, double high, bool rising) {
  double x = 0.5 * (low + high);
  for (int step = 0; step < 60; ++step) {
    const double value = value_at(coefficient, degree, x);
    if (value == 0.0) return x;
    ((value > 0.0) == rising ? high : low) = x;
    const double steepness = value_at(slope, degree - 1, x);
    double next = x - value / steepness;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    if (next == x || std::fabs(next - x) <= 4e-16 * (std::fabs(low) + std::fabs(high))) return next;
    x = next;
  }
  return x;
}

}  // namespace

int sign_changes(const double *coefficient, int degree, double low, double high, double *root) {
  double slope[4] = {0, 0, 0, 0}, place[6];
  if (degree == 0) return 0;
  for (int k = 1; k <= degree; ++k) slope[k - 1] = k * coefficient[k];
  int places = 0;
  place[places++] = low;
  places += sign_changes(slope, degree - 1, low, high, place + 1);
  place[places++] = high;
  int count = 0;
  double before = value_at(coefficient, degree, low);
  for (int k = 1; k < places; ++k) {
    const double after = value_at(coefficient, degree, place[k]);
    if ((before < 0.0) != (after < 0.0)) {
      root[count++] = root_between(coefficient, slope, degree, place[k - 1], place[k], after > before);
    }
    before = after;
  }
  return count;
}

}  // namespace cmb::overlap
