// Bodies that pass through each other between the ends of a step: closed forms, and random ways against a look at each place.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "contact_multibody_scene.h"
#include "math/vector3.hpp"

namespace {

using cmb::convex::Vec3;

// How a body moves at constant velocity and rate about a unit axis through its origin.
struct Path {
  std::string geometry;
  Vec3 start, velocity, axis{0, 0, 1};
  double rate = 0.0;
  bool fixed = false;
};

void put_motion(const std::vector<Path> &paths, double time, double *motion) {
  const std::size_t n = paths.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Path &path = paths[i];
    const Vec3 place = path.start + time * path.velocity, w = path.rate * path.axis, &u = path.axis;
    const double angle = path.rate * time, c = std::cos(angle), s = std::sin(angle);
    for (int k = 0; k < 3; ++k) {
      motion[3 * i + k] = place[k];
      motion[12 * n + 3 * i + k] = path.velocity[k];
      motion[15 * n + 3 * i + k] = w[k];
      Vec3 axis;  // of the body, in the world
      axis.set(k, 1.0);
      const Vec3 turned = c * axis + s * cross(u, axis) + (1.0 - c) * dot(u, axis) * u;
      for (int j = 0; j < 3; ++j) motion[3 * n + 9 * i + 3 * k + j] = turned[j];
    }
  }
}

// Asks the engine for a step from time 0 on, both ways: as pairs of a scene and through a broad phase.
class Step {
 public:
  Step(std::vector<Path> paths, double duration) : paths_(std::move(paths)), duration_(duration) {
    std::vector<const char *> geometry;
    std::vector<int> pairs, fixed;
    for (std::size_t i = 0; i < paths_.size(); ++i) {
      geometry.push_back(paths_[i].geometry.c_str());
      fixed.push_back(paths_[i].fixed);
      for (std::size_t j = 0; j < i; ++j) {
        pairs.push_back(static_cast<int>(j) + 1);
        pairs.push_back(static_cast<int>(i) + 1);
      }
    }
    cmb_scene_source source{};
    source.geometry = geometry.data();
    source.body_count = geometry.size();
    source.pairs = pairs.data();
    source.pair_count = pairs.size() / 2;
    EXPECT_EQ(cmb_intern(&source, &scene_), CMB_OK) << cmb_last_error();
    cmb_collision_filter filter{};
    filter.body_count = geometry.size();
    filter.fixed = fixed.data();
    EXPECT_EQ(cmb_intern_broadphase(scene_, &filter, &broadphase_), CMB_OK) << cmb_last_error();
  }
  ~Step() {
    cmb_release_broadphase(broadphase_);
    cmb_release_scene(scene_);
  }
  Step(const Step &) = delete;
  Step &operator=(const Step &) = delete;

  cmb_passage find() {
    std::vector<double> begin(18 * paths_.size()), end = begin;
    put_motion(paths_, 0.0, begin.data());
    put_motion(paths_, duration_, end.data());
    const cmb_step step{paths_.size(), duration_, begin.data(), end.data(), at, this};
    cmb_passage passage{}, other{};
    calls = 0;
    EXPECT_EQ(cmb_find_passage(scene_, &step, &passage), CMB_OK) << cmb_last_error();
    EXPECT_EQ(cmb_find_passage_among(broadphase_, nullptr, 0, &step, &other), CMB_OK) << cmb_last_error();
    EXPECT_EQ(passage.body_a == 0, other.body_a == 0);
    EXPECT_EQ(passage.share, other.share);
    return passage;
  }

  // Signed distance of the first pair.
  double distance(double share) const {
    std::vector<double> motion(18 * paths_.size());
    put_motion(paths_, share * duration_, motion.data());
    double distance = 0, depth = 0, weight = 0, normal[3], point[3];
    const cmb_poses poses{paths_.size(), motion.data(), motion.data() + 3 * paths_.size()};
    const cmb_contact_points points{1, 1, &distance, &depth, &weight, normal, point};
    EXPECT_EQ(cmb_query_pair(scene_, 1, &poses, &points), CMB_OK) << cmb_last_error();
    return distance;
  }

  int calls = 0;
  bool fails = false;

 private:
  static int at(void *context, double share, double *motion) {
    Step &self = *static_cast<Step *>(context);
    ++self.calls;
    put_motion(self.paths_, share * self.duration_, motion);
    return self.fails ? 1 : 0;
  }

  std::vector<Path> paths_;
  double duration_;
  cmb_scene scene_{};
  cmb_broadphase broadphase_{};
};

