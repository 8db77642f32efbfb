// Bodies that are level with each other, pair by pair; CMB_ALIGNED poses a pair instead of the many of the full tier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ostream>
#include <string>
#include <vector>

#include "aligned/aligned_samples.hpp"

namespace test_aligned {
namespace {

using namespace cmb::aligned;

struct Pair {
  KindPair kinds;
};

void PrintTo(const Pair &pair, std::ostream *stream) { *stream << pair.kinds.a->name << ", " << pair.kinds.b->name; }

std::vector<Pair> pairs() {
  std::vector<Pair> result;
  for (const KindPair &kinds : all_pairs()) result.push_back({kinds});
  return result;
}

std::string name_of_pair(const testing::TestParamInfo<Pair> &info) {
  std::string name = std::string(info.param.kinds.a->name) + "On" + info.param.kinds.b->name;
  for (char &letter : name) letter = letter == '-' ? '_' : letter;
  return name;
}

class Aligned : public testing::TestWithParam<Pair> {};

void expect_none_fails(const KindPair &kinds, int of_all, std::uint64_t seed) {
  const int poses = static_cast<int>(std::ceil(of_all * std::min(kinds.a->part, kinds.b->part)));
  const Tally tally = sample_aligned(kinds, poses, seed);
  EXPECT_GT(tally.poses, poses / 8);
  for (int k = 0; k < property_count; ++k) {
    const auto property = static_cast<Property>(k);
    const Tally::Failures &of = tally[property];
    const KnownFailure *known = known_failure(kinds, property);
    if (known != nullptr && of.count > 0) {
      std::printf("known to fail: %s, %s: %s in %d of %d poses, the worst by %.1e of what is allowed, pose %d of seed %d\n", kinds.a->name, kinds.b->name,
                  name_of(property), of.count, tally.poses, of.worst, of.worst_pose, static_cast<int>(seed));
    }
    // As many as that share has, and as chance adds.
    const double expected = known != nullptr ? known->share * poses : 0.0;
    EXPECT_LE(of.count, known != nullptr ? 1.0 + expected + 2.0 * std::sqrt(expected) : 0.0)
        << name_of(property) << ", the worst by " << of.worst << " of what is allowed: sample_aligned --seed " << seed << " --pose " << of.worst_pose << " "
        << kinds.a->name << " " << kinds.b->name;
  }
}

TEST_P(Aligned, ContactsAreAsInAnyPose) { expect_none_fails(GetParam().kinds, 40, 1); }

TEST_P(Aligned, ContactsAreAsInAnyPoseInMany) {
  const char *const asked = std::getenv("CMB_ALIGNED");
  expect_none_fails(GetParam().kinds, asked != nullptr ? std::atoi(asked) : 800, 2);
}

INSTANTIATE_TEST_SUITE_P(All, Aligned, testing::ValuesIn(pairs()), name_of_pair);

}  // namespace
}  // namespace test_aligned
