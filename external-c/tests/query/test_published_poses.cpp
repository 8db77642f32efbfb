// Poses at which other libraries failed.
#include "stress/certificates.hpp"
#include "support/published_poses.hpp"
#include "support/scene_query.hpp"

namespace test_published_poses {
namespace {

using namespace cmb::test;

// The body of a descriptor of one box or hull, as points; none of others.
std::vector<Vec3> points_of(const std::string &text) {
  std::vector<double> numbers;
  const bool box = text.find(" box ") != std::string::npos;
  if (!box && text.find(" hull ") == std::string::npos) return {};
  for (std::size_t at = text.find('=') + 1; at < text.size(); ++at) {
    numbers.push_back(std::strtod(text.c_str() + at, nullptr));
    at = std::min(text.find(',', at), text.size());
  }
  if (box) return cmb::stress::detail::box_corners({0.5 * numbers[0], 0.5 * numbers[1], 0.5 * numbers[2]});
  std::vector<Vec3> points;
  for (std::size_t k = 0; k + 2 < numbers.size(); k += 3) points.push_back({numbers[k], numbers[k + 1], numbers[k + 2]});
  return points;
}

class Published : public testing::TestWithParam<cmb_backend> {};

TEST(PublishedPoses, AreAnswered) {
  for (const PublishedPose &p : published_poses()) {
    const PairScene scene(p.a, p.b);
    const Contact contact = scene.query(p.pose_a, p.pose_b), reversed = PairScene(p.b, p.a).query(p.pose_b, p.pose_a);
    EXPECT_NEAR(contact.distance, reversed.distance, 1e-9) << p.source;
    EXPECT_EQ(contact.distance < 0.0, norm(contact.load()) > 0.0) << p.source;
    if (!std::isnan(p.distance)) {
      EXPECT_NEAR(contact.distance, p.distance, 1e-9) << p.source;
    }
  }
}

// A library that is named answers itself, too deep where it does not find the minimum translation, but never misses a
// contact, nor the distance of bodies apart.
TEST_P(Published, NoContactIsMissed) {
  for (const PublishedPose &p : published_poses()) {
    const Contact contact = PairScene(p.a, p.b, GetParam()).query(p.pose_a, p.pose_b);
    const double truth = PairScene(p.a, p.b).query(p.pose_a, p.pose_b).distance;
    EXPECT_LE(contact.distance, truth + 5e-4) << p.source;
    EXPECT_EQ(contact.distance < 0.0, norm(contact.load()) > 0.0) << p.source;
    if (truth < 0.0) {
      EXPECT_LT(contact.distance, 0.0) << p.source;
    } else {
      EXPECT_NEAR(contact.distance, truth, 5e-4) << p.source;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Published, testing::Values(CMB_BACKEND_LIBCCD, CMB_BACKEND_FCL));

TEST(PublishedPoses, OfBoxesAndHullsAreAsDeepAsTheSeparatingAxesSay) {
  int overlapping = 0;
  for (const PublishedPose &p : published_poses()) {
    cmb::stress::Part a, b;
    a.points = points_of(p.a);
    b.points = points_of(p.b);
    if (a.points.empty() || b.points.empty()) continue;
    const double gap = cmb::stress::greatest_gap(a, cmb::stress::axes_of(a.points), {p.pose_a.rotation, p.pose_a.position},
                                                 b, cmb::stress::axes_of(b.points), {p.pose_b.rotation, p.pose_b.position});
    const double distance = PairScene(p.a, p.b).query(p.pose_a, p.pose_b).distance;
    if (gap > 0.0) {
      EXPECT_GT(distance, gap - 1e-12) << p.source;
    } else {
      EXPECT_NEAR(distance, gap, 1e-12) << p.source;
      ++overlapping;
    }
  }
  EXPECT_GE(overlapping, 8);
}

}  // namespace
}  // namespace test_published_poses