const std::string ball = "cmb/1 sphere radius=0.01", plate = "cmb/1 box size=0.002,0.5,0.5";

TEST(Passage, BallsThatJumpOverEachOtherMeetWhereTheirGapCloses) {
  Step step({{ball, {-0.3, 0, 0}, {50, 0, 0}}, {ball, {0.5, 0, 0}, {-150, 0, 0}}}, 0.01);
  const cmb_passage passage = step.find();
  EXPECT_EQ(passage.body_a, 1);
  EXPECT_EQ(passage.body_b, 2);
  EXPECT_NEAR(passage.share, (0.78 + 2e-8) / 200 / 0.01, 1e-8);
  EXPECT_DOUBLE_EQ(passage.thickness, 0.02);
  EXPECT_NEAR(passage.speed, 200, 1e-9);
}

TEST(Passage, OfTwoMeetingsTheFirstIsFound) {
  Step step({{plate, {0.4, 0, 0}, {}, {0, 0, 1}, 0, true}, {ball, {-0.3, 0, 0}, {100, 0, 0}}, {plate, {0.1, 0, 0}, {}, {0, 0, 1}, 0, true}},
            0.02);
  const cmb_passage passage = step.find();
  EXPECT_EQ(passage.body_a, 2);
  EXPECT_EQ(passage.body_b, 3);
  EXPECT_NEAR(passage.share, (0.4 - 0.011) / 100 / 0.02, 1e-7);
}

TEST(Passage, BallsThatMissEachOtherDoNotMeet) {
  Step step({{ball, {-0.3, 0.0201, 0}, {50, 0, 0}}, {ball, {0.5, 0, 0}, {-50, 0, 0}}}, 0.02);
  EXPECT_EQ(step.find().body_a, 0);
}

// The time of the end may lie within a step of the integrator, which knows nothing of the contact.
TEST(Passage, BodiesThatLieInEachOtherAtTheEndHaveMetBefore) {
  for (const double later : {1e-6, 2e-4}) {
    Step step({{ball, {-0.3, 0, 0}, {50, 0, 0}}, {plate, {}, {}, {0, 0, 1}, 0, true}}, 0.289 / 50 + later);
    const cmb_passage passage = step.find();
    ASSERT_EQ(passage.body_a, 1);
    EXPECT_NEAR(step.distance(passage.share), 0.0, 4e-9);
  }
}

TEST(Passage, SlowContactsAreNotToldOf) {
  Step step({{ball, {-0.0112, 0, 0}, {50, 0, 0}}, {plate, {}, {}, {0, 0, 1}, 0, true}}, 0.0004 / 50);
  EXPECT_EQ(step.find().body_a, 0);
  EXPECT_EQ(step.calls, 0);
}

// A rod of 1 m that turns wholly is where it was. It has swept a ball at three quarters of its length.
TEST(Passage, ATurningRodSweepsABall) {
  const std::string rod = "cmb/1 capsule radius=0.005 length=1";
  const double rate = 100, period = 2 * 3.14159265358979323846 / rate;
  Step step({{rod, {}, {}, {1, 0, 0}, rate}, {"cmb/1 sphere radius=0.004", {0, 0.375, 0}, {}}}, period);
  const cmb_passage passage = step.find();
  ASSERT_EQ(passage.body_a, 1);
  EXPECT_NEAR(step.distance(passage.share), 0.0, 1e-7);
  EXPECT_NEAR(passage.share, 0.25 - std::asin(0.009 / 0.375) / (rate * period), 1e-6);
}

TEST(Passage, FastButHarmlessMotionCostsNoLookInBetween) {
  const std::string disc = "cmb/1 cylinder radius=0.03 length=0.01", floor = "cmb/1 halfspace";
  Step spinning({{disc, {0, 0, 0.005}, {}, {0, 0, 1}, 2000}, {floor, {}, {}, {0, 0, 1}, 0, true}}, 0.01);
  EXPECT_EQ(spinning.find().body_a, 0);
  EXPECT_EQ(spinning.calls, 0);
  Step sliding({{"cmb/1 box size=0.1,0.1,0.1", {0, 0, 0.05}, {100, 0, 0}}, {floor, {}, {}, {0, 0, 1}, 0, true}}, 0.1);
  EXPECT_EQ(sliding.find().body_a, 0);
  EXPECT_EQ(sliding.calls, 0);
  Step wheel({{"cmb/1 cylinder radius=0.3 length=0.05", {0, 0, 0}, {}, {0, 0, 1}, 500}, {ball, {0.5, 0, 0}, {}}}, 0.1);
  EXPECT_EQ(wheel.find().body_a, 0);
  EXPECT_EQ(wheel.calls, 0);
}

