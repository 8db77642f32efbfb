// Pairs far apart by their bounding spheres, beside exact distances: exact_within of cmb_query_scene.
#include <algorithm>
#include <limits>

#include "support/engine_calls.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_exact_within {
namespace {

using namespace cmb::test;

constexpr std::size_t capacity = 4;

struct Answer {
  double distance = 0.0;
  double depth[capacity], weight[capacity], normal[3 * capacity], point[3 * capacity];

  Vec3 first_normal() const { return {normal[0], normal[1], normal[2]}; }
};

// `exact_within` of 0 asks for exact distances.
Answer ask(cmb_scene scene, double exact_within, const BodyPose &a, const BodyPose &b) {
  const PairPoses poses(a, b);
  Answer answer;
  const cmb_status status =
      query_scene(scene, poses.position, poses.rotation, 2, 1, capacity, &answer.distance, answer.depth, answer.weight,
                  answer.normal, answer.point, exact_within > 0.0 ? exact_within : HUGE_VAL);
  EXPECT_EQ(status, CMB_OK) << cmb_last_error();
  return answer;
}

const std::vector<std::string> bodies = {
    "cmb/1 sphere radius=0.3 position=0.1,0.2,0.3",
    "cmb/1 box size=0.4,0.6,1",
    "cmb/1 capsule radius=0.1 length=0.8",
    "cmb/1 hull vertices=0.5,0,0,-0.4,0.1,0,0,0.5,0.1,0,-0.5,0,0,0,0.7",
    "cmb/1 cylinder radius=0.3 length=0.6",
    "cmb/1 sphere radius=0.2;cmb/1 box size=0.2,0.2,1 position=0.3,0,0.2",
    "cmb/1 halfspace position=0,0,-0.4",
};

class Within : public testing::TestWithParam<std::size_t> {};

TEST_P(Within, IsALowerBoundOfTheSameSignAndExactNearby) {
  const double near = 0.4;
  random_bodies::Random random(3);
  int exact = 0, falling_smoothstep = 0, far = 0;
  for (const std::string &other : bodies) {
    if (GetParam() + 1 == bodies.size() && &other == &bodies.back()) continue;  // half-spaces never touch
    const PairScene scene(bodies[GetParam()], other);
    for (int k = 0; k < 400; ++k) {
      const BodyPose a{random.uniform(0.0, 3.0) * random.direction(), random_bodies::random_rotation(random)};
      const BodyPose b{{}, random_bodies::random_rotation(random)};
      const Answer full = ask(scene.handle(), 0.0, a, b), within = ask(scene.handle(), near, a, b);
      ASSERT_LE(within.distance, full.distance + 1e-12) << other << " " << k;
      ASSERT_EQ(within.distance < 0.0, full.distance < 0.0) << other << " " << k;
      ASSERT_NEAR(norm(within.first_normal()), 1.0, 1e-12);
      if (full.distance <= near) {  // so is the gap between the spheres
        ++exact;
        ASSERT_EQ(within.distance, full.distance) << other << " " << k;
        ASSERT_TRUE(std::equal(full.depth, full.depth + capacity, within.depth));
        ASSERT_TRUE(std::equal(full.weight, full.weight + capacity, within.weight));
        ASSERT_TRUE(std::equal(full.normal, full.normal + 3 * capacity, within.normal));
        ASSERT_TRUE(std::equal(full.point, full.point + 3 * capacity, within.point));
      } else {
        ASSERT_GE(within.distance, near) << other << " " << k;
        (within.distance < 2.0 * near ? falling_smoothstep : far) += 1;
      }
    }
  }
  EXPECT_GT(exact, 100);
  EXPECT_GT(falling_smoothstep, 20);
  EXPECT_GT(far, 100);
}

TEST_P(Within, FollowsTheMotionWithoutJumps) {
  const PairScene scene(bodies[GetParam()], "cmb/1 box size=0.5,0.3,0.9");
  const auto at = [&](double s) {
    // Straight away from the box, turning.
    return ask(scene.handle(), 0.3, {{0.3 * s, 0.2 * s, 0.2 + 3.0 * s}, rotation_about({0.6, 0, 0.8}, 2.0 * s)}, {});
  };
  // Of compounds the nearest shape changes, and with it normal and point.
  const bool compound = bodies[GetParam()].find(';') != std::string::npos;
  const auto change = [&](const Answer &x, const Answer &y) {
    double sum = std::fabs(x.distance - y.distance);
    if (compound) return sum;
    sum += norm(x.first_normal() - y.first_normal());
    for (int i = 0; i < 3; ++i) sum += std::fabs(x.point[3 * (capacity - 1) + i] - y.point[3 * (capacity - 1) + i]);
    return sum;
  };
  constexpr int samples = 400;
  for (int k = samples / 4; k < samples; ++k) {  // apart
    double begin = static_cast<double>(k) / samples, end = static_cast<double>(k + 1) / samples;
    if (ask(scene.handle(), 0.0, {{0.3 * begin, 0.2 * begin, 0.2 + 3.0 * begin}, rotation_about({0.6, 0, 0.8}, 2.0 * begin)}, {})
            .distance < 0.25) {
      continue;  // the nearest points of faces that turn through parallel do jump, of every distance
    }
    for (int halving = 0; halving < 20; ++halving) {
      const double middle = 0.5 * (begin + end);
      (change(at(begin), at(middle)) > change(at(middle), at(end)) ? end : begin) = middle;
    }
    ASSERT_LT(change(at(begin), at(end)), 1e-6) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, Within, testing::Range<std::size_t>(0, 6));

TEST(WithinArguments, NeedAPositiveLength) {
  const PairScene scene(bodies[0], bodies[1]);
  const double position[6] = {}, rotation[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const double bad : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    Answer answer;
    answer.distance = 7.0;
    EXPECT_EQ(query_scene(scene.handle(), position, rotation, 2, 1, capacity, &answer.distance, answer.depth,
                          answer.weight, answer.normal, answer.point, bad),
              CMB_ERROR_ARGUMENT);
    EXPECT_EQ(answer.distance, 7.0);
  }
}

// Bounding spheres about one middle have no direction between them; what they bound overlaps.
TEST(Within, BodiesAboutOneMiddleAreAnsweredExactly) {
  for (const std::string &body : {bodies[1], bodies[2], bodies[4]}) {
    const PairScene scene(body, "cmb/1 box size=0.5,0.5,0.5");
    const Answer full = ask(scene.handle(), 0.0, {}, {}), within = ask(scene.handle(), 0.1, {}, {});
    EXPECT_LT(full.distance, 0.0) << body;
    EXPECT_EQ(within.distance, full.distance) << body;
    EXPECT_EQ(norm(within.first_normal() - full.first_normal()), 0.0) << body;
  }
}

// Rods side by side, whose bounding spheres overlap, and a rod over a half-space: their boxes tell.
TEST(Within, SlenderBodiesAreBoundedByTheirBoxes) {
  const std::string rod = "cmb/1 cylinder radius=0.05 length=2";
  const BodyPose beside{{0.4, 0, 0}, rotation_about({0, 0, 1}, 0.0)};
  EXPECT_NEAR(ask(PairScene(rod, rod).handle(), 0.01, beside, {}).distance, 0.3, 1e-12);
  const BodyPose lying{{0, 0, 0.4}, rotation_about({0, 1, 0}, 0.5 * std::acos(-1.0))};
  EXPECT_NEAR(ask(PairScene(rod, "cmb/1 halfspace").handle(), 0.01, lying, {}).distance, 0.35, 1e-12);
}

// Whatever order a compound's shapes are asked in, the nearest ones tell; of bodies far apart their own bounds do.
TEST(Within, CompoundsAreAsNearAsTheirNearestShapes) {
  const double near = 0.02;
  random_bodies::Random random(11);
  const auto pieces = [&] {
    std::vector<std::string> found;
    for (int k = 0; k < 5; ++k) {
      const Vec3 at = random.uniform(0.0, 0.6) * random.direction();
      found.push_back((k % 2 == 0 ? "box size=0.1,0.2,0.5" : "cylinder radius=0.05 length=0.4") + std::string(" position=") +
                      std::to_string(at.x) + "," + std::to_string(at.y) + "," + std::to_string(at.z));
    }
    return found;
  };
  const auto body = [](const std::vector<std::string> &shapes) {
    std::string text;
    for (const std::string &shape : shapes) text += (text.empty() ? "cmb/1 " : ";cmb/1 ") + shape;
    return text;
  };
  int by_shapes = 0, by_bodies = 0;
  for (int k = 0; k < 200; ++k) {
    const std::vector<std::string> one = pieces(), other = pieces();
    const BodyPose a{random.uniform(0.0, 3.0) * random.direction(), random_bodies::random_rotation(random)};
    double least = HUGE_VAL, least_bound = HUGE_VAL;
    for (const std::string &mine : one) {
      for (const std::string &theirs : other) {
        const PairScene scene("cmb/1 " + mine, "cmb/1 " + theirs);
        least = std::fmin(least, ask(scene.handle(), 0.0, a, {}).distance);
        least_bound = std::fmin(least_bound, ask(scene.handle(), near, a, {}).distance);
      }
    }
    const PairScene scene(body(one), body(other));
    EXPECT_EQ(ask(scene.handle(), 0.0, a, {}).distance, least) << k;
    const double within = ask(scene.handle(), near, a, {}).distance;
    EXPECT_LE(within, least_bound + 1e-12) << k;
    if (within == least_bound) {
      ++by_shapes;
    } else {
      EXPECT_GT(within, near) << k;  // so is the gap between the bodies' bounds
      ++by_bodies;
    }
  }
  EXPECT_GT(by_shapes, 30);
  EXPECT_GT(by_bodies, 30);
}

// A half-space among the shapes has no bounds: its plane tells.
TEST(Within, CompoundsWithHalfSpacesAreAskedShapeByShape) {
  const PairScene scene("cmb/1 box size=0.2,0.2,0.2;cmb/1 box size=0.2,0.2,0.2 position=0.5,0,0",
                        "cmb/1 halfspace;cmb/1 sphere radius=0.1 position=0,0,-1");
  EXPECT_NEAR(ask(scene.handle(), 0.01, {{0, 0, 2}, rotation_about({0, 0, 1}, 0.3)}, {}).distance, 1.9, 1e-12);
}

}  // namespace
}  // namespace test_exact_within
