// Trigonometric polynomials of the second degree: where their sign changes.
#include "math/trigonometric_polynomial.hpp"

#include <gtest/gtest.h>

#include "support/random_bodies.hpp"

namespace test_trigonometric_polynomial {
namespace {

using cmb::TrigonometricPolynomial;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;

double value(const TrigonometricPolynomial &polynomial, double angle) { return polynomial.at(std::cos(angle), std::sin(angle)); }

// Between places as near as a thousandth of the half circle one change is seen, or none, or two that are next to each other.
TEST(TrigonometricPolynomial, ChangesItsSignWhereItSays) {
  Random random(1);
  constexpr int places = 1000;
  for (int k = 0; k < 2000; ++k) {
    const TrigonometricPolynomial polynomial{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                                             random.uniform(-1, 1)};
    double angle[4];
    const int count = polynomial.sign_changes_ahead(angle);
    for (int i = 0; i < count; ++i) EXPECT_LT(std::fabs(value(polynomial, angle[i])), 1e-14) << k;
    for (int place = 0; place < places; ++place) {
      const double from = -0.5 * pi + pi * place / places, to = from + pi / places;
      int between = 0;
      for (int i = 0; i < count; ++i) between += angle[i] > from && angle[i] <= to ? 1 : 0;
      const bool changes = (value(polynomial, from) < 0.0) != (value(polynomial, to) < 0.0);
      EXPECT_EQ(between % 2 == 1, changes) << k << " " << from;
    }
  }
}

TEST(TrigonometricPolynomial, IsTheSameFromAnyOrigin) {
  Random random(2);
  for (int k = 0; k < 200; ++k) {
    const TrigonometricPolynomial polynomial{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1),
                                             random.uniform(-1, 1)};
    const double origin = random.uniform(-4, 4), angle = random.uniform(-4, 4), step = 1e-6;
    EXPECT_NEAR(value(polynomial.from(origin), angle - origin), value(polynomial, angle), 1e-14);
    EXPECT_LE(std::fabs(value(polynomial, angle)), polynomial.size());
    const double slope = (value(polynomial, angle + step) - value(polynomial, angle - step)) / (2.0 * step);
    EXPECT_NEAR(polynomial.slope_at(std::cos(angle), std::sin(angle)), slope, 1e-8);
  }
}

}  // namespace
}  // namespace test_trigonometric_polynomial
