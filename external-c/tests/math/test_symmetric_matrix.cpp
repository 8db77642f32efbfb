// Sums of squares and inertias as matrices, and solutions of their equations by putting them in.
#include <gtest/gtest.h>

#include "math/symmetric_matrix.hpp"
#include "support/random_bodies.hpp"

namespace test_symmetric_matrix {
namespace {

using cmb::convex::SymmetricMatrix;
using cmb::convex::Vec3;
using random_bodies::Random;

Vec3 random_vector(Random &random) { return random.uniform(0.1, 2.0) * random.direction(); }

TEST(SymmetricMatrix, SolutionsFulfilTheirEquations) {
  Random random(3);
  for (int sample = 0; sample < 1000; ++sample) {
    const Vec3 r[] = {random_vector(random), random_vector(random), random_vector(random)}, right = random_vector(random);
    SymmetricMatrix squares, inertia;
    for (const Vec3 &one : r) squares.add_square(2.0, one), inertia.add_inertia(0.5, one);
    Vec3 x;
    if (squares.solve(right, 1e-4, x)) {
      Vec3 product;
      for (const Vec3 &one : r) product = product + 2.0 * dot(one, x) * one;
      EXPECT_LT(norm(product - right), 1e-10 * (1.0 + norm(x)));
    }
    ASSERT_TRUE(inertia.solve(right, 0.0, x));
    Vec3 product;
    for (const Vec3 &one : r) product = product + 0.5 * cross(one, cross(x, one));
    EXPECT_LT(norm(product - right), 1e-10 * (1.0 + norm(x)));
  }
}

TEST(SymmetricMatrix, HasNoSolutionWhereItIsSingular) {
  SymmetricMatrix flat;
  flat.add_square(1.0, {1, 0, 0});
  flat.add_square(1.0, {0, 1, 0});
  Vec3 x{7, 7, 7};
  EXPECT_FALSE(flat.solve({0, 0, 1}, 0.0, x));
  EXPECT_EQ(x.x, 7.0);
  flat.add_to_diagonal(1e-3 * flat.trace());
  ASSERT_TRUE(flat.solve({0, 0, 1}, 0.0, x));
  EXPECT_NEAR(x.z, 500.0, 1e-9);
}

}  // namespace
}  // namespace test_symmetric_matrix
