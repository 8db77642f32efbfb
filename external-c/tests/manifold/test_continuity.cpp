// The force-carrying sums have no jumps along paths in pose space.
#include "support/path_sums.hpp"

namespace test_continuity {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;
constexpr double depth = 0.01;

struct Path {
  const char *name;
  const char *a, *b;
  PosePath pose_a;
  BodyPose pose_b;
};

void PrintTo(const Path &path, std::ostream *stream) { *stream << path.name; }

const char *const cube = "cmb/1 box size=1,1,1";
const char *const table = "cmb/1 box size=4,4,1";
const char *const pedestal = "cmb/1 box size=0.5,0.7,1";
const char *const floor_halfspace = "cmb/1 halfspace position=0,0,0.5";
const char *const capsule = "cmb/1 capsule radius=0.1 length=0.8";
// A wedge: faces of three and four corners, no two alike.
const char *const wedge = "cmb/1 hull vertices=-0.5,-0.4,-0.3,0.5,-0.5,-0.3,0.4,0.5,-0.3,-0.4,0.4,-0.3,-0.3,0,0.4,0.3,0.1,0.5";

// How far the vertices of a cube or of the wedge reach below its frame.
double reach_below(const Mat3 &rotation, bool of_wedge) {
  static const Vec3 wedge_vertices[] = {{-0.5, -0.4, -0.3}, {0.5, -0.5, -0.3}, {0.4, 0.5, -0.3},
                                        {-0.4, 0.4, -0.3},  {-0.3, 0, 0.4},    {0.3, 0.1, 0.5}};
  double lowest = 0.0;
  if (of_wedge) {
    for (const Vec3 &v : wedge_vertices) lowest = std::fmin(lowest, (rotation * v).z);
  } else {
    for (int v = 0; v < 8; ++v) {
      const Vec3 p{v & 1 ? 0.5 : -0.5, v & 2 ? 0.5 : -0.5, v & 4 ? 0.5 : -0.5};
      lowest = std::fmin(lowest, (rotation * p).z);
    }
  }
  return -lowest;
}

// Turning over and over on a level surface at z = 0.5, always as deep.
BodyPose tumbling(double s, const Vec3 &axis, double x, double y, bool of_wedge) {
  const Mat3 rotation = rotation_about(normalized(axis), 2.0 * pi * s);
  return {{x, y, 0.5 + reach_below(rotation, of_wedge) - depth}, rotation};
}

const Mat3 yaw_small = rotation_about({0, 0, 1}, 0.3);

const char *const cylinder = "cmb/1 cylinder radius=0.3 length=0.5";
const char *const drum = "cmb/1 cylinder radius=1 length=1";
const char *const cone = "cmb/1 cone radius=0.3 length=0.5";

// The same for the cylinder and the cone.
BodyPose tumbling_cylinder(double s, double x, double y) {
  const Mat3 rotation = rotation_about(normalized(Vec3{1, 0.3, 0.0}), 2 * pi * s);
  const Vec3 axis = rotation.column(2);
  return {{x, y, 0.5 + 0.25 * std::fabs(axis.z) + 0.3 * std::hypot(axis.x, axis.y) - depth}, rotation};
}

BodyPose tumbling_cone(double s) {
  const Mat3 rotation = rotation_about(normalized(Vec3{1, 0.3, 0.0}), 2 * pi * s);
  const Vec3 axis = rotation.column(2);
  const double apex = -0.25 * axis.z, base = 0.25 * axis.z + 0.3 * std::hypot(axis.x, axis.y);
  return {{0.1, 0.2, 0.5 + std::fmax(apex, base) - depth}, rotation};
}

const Path paths[] = {
    {"box slides over the border of a table", cube, table,
     [](double s) { return BodyPose{{1.0 + 2.0 * s, 0.1, 1.0 - depth}, {}}; }, {}},
    {"turned box slides over the corner of a table", cube, table,
     [](double s) { return BodyPose{{1.0 + 2.0 * s, 1.0 + 1.7 * s, 1.0 - depth}, yaw_small}; }, {}},
    {"cube turns on an equal cube", cube, cube,
     [](double s) { return BodyPose{{0, 0, 1.0 - depth}, rotation_about({0, 0, 1}, -1.0 + 2.0 * s)}; }, {}},
    {"tilted cube turns on an equal cube, through flush", cube, cube,
     [](double s) {
       return BodyPose{{0.05, 0, 1.0 - depth},
                       product(rotation_about({0, 1, 0}, 0.01), rotation_about({0, 0, 1}, -1.0 + 2.0 * s))};
     },
     {}},
    {"box rocks on a table", cube, table,
     [](double s) { return BodyPose{{0, 0, 1.0 - depth}, rotation_about({0, 1, 0}, -0.1 + 0.2 * s)}; }, {}},
    {"box rocks on a pedestal", cube, pedestal,
     [](double s) { return BodyPose{{0, 0, 1.0 - depth}, rotation_about({0.6, 0.8, 0}, -0.1 + 0.2 * s)}; }, {}},
    {"box tumbles on a half-space", cube, floor_halfspace,
     [](double s) { return tumbling(s, {1, 0.3, 0.2}, 0, 0, false); }, {}},
    {"box tumbles on a table", cube, table, [](double s) { return tumbling(s, {1, 0.3, 0.2}, 0, 0, false); }, {}},
    {"box tumbles over the corner of a table", cube, table,
     [](double s) { return tumbling(s, {1, 0.3, 0.2}, 1.5 + s, 1.9, false); }, {}},
    {"wedge tumbles on a half-space", wedge, floor_halfspace,
     [](double s) { return tumbling(s, {1, 0.3, 0.2}, 0, 0, true); }, {}},
    {"wedge tumbles over the corner of a table", wedge, table,
     [](double s) { return tumbling(s, {0.2, 1, 0.4}, 1.6 + 0.6 * s, 1.9, true); }, {}},
    {"cubes in all six directions", cube, cube,
     [](double s) {
       return BodyPose{{0.3 * std::sin(7 * s), 0.2 * std::cos(5 * s) + 0.1, 1.02 + 0.1 * std::sin(11 * s)},
                       product(rotation_about({0, 0, 1}, 2 * s),
                               rotation_about(normalized(Vec3{1, 1, 0.2}), 0.3 * std::sin(13 * s)))};
     },
     {}},
    {"wedge and cube in all six directions", wedge, cube,
     [](double s) {
       return BodyPose{{0.5 * std::sin(7 * s), 0.6 * std::cos(5 * s), 0.75 + 0.1 * std::sin(11 * s)},
                       product(rotation_about({0, 0, 1}, 2 * s),
                               rotation_about(normalized(Vec3{1, 1, 0.2}), 0.3 * std::sin(13 * s)))};
     },
     {}},
    {"edges cross", cube, cube,
     [](double s) {
       return BodyPose{{0.2 * s, 0.3 - 0.5 * s, std::sqrt(2.0) - depth},
                       product(rotation_about({0, 0, 1}, pi / 2 + 0.2 * s),
                               rotation_about({1, 0, 0}, pi / 4 + 0.1 * std::sin(9 * s)))};
     },
     {{}, rotation_about({1, 0, 0}, pi / 4)}},
    {"capsule tumbles on a half-space", capsule, floor_halfspace,
     [](double s) {
       const Mat3 rotation = rotation_about(normalized(Vec3{1, 0.3, 0.2}), 2 * pi * s);
       return BodyPose{{0, 0, 0.6 + std::fabs((rotation * Vec3{0, 0, 0.4}).z) - depth}, rotation};
     },
     {}},
    {"cylinder tumbles on a half-space", cylinder, floor_halfspace,
     [](double s) { return tumbling_cylinder(s, 0, 0); }, {}},
    {"cone tumbles on a half-space", cone, floor_halfspace, [](double s) { return tumbling_cone(s); }, {}},
    {"capsule slides over the border of a table", capsule, table,
     [](double s) {
       return BodyPose{{1.2 + 1.5 * s, 0.1, 0.6 - depth},
                       product(rotation_about({0, 0, 1}, 0.3), rotation_about({0, 1, 0}, pi / 2))};
     },
     {}},
    {"capsule tumbles on a table", capsule, table,
     [](double s) {
       const Mat3 rotation = rotation_about(normalized(Vec3{1, 0.3, 0.2}), 2 * pi * s);
       return BodyPose{{0, 0, 0.6 + std::fabs((rotation * Vec3{0, 0, 0.4}).z) - depth}, rotation};
     },
     {}},
    {"capsule rocks over the border of a table", capsule, table,
     [](double s) { return BodyPose{{1.8, 0, 0.6 - depth}, rotation_about({0, 1, 0}, pi / 2 - 0.1 + 0.2 * s)}; }, {}},
    {"capsules turn through parallel", capsule, capsule,
     [](double s) {
       return BodyPose{{0.1, 0.02, 0.2 - depth},
                       product(rotation_about({0, 0, 1}, -1.0 + 2.0 * s), rotation_about({0, 1, 0}, pi / 2))};
     },
     {{}, rotation_about({0, 1, 0}, pi / 2)}},
    {"cylinder tumbles on a table", cylinder, table,
     [](double s) { return tumbling_cylinder(s, 0.1, 0.2); }, {}},
    {"cylinder tumbles on a cylinder", cylinder, drum,
     [](double s) { return tumbling_cylinder(s, 0.1, 0.2); }, {}},
    {"cylinder tumbles over the border of a table", cylinder, table,
     [](double s) { return tumbling_cylinder(s, 1.9, 0.2); }, {}},
    {"cone tumbles on a table", cone, table, [](double s) { return tumbling_cone(s); }, {}},
    {"cone tumbles on a cylinder", cone, drum, [](double s) { return tumbling_cone(s); }, {}},
    {"standing cylinder slides over the border of a table", cylinder, table,
     [](double s) { return BodyPose{{1.2 + 0.9 * s, 0.1 * s, 0.75 - depth}, {}}; }, {}},
    {"cylinder rocks over the border of a table", cylinder, table,
     [](double s) { return BodyPose{{1.9, 0.1, 0.75 - depth}, rotation_about({0.6, 0.8, 0}, -0.1 + 0.2 * s)}; }, {}},
    {"lying cylinder slides over the border of a table", cylinder, table,
     [](double s) {
       return BodyPose{{1.2 + 0.9 * s, 0.1, 0.8 - depth},
                       product(rotation_about({0, 0, 1}, 0.3), rotation_about({0, 1, 0}, pi / 2))};
     },
     {}},
    {"cylinder slides over the border of a cylinder", cylinder, drum,
     [](double s) { return BodyPose{{0.2 + 1.0 * s, 0.1, 0.75 - depth}, yaw_small}; }, {}},
    {"box rocks on a cylinder", pedestal, drum,
     [](double s) { return BodyPose{{0.8, 0, 1.0 - depth}, rotation_about({0.6, 0.8, 0}, -0.1 + 0.2 * s)}; }, {}},
    {"cylinders lie side by side, through parallel", cylinder, cylinder,
     [](double s) { return BodyPose{{0.1, 0.05, 0.6 - depth}, rotation_about({0, 1, 0.001}, pi / 2 - 0.3 + 0.6 * s)}; },
     {{}, rotation_about({0, 1, 0}, pi / 2)}},
    {"capsule tumbles on a cylinder", capsule, drum,
     [](double s) {
       const Mat3 rotation = rotation_about(normalized(Vec3{1, 0.3, 0.2}), 2 * pi * s);
       return BodyPose{{0, 0, 0.6 + std::fabs((rotation * Vec3{0, 0, 0.4}).z) - depth}, rotation};
     },
     {}},
    {"sphere rolls over the border of a table", "cmb/1 sphere radius=0.3", table,
     [](double s) { return BodyPose{{1.5 + s, 0.1, 0.8 - depth}, {}}; }, {}},
};

class Continuity : public testing::TestWithParam<Path> {};

TEST_P(Continuity, SumsHaveNoJumps) {
  const Path &path = GetParam();
  const PathSums sums = follow(PairScene(path.a, path.b), path.pose_a, path.pose_b, 1500, 60);
  EXPECT_LT(sums.largest_jump, 1e-5 * depth);
  EXPECT_GT(sums.largest_load, 0.0);
}

// Boxes and hulls, wedges among them, that turn over each other, up to an eighth of their size deep.
TEST(RandomPolytopes, SumsHaveNoJumps) {
  const auto polytope = [](random_bodies::Random &random) {
    return random.uniform(0, 1) < 0.4 ? random_box(random) : random_hull(random);
  };
  for (const double deep : {0.004, 0.04}) {
    for (std::uint64_t pair = 0; pair < 30; ++pair) {
      random_bodies::Random random(1000 + pair);
      const std::string a = polytope(random), b = polytope(random);
      const PairScene scene(a, b);
      const PathSums sums = follow(scene, random_path(scene, random, deep), {}, 600, 15);
      EXPECT_LT(sums.largest_jump, 1e-5 * deep) << a << " | " << b;
      EXPECT_GT(sums.largest_load, 0.0);
    }
  }
}

// Finely tessellated bodies, of whose many corners the deepest carry, up to a tenth of their size deep: over each other, over
// boxes and half-spaces.
TEST(FineHulls, SumsHaveNoJumps) {
  for (const double deep : {0.01, 0.1}) {
    for (std::uint64_t pair = 0; pair < 6; ++pair) {
      random_bodies::Random random(2000 + pair);
      const std::string a = fine_hull(random, pair % 2 == 0 ? 100 : 300);
      const std::string b = pair < 2 ? fine_hull(random, 60) : pair < 4 ? table : "cmb/1 halfspace";
      const PairScene scene(a, b);
      const PathSums sums = follow(scene, random_path(scene, random, deep), {}, 400, 10);
      EXPECT_LT(sums.largest_jump, 1e-5 * deep) << a << " | " << b;
      EXPECT_GT(sums.largest_load, 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Paths, Continuity, testing::ValuesIn(paths));

TEST(SignedDistance, PassesZeroWithSlopeOne) {
  for (const char *other : {cube, table, wedge, capsule, "cmb/1 sphere radius=0.3"}) {
    const PairScene scene(cube, other);
    const Mat3 rotation = rotation_about(normalized(Vec3{1, 2, 3}), 0.7);
    double height = 3.0;
    height -= scene.query({{0.1, 0.05, height}, rotation}, {}).distance;  // not along the normal: a few steps
    for (int i = 0; i < 200; ++i) height -= scene.query({{0.1, 0.05, height}, rotation}, {}).distance;
    ASSERT_NEAR(scene.query({{0.1, 0.05, height}, rotation}, {}).distance, 0.0, 1e-9) << other;
    double last = scene.query({{0.1, 0.05, height - 1e-3}, rotation}, {}).distance;
    for (int i = -99; i <= 100; ++i) {
      const double next = scene.query({{0.1, 0.05, height + 1e-5 * i}, rotation}, {}).distance;
      EXPECT_GE(next, last - 1e-13) << other;
      EXPECT_LE(next - last, 1.0001e-5) << other;  // distance is 1-Lipschitz
      last = next;
    }
  }
}

}  // namespace
}  // namespace test_continuity
