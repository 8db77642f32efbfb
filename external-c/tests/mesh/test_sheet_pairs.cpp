// Sheets with each other and with bodies: they touch where their surfaces cross, in either order, and the load comes and goes
// without jumps.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "math/pose_algebra.hpp"
#include "mesh/distance/mesh_pair_distance.hpp"
#include "support/level_sheets.hpp"
#include "support/mesh_text.hpp"
#include "support/path_sums.hpp"
#include "support/random_bodies.hpp"

namespace test_sheet_pairs {
namespace {

using namespace cmb::test;
using mesh_samples::height_field_text;
using mesh_samples::mesh_text;
using mesh_samples::sheet_mesh;
using random_bodies::Random;
using random_bodies::random_rotation;

constexpr double pi = 3.14159265358979323846;

double level(double, double) { return 0.0; }
double hills(double x, double y) { return 0.05 * std::sin(5 * x + 0.3) * std::cos(4 * y) + 0.02 * std::sin(9 * y); }
double cap(double x, double y) { return -0.5 * (x * x + y * y); }

// A sheet whose front is below.
Mat3 upside_down() { return rotation_about({1, 0, 0}, pi); }

double load_size(const Contact &contact) {
  double sum = 0.0;
  for (const Point &p : contact.points) sum += p.weight * p.depth;
  return sum;
}

// As the stress program found it: the borders of two level fields, nearly at a right angle, cross by less than rounding.
// Seen from one of them, a piece of the other one lies 1.28 m behind.
TEST(SheetPairs, BordersThatCrossByRoundingHardlyTouch) {
  const PairScene scene(height_field_text(24.0, 17, level), height_field_text(24.0, 17, level));
  const BodyPose a{{0x1.4d20c59f1ba4dp+3, -0x1.47f737b786919p+4, 0x1.d24511f42f8acp+4},
                   {{{0x1.590ee0069e61cp-4, 0x1.efd184624bfaap-1, 0x1.e0cb55ba31bf4p-3},
                     {0x1.2116c97511b1bp-3, 0x1.c5e418a69b72bp-3, -0x1.ee023e310af31p-1},
                     {-0x1.f908f456ef3e2p-1, 0x1.d4aaf306226d8p-4, -0x1.e36e5005efe53p-4}}}};
  const BodyPose b{{0x1.5cb9c74bdcccep+4, -0x1.f6678212923dap+3, 0x1.fb744da887204p+4},
                   {{{0x1.4ffdddc99a6f8p-3, 0x1.57be8c9e0b232p-3, -0x1.f1b2b2ca3c0ap-1},
                     {-0x1.803b80ec894ebp-2, -0x1.cd2bfbb42bff4p-1, -0x1.c0367b9d9fad8p-3},
                     {-0x1.d318dc1b6ccdep-1, 0x1.9a4419e098e9p-2, -0x1.5b4f05e87eefp-4}}}};
  for (const Contact &contact : {scene.query(a, b), scene.query(b, a)}) {
    EXPECT_NEAR(contact.distance, 0.0, 1e-12);
    EXPECT_NEAR(load_size(contact), 0.0, 1e-12);
  }
}

TEST(SheetPairs, LevelOnesTouchWhereTheyCross) {
  const std::string sheet = mesh_text(sheet_mesh(1.0, 4, level));
  const PairScene scene(sheet, sheet);
  Random random(1);
  int touching = 0, apart = 0;
  for (int k = 0; k < 3000; ++k) {
    const BodyPose a{random.uniform(0, 1) * random.direction(), random_rotation(random)}, b{{}, random_rotation(random)};
    const double common =
        mesh_samples::common_extent({a.rotation, a.position}, {b.rotation, b.position}, 0.5);
    if (std::fabs(common) < 1e-9) continue;
    const Contact contact = scene.query(a, b);
    ASSERT_EQ(contact.distance < 0.0, common > 0.0) << k;
    ASSERT_EQ(load_size(contact) > 0.0, common > 0.0) << k;
    (common > 0.0 ? touching : apart) += 1;
  }
  EXPECT_GT(touching, 800);
  EXPECT_GT(apart, 800);
}

// Along rows of vertices of one of them or both, turned about such a row, anywhere in the world.
TEST(SheetPairs, LevelOnesTouchAlongTheirRows) {
  constexpr double half = 12.0, spacing = 1.5;
  const PairScene scene(height_field_text(2.0 * half, 17, level), height_field_text(2.0 * half, 17, level));
  Random random(9);
  int touching = 0;
  for (int k = 0; k < 300; ++k) {
    const BodyPose world{100.0 * random.uniform(0, 1) * random.direction(), random_rotation(random)};
    const auto rows = [&random, spacing] { return spacing * random.integer(-6, 6); };
    const Vec3 axis = k % 2 == 0 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const double angle = k % 3 == 0 ? 0.25 * pi * random.integer(1, 3) : random.uniform(0.1, pi - 0.1);
    // Both rows through one line; or of `b` alone, the line being anywhere on `a`.
    const cmb::convex::Pose turned{rotation_about(axis, angle), {}};
    Vec3 on_a{rows(), rows(), 0}, on_b{rows(), rows(), 0};
    if (k % 5 == 0) on_a = {random.uniform(-8, 8), random.uniform(-8, 8), 0};
    const Vec3 shift = on_b - turned(on_a);
    const auto placed = [&world](const cmb::convex::Pose &pose) {
      const cmb::convex::Pose at = cmb::compose({world.rotation, world.position}, pose);
      return BodyPose{at.translation, at.rotation};
    };
    const BodyPose a = placed({turned.rotation, shift}), b = placed({});
    const double common = mesh_samples::common_extent({a.rotation, a.position}, {b.rotation, b.position}, half - 1e-6);
    if (!(common > 0.0)) continue;
    ++touching;
    for (const Contact &contact : {scene.query(a, b), scene.query(b, a)}) {
      EXPECT_LT(contact.distance, 0.0) << k;
      EXPECT_GT(load_size(contact), 0.0) << k;
    }
  }
  EXPECT_GT(touching, 150);
}

// Where triangles of rough ones have a place in common they touch, else they are as far apart as their triangles.
TEST(SheetPairs, RoughOnesTouchWhereTheyCross) {
  const mesh_samples::MeshData small = sheet_mesh(1.0, 6, hills), large = sheet_mesh(1.6, 8, hills);
  const PairScene scene(mesh_text(small), mesh_text(large));
  const cmb::mesh::TriangleMesh a = mesh_samples::mesh(small), b = mesh_samples::mesh(large);
  Random random(4);
  int touching = 0, apart = 0;
  for (int k = 0; k < 2000; ++k) {
    const BodyPose pose{random.uniform(0, 1.3) * random.direction(), random_rotation(random)};
    const double gap = mesh_pair_distance(b, a, {pose.rotation, pose.position}).distance;
    const Contact contact = scene.query(pose, {});
    if (gap > 0.0) {
      ASSERT_NEAR(contact.distance, gap, 1e-12) << k;
    } else {
      ASSERT_LT(contact.distance, 0.0) << k;
    }
    ASSERT_EQ(load_size(contact) > 0.0, gap == 0.0) << k;
    (gap > 0.0 ? apart : touching) += 1;
  }
  EXPECT_GT(touching, 500);
  EXPECT_GT(apart, 500);
}

TEST(SheetPairs, ExchangeReversesTheLoad) {
  const std::string flat = mesh_text(sheet_mesh(1.0, 3, level)), rough = mesh_text(sheet_mesh(1.0, 6, hills)),
                    cup = mesh_text(sheet_mesh(0.8, 5, cap)), ground = height_field_text(3.0, 9, hills);
  const std::string *const pairs[][2] = {{&flat, &flat}, {&rough, &rough}, {&cup, &cup}, {&flat, &rough},
                                         {&cup, &flat},  {&rough, &ground}, {&ground, &ground}};
  Random random(2);
  for (const auto &pair : pairs) {
    const PairScene forward(*pair[0], *pair[1]), backward(*pair[1], *pair[0]);
    int touching = 0;
    for (int k = 0; k < 150; ++k) {
      const BodyPose a{0.4 * random.uniform(0, 1) * random.direction(), random_rotation(random)},
          b{0.2 * random.direction(), random_rotation(random)};
      const Contact x = forward.query(a, b, 256), y = backward.query(b, a, 256);
      ASSERT_NEAR(x.distance, y.distance, 1e-12) << k;
      ASSERT_NEAR(norm(x.load() + y.load()), 0.0, 1e-11) << k;
      ASSERT_NEAR(norm(x.moment({}) + y.moment({})), 0.0, 1e-11) << k;
      touching += x.distance < 0.0;
    }
    EXPECT_GT(touching, 40);
  }
}

// A plate, front down, with one edge of it below the ground: either front pushes a strip of the other one.
TEST(SheetPairs, InclinedPlateCarriesTheMeanOfItsDepth) {
  const PairScene scene(mesh_text(sheet_mesh(1.0, 4, level)), height_field_text(6.0, 13, level));
  for (const double inclination : {0.01, 0.1, 0.5, 0.9}) {
    for (const double depth : {1e-6, 1e-3, 0.05 * std::sin(inclination), 0.3 * std::sin(inclination)}) {
      const Mat3 rotation = product(rotation_about({0, 1, 0}, inclination), upside_down());
      const BodyPose plate{{0.1, 0.2, 0.5 * std::sin(inclination) - depth}, rotation};
      const Contact contact = scene.query(plate, {}, 256);
      const double own = 0.5 * depth, plates = own / std::cos(inclination);
      const Vec3 expected = (0.5 * own) * Vec3{0, 0, 1} - (0.5 * plates) * rotation.column(2);
      EXPECT_NEAR(norm(contact.load() - expected), 0.0, 1e-12) << inclination << ' ' << depth;
      EXPECT_NEAR(contact.distance, -depth / std::cos(inclination), 1e-12) << inclination << ' ' << depth;
    }
  }
}

// A sheet has nothing behind it: one that has come through wholly is free, and before that is pushed by less and less.
TEST(SheetPairs, LoadFadesAsOneComesThrough) {
  const PairScene scene(mesh_text(sheet_mesh(1.0, 4, level)), height_field_text(6.0, 13, level));
  const double inclination = 0.2, top = 0.5 * std::sin(inclination);
  const Mat3 rotation = product(rotation_about({0, 1, 0}, inclination), upside_down());
  const auto below = [&](double rest) { return scene.query({{0.1, 0.2, -top + rest}, rotation}, {}, 256); };
  EXPECT_GT(load_size(below(top)), 0.4 * top);
  for (const double rest : {1e-3, 1e-6, 1e-9}) {
    EXPECT_LT(below(rest).distance, 0.0);
    EXPECT_LT(load_size(below(rest)), 1e3 * rest);
  }
  EXPECT_NEAR(below(-1e-3).distance, 1e-3, 1e-12);
  EXPECT_TRUE(below(-1e-3).points.empty());
}

// A cap's top comes through the ground from below, its front towards the ground's back or away from it.
TEST(SheetPairs, WhatTouchesFromBehindIsPushedByWhatComesThrough) {
  const std::string ground = height_field_text(6.0, 13, level);
  const PairScene front_up(mesh_text(sheet_mesh(1.0, 6, cap)), ground),
      front_down(mesh_text(sheet_mesh(1.0, 6, [](double x, double y) { return -cap(x, y); })), ground);
  for (const double through : {1e-3, 1e-6, 1e-9}) {
    for (const Contact &contact : {front_up.query({{0.1, 0.2, through}, {}}, {}, 256),
                                   front_down.query({{0.1, 0.2, through}, upside_down()}, {}, 256)}) {
      EXPECT_LT(contact.distance, 0.0);
      EXPECT_LT(load_size(contact), 100.0 * through);
    }
  }
}

// Level sheets through each other, however they lie.
TEST(SheetPairs, LoadOfLevelOnesHasNoJumps) {
  const std::string coarse = mesh_text(sheet_mesh(1.0, 1, level)), fine = mesh_text(sheet_mesh(1.3, 4, level));
  const PairScene scenes[] = {{coarse, coarse}, {coarse, fine}, {fine, fine}};
  Random random(3);
  for (const PairScene &scene : scenes) {
    for (int path = 0; path < 8; ++path) {
      const Vec3 from = 0.6 * random.direction(), to = -from + 0.2 * random.direction(), axis = random.direction();
      const Mat3 first = random_rotation(random);
      const double turn = random.uniform(1, 4);
      const PathSums sums = follow(
          scene,
          [&](double s) {
            return BodyPose{(1 - s) * from + s * to, product(rotation_about(axis, turn * s), first)};
          },
          {}, 120, 5);
      EXPECT_GT(sums.largest_load, 1e-3);
      EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << &scene - scenes << ' ' << path;
    }
  }
}

struct SheetPath {
  const char *name;
  std::string a, b;
  PosePath pose;
};

// Rough and bent sheets on each other's fronts, over a border, and from behind.
TEST(SheetPairs, LoadOfRoughOnesHasNoJumps) {
  const std::string rough = mesh_text(sheet_mesh(1.0, 6, hills)), bulge = mesh_text(sheet_mesh(0.8, 5, cap)),
                    back = mesh_text(sheet_mesh(0.8, 5, [](double x, double y) { return -cap(x, y); })),
                    ground = height_field_text(3.0, 13, hills);
  const auto tilted = [](double angle) { return product(rotation_about(normalized(Vec3{0.3, 1, 0.1}), angle), upside_down()); };
  const SheetPath paths[] = {
      {"rough on ground", rough, ground,
       [&](double s) { return BodyPose{{-0.4 + s, 0.3 - 0.5 * s, 0.1 - 0.05 * s}, tilted(0.3 * s)}; }},
      {"bulge rolls", bulge, ground,
       [&](double s) { return BodyPose{{-0.4 + s, 0.3 - 0.5 * s, 0.03}, tilted(0.6 - 1.2 * s)}; }},
      {"bulge over a border", bulge, ground,
       [&](double s) { return BodyPose{{1.0 + 1.0 * s, 0.3 + 0.4 * s, 0.02}, tilted(0.3 - 0.5 * s)}; }},
      {"bulge on bulge", bulge, bulge,
       [&](double s) { return BodyPose{{-0.3 + 0.6 * s, 0.3 - 0.5 * s, -0.1 + 0.05 * s}, tilted(0.5 * s)}; }},
      {"bulge from behind", back, ground, [&](double s) { return BodyPose{{0.1, 0.2, -0.15 + 0.2 * s}, tilted(0.2 * s)}; }},
      {"down through the ground", bulge, ground,
       [&](double s) { return BodyPose{{0.1, 0.2, 0.15 - 0.7 * s}, tilted(0.3 * s)}; }},
  };
  for (const SheetPath &path : paths) {
    const PathSums sums = follow(PairScene(path.a, path.b), path.pose, {}, 200, 6);
    EXPECT_GT(sums.largest_load, 1e-3) << path.name;
    EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << path.name;
  }
}

// What a sheet does not cross it does not push, however near behind it that is.
TEST(BodyAndSheet, MeshesTouchWhereTheyCross) {
  const mesh_samples::MeshData ground = sheet_mesh(3.0, 12, hills);
  Random random(5);
  for (const mesh_samples::MeshData &data :
       {mesh_samples::box_mesh({0.4, 0.3, 0.5}, 1), mesh_samples::box_mesh({0.4, 0.3, 0.5}, 2), mesh_samples::sphere_mesh(0.25, 1)}) {
    const PairScene scene(mesh_text(data), mesh_text(ground));
    const cmb::mesh::TriangleMesh body = mesh_samples::mesh(data), sheet = mesh_samples::mesh(ground);
    int behind = 0;
    for (int k = 0; k < 1500; ++k) {
      const BodyPose pose{{random.uniform(-1.7, 1.7), random.uniform(-1.7, 1.7), random.uniform(-0.4, 0.4)}, random_rotation(random)};
      const double gap = mesh_pair_distance(sheet, body, {pose.rotation, pose.position}).distance;
      const Contact contact = scene.query(pose, {});
      if (gap > 1e-12) {
        ASSERT_NEAR(contact.distance, gap, 1e-12) << k;
        ASSERT_EQ(load_size(contact), 0.0) << k;
        behind += pose.position.z < -0.2;
      } else {
        ASSERT_LT(contact.distance, 0.0) << k;
      }
    }
    EXPECT_GT(behind, 150);
  }
}

// Below the ground every body is as far from it as its highest point.
TEST(BodyAndSheet, BehindItAreApart) {
  const char *const bodies[] = {"cmb/1 box size=0.4,0.3,0.5", "cmb/1 ellipsoid size=0.4,0.5,0.6", "cmb/1 cylinder radius=0.2 length=0.5",
                                "cmb/1 cone radius=0.2 length=0.5", "cmb/1 sphere radius=0.25", "cmb/1 capsule radius=0.1 length=0.3"};
  const std::string ground = height_field_text(3.0, 13, level);
  // Turned over, the half-space below which they are is the one above.
  const BodyPose over{{}, upside_down()};
  Random random(6);
  for (const char *body : bodies) {
    const PairScene scene(body, ground), plane(body, "cmb/1 halfspace");
    for (int k = 0; k < 200; ++k) {
      BodyPose pose{{random.uniform(-1, 1), random.uniform(-1, 1), 0.0}, random_rotation(random)};
      const double gap = random.log_uniform(1e-6, 0.5);
      pose.position.z -= gap - plane.query(pose, over).distance;
      const Contact contact = scene.query(pose, {});
      ASSERT_NEAR(contact.distance, gap, 1e-8) << body << ' ' << k;
      ASSERT_TRUE(contact.points.empty()) << body << ' ' << k;
    }
  }
}

// A plate on its edge and a pin, deeper than they are thick.
TEST(BodyAndSheet, SlenderOnesCarryAsOnTheHalfspace) {
  const std::string ground = height_field_text(3.0, 13, level);
  for (const char *body : {"cmb/1 box size=0.002,0.2,0.4", "cmb/1 cylinder radius=0.002 length=0.4"}) {
    const PairScene scene(body, ground);
    for (const double depth : {1e-4, 2e-3, 2e-2, 0.15}) {
      EXPECT_NEAR(load_size(scene.query({{0.11, 0.07, 0.2 - depth}, {}}, {})), depth, 1e-12) << body;
    }
  }
}

// Two paths from above the ground to below it. The ground is gentle: deep behind a wavy one the pieces
// of a body in its triangles' wedges hang together no more.
void expect_no_jumps_right_through(const std::string &body, double least_load, Random &random) {
  const PairScene scene(body, height_field_text(3.0, 13, [](double x, double y) { return 0.2 * hills(x, y); }));
  for (int path = 0; path < 2; ++path) {
    const Mat3 first = random_rotation(random);
    const PathSums sums = follow(
        scene,
        [&](double s) {
          return BodyPose{{0.1 + 0.2 * s, 0.2, 0.5 - s}, product(rotation_about({0.6, 0.8, 0}, 0.5 * s), first)};
        },
        {}, 100, 3);
    EXPECT_GT(sums.largest_load, least_load);
    EXPECT_LT(sums.largest_jump, 1e-5 * sums.largest_load) << body.substr(0, 40) << ' ' << path;
  }
}

TEST(BodyAndSheet, LoadHasNoJumpsRightThrough) {
  Random random(7);
  for (const std::string &body : {mesh_text(mesh_samples::box_mesh({0.4, 0.3, 0.5}, 2)), mesh_text(mesh_samples::sphere_mesh(0.25, 1)),
                                  std::string("cmb/1 box size=0.4,0.3,0.5"), std::string("cmb/1 ellipsoid size=0.4,0.5,0.6"),
                                  std::string("cmb/1 cylinder radius=0.2 length=0.5"), std::string("cmb/1 cone radius=0.2 length=0.5")}) {
    expect_no_jumps_right_through(body, 0.1, random);
  }
}

TEST(BodyAndSheet, LoadOfSlenderOnesHasNoJumpsRightThrough) {
  Random random(8);
  for (const char *body : {"cmb/1 cone radius=0.5 length=0.02", "cmb/1 cone radius=0.005 length=0.5", "cmb/1 box size=0.4,0.4,0.01"}) {
    expect_no_jumps_right_through(body, 0.02, random);
  }
}

}  // namespace
}  // namespace test_sheet_pairs
