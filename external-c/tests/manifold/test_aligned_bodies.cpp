// Convex bodies in poses that users have: axes along each other's or at half right angles, spun about their own axis or not, sizes and places round numbers, so that faces
// lie in faces, edges in edges and axes pass through corners, by rounding.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_aligned_bodies {
namespace {

using namespace cmb::test;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;

struct Body {
  std::string text;
  double least;  // of its lengths
};

Body any_body(Random &random, const std::string &kind) {
  const auto length = [&] { return random.integer(0, 1) == 1 ? 0.1 * random.integer(1, 8) : random.log_uniform(0.02, 1.0); };
  const double a = length(), b = length(), c = length();
  if (kind == "box" || kind == "ellipsoid") {
    return {"cmb/1 " + kind + " size=" + digits(a) + "," + digits(b) + "," + digits(c), std::min({a, b, c})};
  }
  if (kind == "sphere") return {"cmb/1 sphere radius=" + digits(0.5 * a), a};
  if (kind == "octahedron") {
    const std::string x = digits(a), y = digits(b), z = digits(c);
    return {"cmb/1 hull vertices=" + x + ",0,0,-" + x + ",0,0,0," + y + ",0,0,-" + y + ",0,0,0," + z + ",0,0,-" + z,
            0.5 * std::min({a, b, c})};
  }
  return {"cmb/1 " + kind + " radius=" + digits(0.5 * a) + " length=" + digits(b), std::min(a, b)};
}

Mat3 any_aligned(Random &random) {
  Mat3 rotation;
  for (const Vec3 &axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const int turn = random.integer(0, 2) > 0 ? 2 * random.integer(0, 3) : random.integer(0, 7);
    rotation = product(rotation_about(axis, 0.25 * pi * turn), rotation);
  }
  const bool spins = random.integer(0, 2) == 0;
  return spins ? product(rotation, rotation_about({0, 0, 1}, random.uniform(0, 2 * pi))) : rotation;
}

using Kinds = std::tuple<std::string, std::string>;

// By their names.
class AlignedBodies : public testing::TestWithParam<Kinds> {};

// What is asked of a pair: the load is that of one of the poses next to it, so that rounding adds nothing to what shifts change; and no pair
// carries much more than its depth.
void expect_regular(const Kinds &kinds, std::uint64_t seed, int poses, double least_depth, double most_load) {
  Random random(seed);
  int touching = 0;
  for (int k = 0; k < poses; ++k) {
    const Body a = any_body(random, std::get<0>(kinds)), b = any_body(random, std::get<1>(kinds));
    const PairScene scene(a.text, b.text);
    const double deep = std::min(a.least, b.least) * random.log_uniform(least_depth, 0.3);
    const Mat3 rotation = any_aligned(random);
    const bool above = random.integer(0, 1) == 1;
    const Vec3 way = above ? Vec3{0, 0, 1} : random.direction();
    // Where a cone's tip is on another one's axis, which way it slips off is left to rounding (docs/engine/limits.md).
    const bool cones = kinds == Kinds("cone", "cone");
    const auto aside = [&] {
      if (cones) return random.uniform(-0.2, 0.2);
      return above && random.integer(0, 1) == 1 ? 0.05 * random.integer(-6, 6) : 0.0;
    };
    const double x = aside(), y = aside();
    BodyPose pose{Vec3{x, y, 0} + 3.0 * way, rotation};
    bool reached = false;
    for (int step = 0; step < 80 && !reached && dot(pose.position, way) > -2.0; ++step) {  // it may pass by
      const double more = scene.query(pose, {}, 64).distance + deep;
      reached = std::fabs(more) < 1e-2 * deep;
      if (!reached) pose.position = pose.position - more * way;
    }
    if (reached) {
      ++touching;
      const auto load_beside = [&](double shift) {
        const BodyPose beside{pose.position + shift * random.direction(),
                              product(rotation_about(random.direction(), shift), rotation)};
        return scene.query(beside, {}, 64).load();
      };
      const Contact contact = scene.query(pose, {}, 64);
      double all = 0.0;
      for (const Point &point : contact.points) all += point.weight * point.depth;
      EXPECT_GT(all, 0.0) << k << " " << a.text << "; " << b.text;
      EXPECT_LT(all, most_load * deep) << k << " " << a.text << "; " << b.text << ", " << deep << " deep";
      constexpr double shift = 1e-10;
      double change = HUGE_VAL;
      for (int beside = 0; beside < 10; ++beside) change = std::min(change, norm(load_beside(shift) - contact.load()));
      EXPECT_LT(change, all * (1e-3 + 1000.0 * shift / deep)) << k << " " << a.text << "; " << b.text << ", " << deep << " deep";
    }
    cmb_release_scene(scene.handle());
  }
  EXPECT_GT(touching, poses / 2);
}

TEST_P(AlignedBodies, CarryWhatTheirNeighboursDo) { expect_regular(GetParam(), 1, 200, 1e-5, 10.0); }

TEST_P(AlignedBodies, CarryWhatTheirNeighboursDoInManyPoses) { expect_regular(GetParam(), 2, 4000, 1e-5, 10.0); }

const std::string kinds[] = {"box", "octahedron", "sphere", "capsule", "ellipsoid", "cylinder", "cone"};

INSTANTIATE_TEST_SUITE_P(All, AlignedBodies, testing::Combine(testing::ValuesIn(kinds), testing::ValuesIn(kinds)),
                         [](const auto &info) {
                           return std::get<0>(info.param) + "On" + std::get<1>(info.param);
                         });

}  // namespace
}  // namespace test_aligned_bodies
