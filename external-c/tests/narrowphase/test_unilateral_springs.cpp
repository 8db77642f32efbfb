// Springs that press alone hold a load: the forces bear it, none pulls, and none of the other ways to bear it stores less.
#include <gtest/gtest.h>

#include <vector>

#include "narrowphase/multicontact/unilateral_springs.hpp"
#include "support/random_bodies.hpp"

namespace test_unilateral_springs {
namespace {

using namespace cmb::convex;
using namespace random_bodies;

struct Case {
  std::vector<Vec3> direction;
  std::vector<double> stiffness;
  Vec3 load;
};

// Directions about an axis, and a load that the first three, which are not nearly in a plane, can bear.
Case random_case(Random &random, std::size_t count) {
  Case result;
  const Vec3 axis = random.direction();
  while (result.direction.size() < count) {
    result.direction.push_back(normalized(axis + random.uniform(0.1, 1.5) * random.direction()));
    result.stiffness.push_back(std::exp(random.uniform(-4, 4)));
    if (result.direction.size() != 3) continue;
    const Vec3 *const d = result.direction.data();
    result.load = normalized(random.uniform(0, 1) * d[0] + random.uniform(0, 1) * d[1] + random.uniform(0, 1) * d[2]);
    if (std::fabs(dot(d[0], cross(d[1], d[2]))) < 0.05) result = {};
  }
  return result;
}

TEST(UnilateralSprings, BearTheLoadWithTheLeastEnergy) {
  Random random(3);
  for (int sample = 0; sample < 20000; ++sample) {
    const int count = random.integer(3, 9);
    const Case c = random_case(random, static_cast<std::size_t>(count));
    std::vector<double> force(static_cast<std::size_t>(count), -1.0);
    ASSERT_TRUE(solve_unilateral_springs(c.load, c.direction.data(), c.stiffness.data(), count, force.data())) << sample;
    Vec3 sum;
    for (std::size_t k = 0; k < force.size(); ++k) {
      ASSERT_GE(force[k], 0.0);
      sum = sum + force[k] * c.direction[k];
    }
    ASSERT_LT(norm(sum - c.load), 1e-9) << sample;
    // The motion that the forces tell of, by least squares from those that press: none of the others would be pressed by it.
    for (std::size_t i = 0; i < force.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        for (std::size_t k = 0; k < j; ++k) {
          const Vec3 jk = cross(c.direction[j], c.direction[k]), ki = cross(c.direction[k], c.direction[i]),
                     ij = cross(c.direction[i], c.direction[j]);
          const double volume = dot(c.direction[i], jk);
          if (!(force[i] > 0.0 && force[j] > 0.0 && force[k] > 0.0 && std::fabs(volume) > 1e-2)) continue;
          const Vec3 v = (1.0 / volume) * ((force[i] / c.stiffness[i]) * jk + (force[j] / c.stiffness[j]) * ki +
                                           (force[k] / c.stiffness[k]) * ij);
          for (std::size_t other = 0; other < force.size(); ++other) {
            const double pressed = std::fmax(0.0, c.stiffness[other] * dot(c.direction[other], v));
            ASSERT_NEAR(pressed, force[other], 1e-5 * (1.0 + c.stiffness[other] * norm(v))) << sample;
          }
        }
      }
    }
  }
}

TEST(UnilateralSprings, OneOppositeTheLoadTakesAll) {
  const Vec3 load{0, 0, 1}, directions[] = {{0, 0, 1}, {0.6, 0, 0.8}, {-0.6, 0, 0.8}, {0, 0.6, 0.8}, {0, -0.6, 0.8}};
  const double stiffness[] = {1e13, 1.0, 1.0, 1.0, 1.0};
  double force[5];
  ASSERT_TRUE(solve_unilateral_springs(load, directions, stiffness, 5, force));
  EXPECT_NEAR(force[0], 1.0, 1e-12);
  for (int k = 1; k < 5; ++k) EXPECT_LT(force[k], 1e-12);
}

// Four directions in a cone's mantle: the load's part across the plane of two opposite ones is borne by the other two alike.
TEST(UnilateralSprings, EqualSpringsShareALoadOnTheirAxisAlike) {
  const Vec3 load{0, 0, 1}, directions[] = {{0.6, 0, 0.8}, {-0.6, 0, 0.8}, {0, 0.6, 0.8}, {0, -0.6, 0.8}};
  const double stiffness[] = {2.0, 2.0, 2.0, 2.0};
  double force[4];
  ASSERT_TRUE(solve_unilateral_springs(load, directions, stiffness, 4, force));
  for (const double f : force) EXPECT_NEAR(f, 0.25 / 0.8, 1e-9);
}

// In a plane: what is perpendicular to it is not held, and nothing of the load is.
TEST(UnilateralSprings, DirectionsInAPlane) {
  const Vec3 load{0, 0, 1}, directions[] = {{0.6, 0, 0.8}, {-0.6, 0, 0.8}, {0, 0, 1}};
  const double stiffness[] = {1.0, 1.0, 1.0};
  double force[3];
  ASSERT_TRUE(solve_unilateral_springs(load, directions, stiffness, 3, force));
  EXPECT_NEAR(0.8 * (force[0] + force[1]) + force[2], 1.0, 1e-8);
  EXPECT_NEAR(force[0], force[1], 1e-8);
  EXPECT_NEAR(force[0], 0.8 * force[2], 1e-8);  // as the directions' parts along the motion
}

}  // namespace
}  // namespace test_unilateral_springs
