// Loads shared by contacts of one ball: the conditions of Karush, Kuhn and Tucker, whatever the contacts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "mesh/contact/shared_load.hpp"
#include "support/random_bodies.hpp"

namespace test_shared_load {
namespace {

using cmb::convex::Vec3;
using cmb::mesh::SharedLoad;

// Loads maximise sum load_i depth_i - 1/2 load . G load within their bounds just where the slope is 0 between the
// bounds, not above 0 at the lower and not below 0 at the upper bound.
void expect_optimal(const SharedLoad &shared) {
  double deepest = 0.0;
  for (std::size_t i = 0; i < shared.size(); ++i) deepest = std::fmax(deepest, shared[i].depth);
  const double slack = 1e-9 * deepest;
  for (std::size_t i = 0; i < shared.size(); ++i) {
    const SharedLoad::Contact &contact = shared[i];
    const double limit = contact.depth;
    ASSERT_GE(contact.load, 0.0);
    ASSERT_LE(contact.load, limit);
    double slope = contact.depth;
    for (std::size_t j = 0; j < shared.size(); ++j) {
      slope -= (i == j ? 1.0 : (1.0 - 1e-6) * dot(contact.normal, shared[j].normal)) * shared[j].load;
    }
    if (contact.load < limit - slack) {
      EXPECT_LE(slope, slack) << "contact " << i << " of " << shared.size();
    }
    if (contact.load > slack) {
      EXPECT_GE(slope, -slack) << "contact " << i << " of " << shared.size();
    }
  }
}

TEST(SharedLoad, IsOptimalForAnyContacts) {
  random_bodies::Random random(1);
  for (int trial = 0; trial < 3000; ++trial) {
    SharedLoad shared;
    const int count = random.integer(1, 12);
    // Narrow cones of normals, wide ones, opposite contacts.
    const double spread = random.log_uniform(1e-3, 10);
    const Vec3 axis = random.direction();
    for (int i = 0; i < count; ++i) {
      SharedLoad::Contact contact;
      contact.depth = random.log_uniform(1e-4, 1);
      contact.normal = normalized(axis + spread * random.direction());
      contact.position = random.direction();
      shared.add(contact, 1e-9);
    }
    shared.solve();
    expect_optimal(shared);
    if (testing::Test::HasFailure()) FAIL() << "trial " << trial;
  }
}

TEST(SharedLoad, OneContactCarriesItsDepthAndTwinsCountOnce) {
  SharedLoad shared;
  SharedLoad::Contact contact;
  contact.normal = {0, 0, 1};
  contact.depth = 0.1;
  shared.add(contact, 1e-9);
  contact.depth = 0.2;
  shared.add(contact, 1e-9);  // the deeper of the two stays
  contact.depth = 0.05;
  shared.add(contact, 1e-9);
  ASSERT_EQ(shared.size(), 1u);
  shared.solve();
  EXPECT_DOUBLE_EQ(shared[0].load, 0.2);
  shared.clear();
  shared.solve();
  EXPECT_EQ(shared.size(), 0u);
}

TEST(SharedLoad, RightAnglesCarryFullyAndParallelOnesTogetherWhatOneWould) {
  SharedLoad shared;
  SharedLoad::Contact contact;
  contact.depth = 0.1;
  contact.normal = {0, 0, 1};
  shared.add(contact, 1e-9);
  contact.position = {1, 0, 0};
  shared.add(contact, 1e-9);
  contact.normal = {1, 0, 0};
  shared.add(contact, 1e-9);
  ASSERT_EQ(shared.size(), 3u);
  shared.solve();
  EXPECT_NEAR(shared[0].load + shared[1].load, 0.1, 1e-6);
  EXPECT_NEAR(shared[2].load, 0.1, 1e-12);
}

TEST(SharedLoad, OfTooManyTheDeepestStay) {
  SharedLoad shared;
  random_bodies::Random random(2);
  std::vector<double> depths;
  for (std::size_t i = 0; i < SharedLoad::capacity + 20; ++i) {
    SharedLoad::Contact contact;
    contact.depth = depths.emplace_back(random.uniform(0.1, 1));
    contact.normal = random.direction();
    contact.position = random.direction();
    shared.add(contact, 1e-9);
  }
  ASSERT_EQ(shared.size(), SharedLoad::capacity);
  std::sort(depths.rbegin(), depths.rend());
  std::vector<double> kept;
  for (std::size_t i = 0; i < shared.size(); ++i) kept.push_back(shared[i].depth);
  std::sort(kept.rbegin(), kept.rend());
  depths.resize(SharedLoad::capacity);
  EXPECT_EQ(kept, depths);
  shared.solve();
  expect_optimal(shared);
}

}  // namespace
}  // namespace test_shared_load