// A body that lies on another one and is torn through it: the next step is to get ahead.
TEST(Passage, BodiesThatTouchAtTheBeginningAreFoundALittleDeeper) {
  Step step({{ball, {-0.010999, 0, 0}, {50, 0, 0}}, {plate, {}, {}, {0, 0, 1}, 0, true}}, 0.01);
  const cmb_passage passage = step.find();
  ASSERT_EQ(passage.body_a, 1);
  EXPECT_LT(step.distance(passage.share), -1e-6 - 1e-9);
  EXPECT_GT(step.distance(passage.share), -1e-5);
}

TEST(Passage, WhereMotionIsUnknownNothingIsFound) {
  Step step({{ball, {-0.3, 0, 0}, {50, 0, 0}}, {plate, {}, {}, {0, 0, 1}, 0, true}}, 0.01);
  step.fails = true;
  EXPECT_EQ(step.find().body_a, 0);
  EXPECT_GT(step.calls, 0);
}

TEST(Passage, WrongArgumentsAreRefused) {
  Step known({{ball, {}, {}}, {ball, {1, 0, 0}, {}}}, 1.0);
  cmb_passage passage{};
  EXPECT_EQ(cmb_find_passage({12345}, nullptr, &passage), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb_find_passage_among({12345}, nullptr, 0, nullptr, &passage), CMB_ERROR_ARGUMENT);
  double motion[18] = {};
  const cmb_step step{1, 1.0, motion, motion, nullptr, nullptr};
  cmb_scene_source source{};
  const char *geometry[] = {ball.c_str()};
  source.geometry = geometry;
  source.body_count = 1;
  cmb_scene scene{};
  ASSERT_EQ(cmb_intern(&source, &scene), CMB_OK);
  EXPECT_EQ(cmb_find_passage(scene, &step, &passage), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb_find_passage(scene, &step, nullptr), CMB_ERROR_ARGUMENT);
  cmb_release_scene(scene);
}

// Against a look at 2000 places of the step: what overlaps noticeably there more than at the ends is found, and where it is found
// bodies begin to touch.
TEST(Passage, RandomWaysAreFoundAsALookEverywhereFindsThem) {
  std::mt19937 random(7);
  const auto uniform = [&](double low, double high) { return low + (high - low) * (random() / 4294967296.0); };
  const std::string kinds[] = {ball,
                               plate,
                               "cmb/1 capsule radius=0.005 length=0.3",
                               "cmb/1 cylinder radius=0.05 length=0.01",
                               "cmb/1 cone radius=0.05 length=0.08",
                               "cmb/1 sphere radius=0.01 position=0.1,0,0;cmb/1 box size=0.01,0.02,0.2",
                               "cmb/1 ellipsoid size=0.02,0.06,0.1"};
  int found = 0, missed = 0;
  for (int sample = 0; sample < 400; ++sample) {
    std::vector<Path> paths;
    for (int k = 0; k < 2; ++k) {
      const auto vector = [&](double size) { return Vec3{uniform(-size, size), uniform(-size, size), uniform(-size, size)}; };
      Path path{kinds[random() % 7], vector(0.3), {}, normalized(vector(1.0)), uniform(-30, 30)};
      path.velocity = 10.0 * (vector(0.15) - path.start);
      paths.push_back(path);
    }
    Step step(paths, 0.2);
    double deepest = 0.0;
    constexpr int places = 2000;
    for (int k = 0; k <= places; ++k) deepest = std::fmax(deepest, -step.distance(static_cast<double>(k) / places));
    const double at_ends = std::fmax(0.0, std::fmax(-step.distance(0.0), -step.distance(1.0)));
    const cmb_passage passage = step.find();
    if (passage.body_a != 0) {
      ++found;
      if (step.distance(0.0) > 0.0) EXPECT_NEAR(step.distance(passage.share), 0.0, 0.016 * passage.thickness) << "sample " << sample;
      EXPECT_GT(deepest, 0.0) << "sample " << sample;
    } else {
      missed += deepest > at_ends + 0.05 * 0.02;
    }
  }
  EXPECT_GT(found, 50);
  EXPECT_EQ(missed, 0);
}

}  // namespace
