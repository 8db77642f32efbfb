// Curved bodies turn over each other, over boxes and hulls, and off their borders, without jumps of load and moment.
#include "support/path_sums.hpp"

namespace test_curved_continuity {
namespace {

using namespace cmb::test;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;

struct Kinds {
  const char *a, *b;
};

void PrintTo(const Kinds &kinds, std::ostream *stream) { *stream << kinds.a << " on " << kinds.b; }

class RandomCurved : public testing::TestWithParam<Kinds> {};

// Between its knots a path is up to half a body deep.
TEST_P(RandomCurved, SumsHaveNoJumps) {
  for (const double deep : {0.004, 0.04}) {
    for (std::uint64_t pair = 0; pair < 4; ++pair) {
      Random random(1000 + pair);
      const std::string a = random_shape(GetParam().a, random), b = random_shape(GetParam().b, random);
      const PairScene scene(a, b);
      const PathSums sums = follow(scene, random_path(scene, random, deep), {}, 600, 15);
      EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << a << " | " << b;
      EXPECT_GT(sums.largest_load, 0.0);
    }
  }
}

struct RarePath {
  const char *name;
  Kinds kinds;
  std::uint64_t seed;
  double deep;
  int samples = 600;
};

void PrintTo(const RarePath &path, std::ostream *stream) { *stream << path.name; }

class RareCurved : public testing::TestWithParam<RarePath> {};

// One in a thousand of random paths.
TEST_P(RareCurved, SumsHaveNoJumps) {
  const RarePath &path = GetParam();
  Random random(path.seed);
  const std::string a = random_shape(path.kinds.a, random), b = random_shape(path.kinds.b, random);
  const PairScene scene(a, b);
  const PosePath pose_a = random_path(scene, random, path.deep);
  const PathSums sums = follow(scene, pose_a, {}, path.samples, static_cast<std::size_t>(path.samples) / 40);
  EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << a << " | " << b;
  EXPECT_GT(sums.largest_load, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    All, RareCurved,
    testing::Values(RarePath{"the ball touches a cone all along an arc", {"cone", "box"}, 5021, 0.004},
                    RarePath{"a third place is nearer by less than a search tells", {"cone", "hull"}, 1085, 0.04},
                    RarePath{"the ball comes to rest on a curved place slowly", {"cylinder", "hull"}, 1150, 0.04},
                    RarePath{"a cone's side is equally near along an arc to its end", {"cone", "box"}, 1383, 0.004},
                    RarePath{"a capsule's end leaves a hull's shadow beside a steep face", {"capsule", "hull"}, 1107, 0.04},
                    RarePath{"a capsule's end enters a hull's shadow beside a steep face", {"capsule", "hull"}, 1137, 0.04},
                    RarePath{"the ball outgrows a capsule at an edge", {"capsule", "hull"}, 1178, 0.04},
                    RarePath{"the ball outgrows a capsule at a corner", {"capsule", "hull"}, 1488, 0.004},
                    RarePath{"the ball outgrows a capsule at a cone", {"capsule", "cone"}, 1083, 0.04},
                    RarePath{"the ball rests where a rim over an edge is as curved", {"cylinder", "box"}, 1112, 0.04},
                    RarePath{"a side's end crosses an edge nearly along it", {"cylinder", "box"}, 1954, 0.04},
                    RarePath{"a tip leaves the polygon that stands for a disc", {"cylinder", "hull"}, 2356, 0.004},
                    RarePath{"the ball rests on a cone as curved, and beside", {"cone", "hull"}, 1826, 0.04},
                    RarePath{"the ball rests on two places of a cone as curved", {"cone", "hull"}, 2430, 0.004},
                    RarePath{"the ball goes from two places of a cone to another", {"cone", "hull"}, 2520, 0.004},
                    RarePath{"a second corner under the disc's polygon loses its depth", {"cylinder", "hull"}, 1537, 0.04},
                    RarePath{"a second corner under the disc's polygon gains depth", {"cylinder", "hull"}, 1597, 0.004},
                    RarePath{"an edge crosses the disc's polygon at no depth", {"cylinder", "hull"}, 1974, 0.04},
                    RarePath{"a corner under a base's polygon gains depth", {"cone", "hull"}, 1774, 0.004},
                    RarePath{"a corner on a cone's axis holds the ball all round", {"cone", "hull"}, 1787, 0.004},
                    RarePath{"the same, found from elsewhere", {"cone", "hull"}, 2132, 0.04},
                    RarePath{"the same, but for where an edge is", {"cone", "hull"}, 2019, 0.04},
                    RarePath{"the same, but for where two edges are", {"cone", "hull"}, 7692, 0.04},
                    RarePath{"two places of a cone nearly in one direction", {"cone", "hull"}, 4903, 0.04},
                    RarePath{"an edge of a hull comes to lie in a base's plane", {"cone", "hull"}, 3383, 0.004},
                    RarePath{"the ball leaves a face by very little", {"cone", "hull"}, 3402, 0.004},
                    RarePath{"a rim leaves a face over an edge of other corners", {"cone", "hull"}, 9896, 0.004},
                    RarePath{"two faces nearly in one plane are nearest", {"cone", "hull"}, 8757, 0.04},
                    RarePath{"a tip on another cone's axis holds the ball on an arc", {"cone", "cone"}, 1952, 0.04},
                    RarePath{"a side is nearest just beside a cone's crease", {"cylinder", "cone"}, 1204, 0.04},
                    RarePath{"a rim is nearest just beside a base's normal", {"cylinder", "cone"}, 1738, 0.04},
                    RarePath{"the ball is at rest to a tighter bound alone", {"cylinder", "cone"}, 3301, 0.04},
                    RarePath{"a rim over an edge as curved as the ball", {"cylinder", "hull"}, 7314, 0.04},
                    RarePath{"a place beside the one the ball rests on is nearer by 1e-9", {"cylinder", "hull"}, 33018, 0.004},
                    RarePath{"a place nearly touched is one that the ball rests on", {"cylinder", "hull"}, 9502, 0.04},
                    RarePath{"a rim is nearest just beside a crease", {"cylinder", "hull"}, 5758, 0.004},
                    RarePath{"an edge nearly along a side", {"cylinder", "hull"}, 50250, 0.04, 2400},
                    RarePath{"the ball is held by four places at once", {"cylinder", "hull"}, 1422, 0.04}));

class TipUnderDisc : public testing::TestWithParam<const char *> {};

// A sharp tip slides from beside between disc and support, all ways round, blunt or sharp, level or inclined.
TEST_P(TipUnderDisc, SumsHaveNoJumps) {
  constexpr double radius = 0.3, top = 0.25;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    Random random(seed);
    std::string tip = "cmb/1 hull vertices=0,0,0";
    const double wide = random.uniform(0.05, 0.5), steep = random.uniform(0.02, 0.6);
    for (int k = random.integer(3, 6); k > 0; --k) {
      tip += ",0.6," + digits(wide * random.uniform(-1, 1)) + "," + digits(0.6 * steep * random.uniform(0.05, 1));
    }
    const double angle = random.uniform(0, 2 * pi), depth = std::exp(random.uniform(std::log(3e-4), std::log(1e-2)));
    const Mat3 attitude = product(rotation_about({0, 0, 1}, angle + random.uniform(-0.3, 0.3)),
                                  product(rotation_about({0, 1, 0}, random.uniform(-0.15, 0.15)),
                                          rotation_about({1, 0, 0}, random.uniform(-0.1, 0.1))));
    const double turn = random.uniform(0, 0.3), lift = random.uniform(0, 0.5);
    const PosePath path = [=](double s) {
      const double far = radius * (1.05 - 0.1 * s), around = angle + 0.2 * s;
      return BodyPose{{far * std::cos(around), far * std::sin(around), top - depth * (1.0 + lift * std::sin(5.0 * s))},
                      product(rotation_about({0, 0, 1}, turn * s), attitude)};
    };
    const PathSums sums = follow(PairScene(tip, GetParam()), path, {}, 600, 15);
    EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << tip << ", " << depth << " deep";
    EXPECT_GT(sums.largest_load, 0.0);
  }
}

// An edge that lies across the disc's border, outside of the polygon that stands for the disc or just within, rocks through
// the attitude in which all of it is as deep.
TEST_P(TipUnderDisc, EdgeAtTheBorderRocks) {
  constexpr double pi_16 = pi / 16, top = 0.25;
  const PairScene scene("cmb/1 hull vertices=0,-0.02,0,0,0.03,0,0.6,-0.2,0.2,0.6,0.2,0.3,0.5,0,0.5", GetParam());
  for (const double far : {0.2935, 0.2945, 0.2955, 0.2965, 0.298}) {
    for (const double depth : {2e-4, 1e-3}) {
      const PosePath path = [=](double s) {
        const double at = far + 5e-4 * s;
        return BodyPose{{at * std::cos(pi_16), at * std::sin(pi_16), top - depth},
                        product(rotation_about({0, 0, 1}, pi_16), rotation_about({1, 0, 0}, 0.2 * (s - 0.473)))};
      };
      const PathSums sums = follow(scene, path, {}, 600, 15);
      EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << far << ", " << depth << " deep";
      EXPECT_GT(sums.largest_load, 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, TipUnderDisc,
                         testing::Values("cmb/1 cylinder radius=0.3 length=0.5",
                                         "cmb/1 cone radius=0.3 length=0.5 rotation=1,0,0,0,-1,0,0,0,-1"));

std::vector<Kinds> all_kinds() {
  const char *const curved[] = {"sphere", "capsule", "cylinder", "cone", "ellipsoid"};
  std::vector<Kinds> pairs;
  for (std::size_t i = 0; i < 5; ++i) {
    for (std::size_t j = i; j < 5; ++j) pairs.push_back({curved[i], curved[j]});
    for (const char *polytope : {"box", "hull"}) pairs.push_back({curved[i], polytope});
  }
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(All, RandomCurved, testing::ValuesIn(all_kinds()));

struct Path {
  const char *name, *a, *b;
  PosePath pose_a;
};

void PrintTo(const Path &path, std::ostream *stream) { *stream << path.name; }

const char *const table = "cmb/1 box size=4,4,1", *const cylinder = "cmb/1 cylinder radius=0.3 length=0.5",
                  *const cone = "cmb/1 cone radius=0.3 length=0.5", *const capsule = "cmb/1 capsule radius=0.1 length=0.8";

// The ball between its hips is the one between its long sides at one radius alone.
const char *const roof =
    "cmb/1 hull vertices=-0.6,-0.2,-0.6,0.6,-0.2,-0.6,-0.6,0.2,-0.6,0.6,0.2,-0.6,-0.6,-0.2,0,0.6,-0.2,0,-0.6,0.2,0,0.6,0.2,0,"
    "0,-0.02,0.4,0,0.02,0.4";

const Path paths[] = {
    {"cylinder slips off a border deeper than it overlaps", cylinder, table,
     [](double s) { return BodyPose{{2.2 + 0.15 * s, 0.1, 0.75 - 0.05}, {}}; }},
    {"tilted cylinder slips off a corner deeper than it overlaps", cylinder, table,
     [](double s) { return BodyPose{{2.1 + 0.2 * s, 2.05 + 0.2 * s, 0.65}, rotation_about({0.6, 0.8, 0}, 0.2)}; }},
    {"lying cylinder slips off a border deeper than it overlaps", cylinder, table,
     [](double s) { return BodyPose{{2.0 + 0.4 * s, 0.1, 0.74}, rotation_about({1, 0, 0}, pi / 2)}; }},
    {"cone slips off a border, tip first", cone, table,
     [](double s) { return BodyPose{{1.9 + 0.2 * s, 0.1, 0.7}, rotation_about({1, 0, 0}, pi)}; }},
    {"cone rolls on its mantle over a border", cone, table,
     [](double s) {
       return BodyPose{{1.8 + 0.4 * s, 0.1, 0.61},
                       product(rotation_about({0, 0, 1}, 2 * pi * s), rotation_about({0, 1, 0}, pi / 2 + std::atan(0.6)))};
     }},
    {"capsule over a box's edge, its axis through it", capsule, table,
     [](double s) { return BodyPose{{2.0, 0.1, 0.65 - 0.3 * s}, rotation_about({1, 0, 0}, pi / 2)}; }},
    {"capsule turns about a box's corner", capsule, table,
     [](double s) { return BodyPose{{2.05, 2.05, 0.52}, rotation_about(normalized(Vec3{1, 0.5, 0.2}), 2 * pi * s)}; }},
    {"sphere in a hipped roof, held by four of its faces at once", "cmb/1 sphere radius=0.01", roof,
     [](double s) { return BodyPose{{0.002, 0.006, 0.39 - 0.1 * s}, {}}; }},
    {"cylinder in a hipped roof, held by four of its faces at once", "cmb/1 cylinder radius=0.02 length=0.03", roof,
     [](double s) { return BodyPose{{0.005, 0.003, 0.39 - 0.1 * s}, {}}; }},
    {"ellipsoid rolls over a hull", "cmb/1 ellipsoid size=0.9,0.6,0.4",
     "cmb/1 hull vertices=-0.5,-0.4,-0.3,0.5,-0.5,-0.3,0.4,0.5,-0.3,-0.4,0.4,-0.3,-0.3,0,0.4,0.3,0.1,0.5",
     [](double s) {
       return BodyPose{{-0.7 + 1.4 * s, 0.1, 0.62}, rotation_about(normalized(Vec3{0.3, 1, 0.1}), 2 * pi * s)};
     }},
};

// The ball in a regular tip touches all of its faces, whatever its size.
class RegularTips : public testing::TestWithParam<const char *> {};

TEST_P(RegularTips, SumsHaveNoJumps) {
  for (const int sides : {4, 5, 8}) {
    std::string pyramid = "cmb/1 hull vertices=";
    for (const double height : {0.0, -0.6}) {
      for (int k = 0; k < sides; ++k) {
        const double angle = 0.3 + 2 * pi * k / sides;
        pyramid += digits(0.42 * std::cos(angle)) + "," + digits(0.42 * std::sin(angle)) + "," + digits(height) + ",";
      }
    }
    const PairScene scene(GetParam(), pyramid + "0,0,0.4");
    for (const double aside : {0.002, 0.01}) {
      // About the axis, level and turning, and beside it, through the level attitude.
      const auto around = [=](double s) { return Vec3{aside * std::cos(6.2 * s), aside * std::sin(6.2 * s), 0.31 + 0.01 * s}; };
      const PosePath ways[] = {
          [=](double s) { return BodyPose{around(s), {}}; },
          [=](double s) {
            return BodyPose{around(s), rotation_about(normalized(Vec3{0.3, 0.5, 0.2}), 0.5 * std::sin(3.0 * s - 1.0))};
          },
          [=](double s) { return BodyPose{around(0.3), rotation_about(normalized(Vec3{0.3, 0.5, 0}), 0.5 * (s - 0.48))}; }};
      for (const PosePath &way : ways) {
        const PathSums sums = follow(scene, way, {}, 200, 10);
        EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << sides << " sides, " << aside << " beside the axis";
        EXPECT_GT(sums.largest_load, 0.0);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, RegularTips,
                         testing::Values("cmb/1 sphere radius=0.01", "cmb/1 cylinder radius=0.02 length=0.03",
                                         "cmb/1 cone radius=0.02 length=0.03", "cmb/1 capsule radius=0.01 length=0.03"));

class CurvedPaths : public testing::TestWithParam<Path> {};

TEST_P(CurvedPaths, SumsHaveNoJumps) {
  const Path &path = GetParam();
  const PathSums sums = follow(PairScene(path.a, path.b), path.pose_a, {}, 1000, 40);
  EXPECT_GT(sums.largest_load, 0.0);
  EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load);
}

INSTANTIATE_TEST_SUITE_P(All, CurvedPaths, testing::ValuesIn(paths));

}  // namespace
}  // namespace test_curved_continuity
