// Loads that the contacts of a capsule's axis carry together.
#include <gtest/gtest.h>

#include <cmath>

#include "mesh/contact/rod_load.hpp"
#include "support/random_bodies.hpp"

namespace {

using cmb::convex::Vec3;
using cmb::mesh::RodLoad;
using random_bodies::Random;

struct Sums {
  Vec3 force, at_far_end;  // loads, and loads times their part of the way
};

Sums sums(const RodLoad &rod) {
  Sums result;
  for (std::size_t i = 0; i < rod.size(); ++i) {
    result.force = result.force + rod[i].load * rod[i].normal;
    result.at_far_end = result.at_far_end + (rod[i].place * rod[i].load) * rod[i].normal;
  }
  return result;
}

double difference(const Sums &a, const Sums &b) { return norm(a.force - b.force) + norm(a.at_far_end - b.at_far_end); }

const Vec3 axis{1, 0, 0}, up{0, 0, 1};

TEST(RodLoad, LyingOnAPlaneEachEndCarriesHalfItsDepth) {
  RodLoad rod;
  rod.clear(axis);
  rod.add(0.0, up, 0.02);
  rod.add(1.0, up, 0.01);
  rod.solve();
  EXPECT_DOUBLE_EQ(rod[0].load, 0.01);
  EXPECT_DOUBLE_EQ(rod[1].load, 0.005);
}

TEST(RodLoad, ContactsThatOthersImplyChangeNothing) {
  Random random(3);
  for (int trial = 0; trial < 1000; ++trial) {
    RodLoad ends, all;
    ends.clear(axis), all.clear(axis);
    const double first = random.uniform(0.0, 0.5), last = random.uniform(0.6, 1.0);
    for (int plane = 0; plane < 3; ++plane) {
      const Vec3 normal = normalized(up + 0.35 * random.direction());
      const double at_first = random.uniform(0.01, 0.1), at_last = random.uniform(0.01, 0.1);
      const auto add = [&](RodLoad &rod, double share, double less) {
        rod.add((1.0 - share) * first + share * last, normal, (1.0 - share) * at_first + share * at_last - less);
      };
      for (RodLoad *rod : {&ends, &all}) add(*rod, 0.0, 0.0), add(*rod, 1.0, 0.0);
      for (int k = 0; k < 4; ++k) add(all, random.uniform(0, 1), k % 2 * 0.005);
    }
    ends.solve(), all.solve();
    ASSERT_LT(difference(sums(ends), sums(all)), 1e-8) << trial;
  }
}

// Also where contacts push against each other: one that is hardly deep carries hardly anything.
TEST(RodLoad, ContactsComeWithoutAJump) {
  Random random(4);
  for (int trial = 0; trial < 1000; ++trial) {
    RodLoad before, after;
    before.clear(axis), after.clear(axis);
    for (int k = 0; k < 5; ++k) {
      const Vec3 normal = random.direction();
      const double part = random.uniform(0, 1), depth = random.uniform(0.01, 0.1);
      before.add(part, normal, depth), after.add(part, normal, depth);
    }
    after.add(random.uniform(0, 1), random.direction(), 1e-12);
    before.solve(), after.solve();
    ASSERT_LT(difference(sums(before), sums(after)), 1e-8) << trial;
  }
}

TEST(RodLoad, UprightTheLowerEndCarriesAll) {
  RodLoad rod;
  rod.clear(up);
  rod.add(0.0, up, 0.03);
  rod.solve();
  EXPECT_NEAR(rod[0].load, 0.03, 1e-15);
  EXPECT_NEAR(norm(rod.missing()), 0.0, 1e-15);
}

}  // namespace
