// Overlaps of round bodies with each other and with boxes and hulls: closed forms, polytopes within and around them, and what
// holds for all volumes.
#include <random>

#include "support/overlap_of.hpp"

namespace test_round_overlap {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;

class Random {
 public:
  explicit Random(unsigned seed) : generator_(seed) {}
  double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(generator_); }
  Vec3 place(double reach) { return {between(-reach, reach), between(-reach, reach), between(-reach, reach)}; }
  Mat3 turn() {
    const Vec3 axis = normalized(place(1.0));
    return rotation_about(axis, between(0.0, 2.0 * pi));
  }
  BodyPose pose(double reach) {
    const Vec3 position = place(reach);
    return {position, turn()};
  }

 private:
  std::mt19937 generator_;
};

double cap(double radius, double height) { return pi * height * height * (3.0 * radius - height) / 3.0; }

// A pair with its volume, turned at random.
void expect_volume(const std::string &a, const BodyPose &pose_a, const std::string &b, const BodyPose &pose_b, double volume,
                   double relative = 1e-9) {
  const PairScene scene(a, b), exchanged(b, a);
  Random random(7);
  for (int k = 0; k < 6; ++k) {
    const BodyPose motion = k == 0 ? BodyPose{} : random.pose(0.3);
    const BodyPose at_a = moved_by(motion, pose_a), at_b = moved_by(motion, pose_b);
    EXPECT_NEAR(overlap_of(scene, at_a, at_b).volume, volume, relative * volume) << a << ", " << b << ", motion " << k;
    EXPECT_NEAR(overlap_of(exchanged, at_b, at_a).volume, volume, relative * volume) << b << ", " << a << ", motion " << k;
  }
}

const Mat3 quarter_turn{{{1, 0, 0}, {0, 0, -1}, {0, 1, 0}}};

TEST(RoundOverlap, CrossedCylindersAreSteinmetzSolid) {
  expect_volume("cmb/1 cylinder radius=0.5 length=3", {}, "cmb/1 cylinder radius=0.5 length=3", {{}, quarter_turn},
                16.0 / 3.0 * 0.125);
}

TEST(RoundOverlap, SphereAndBox) {
  const std::string sphere = "cmb/1 sphere radius=1", box = "cmb/1 box size=4,4,4";
  expect_volume(sphere, {{2, 2, 2}, {}}, box, {}, pi / 6.0);        // a corner in its middle
  expect_volume(sphere, {{2, 2, 0}, {}}, box, {}, pi / 3.0);        // an edge
  expect_volume(sphere, {{2.5, 0, 0}, {}}, box, {}, cap(1.0, 0.5));  // a face
  expect_volume(sphere, {{0.3, 0.2, 0.1}, {}}, box, {}, 4.0 / 3.0 * pi);
  // A slab within the sphere.
  expect_volume(sphere, {}, "cmb/1 box size=4,4,0.6", {}, 4.0 / 3.0 * pi - 2.0 * cap(1.0, 0.7));
}

TEST(RoundOverlap, SphereAndCylinderThroughItsMiddle) {
  const double left = std::pow(1.0 - 0.36, 1.5);
  expect_volume("cmb/1 sphere radius=1", {}, "cmb/1 cylinder radius=0.6 length=5", {}, 4.0 / 3.0 * pi * (1.0 - left));
}

TEST(RoundOverlap, BodiesOnOneAxis) {
  expect_volume("cmb/1 cylinder radius=0.5 length=1", {{0, 0, 0.9}, {}}, "cmb/1 cylinder radius=0.5 length=1", {}, pi / 40.0);
  // Of a cone as far as it is thinner than the cylinder, and the cylinder below.
  expect_volume("cmb/1 cone radius=1 length=2", {}, "cmb/1 cylinder radius=0.5 length=9", {}, pi / 4.0 + pi / 12.0);
  // Two cones, tip to tip: both as thick half way.
  expect_volume("cmb/1 cone radius=1 length=2", {}, "cmb/1 cone radius=1 length=2", {{}, rotation_about({1, 0, 0}, pi)},
                2.0 * pi / 3.0 * 0.25);
  expect_volume("cmb/1 capsule radius=0.2 length=1", {{0, 0, 0.7}, {}}, "cmb/1 capsule radius=0.2 length=1", {},
                pi * 0.04 * 0.3 + 4.0 / 3.0 * pi * 0.008);
  expect_volume("cmb/1 cone radius=0.2 length=0.6", {{0, 0, -2.2}, {}}, "cmb/1 box size=4,4,4", {}, pi / 3.0 * 0.1 / 900.0);
}

TEST(RoundOverlap, EllipsoidsAreStretchedSpheres) {
  // Two balls of radius 1 whose middles are d apart share two caps; stretched by 0.5, 0.4, 0.3.
  const std::string body = "cmb/1 ellipsoid size=1,0.8,0.6";
  for (const Vec3 &apart : {Vec3{1.2, 0, 0}, Vec3{0.5, 0.8, -0.4}, Vec3{0.0, 0.1, 1.9}, Vec3{0.1, 0.02, 0.0}}) {
    const double d = norm(apart);
    expect_volume(body, {{0.5 * apart.x, 0.4 * apart.y, 0.3 * apart.z}, {}}, body, {}, 0.06 * 2.0 * cap(1.0, 1.0 - 0.5 * d));
  }
  expect_volume(body, {}, body, {}, 0.06 * 4.0 / 3.0 * pi);
  expect_volume(body, {{0.1, 0, 0}, {}}, "cmb/1 cylinder radius=2 length=3", {}, 0.06 * 4.0 / 3.0 * pi);
}

TEST(RoundOverlap, ShallowAsAMillionth) {
  // The pose itself is rounded by 1e-16: volumes go by its square.
  for (const double depth : {1e-2, 1e-4, 1e-6}) {
    const double relative = std::fmax(1e-9, 1e-14 / depth);
    expect_volume("cmb/1 sphere radius=1", {{0, 0, 3.0 - depth}, {}}, "cmb/1 box size=4,4,4", {}, cap(1.0, depth), relative);
    expect_volume("cmb/1 ellipsoid size=2,2,2", {{0, 0, 2.0 - depth}, {}}, "cmb/1 sphere radius=1", {},
                  2.0 * cap(1.0, 0.5 * depth), relative);
    expect_volume("cmb/1 cylinder radius=1 length=1", {{0, 0, 2.5 - depth}, {}}, "cmb/1 box size=4,4,4", {}, pi * depth,
                  relative);
  }
}

TEST(RoundOverlap, PatchOfACapIsItsCircle) {
  const PairScene scene("cmb/1 ellipsoid size=2,2,2", "cmb/1 box size=4,4,4");
  const cmb_overlap overlap = overlap_of(scene, {{0.1, 0.2, 2.6}, {}}, {});
  const double area = pi * 0.4 * 1.6, moment = area * area / (4.0 * pi);
  EXPECT_NEAR(overlap.patch_area, area, 1e-9);
  EXPECT_NEAR(norm(vector_of(overlap.patch_centroid) - Vec3{0.1, 0.2, 2.0 - 0.5 * overlap.volume / area}), 0.0, 1e-9);
  EXPECT_NEAR(norm(vector_of(overlap.centroid) - Vec3{0.1, 0.2, 2.6 - 0.75 * 1.6 * 1.6 / 2.6}), 0.0, 1e-9);
  for (int i = 0; i < 9; ++i) EXPECT_NEAR(overlap.patch_moment[i], i == 0 || i == 4 ? moment : 0.0, 1e-9) << i;
}

struct Body {
  const char *name, *text;
  // Radius and height of its outline; ends included.
  std::vector<std::pair<double, double>> (*outline)(int steps);
  Vec3 stretch;
};

using Outline = std::vector<std::pair<double, double>>;

Outline ball(int steps) {
  Outline line;
  for (int k = 0; k <= steps; ++k) line.push_back({std::sin(pi * k / steps), -std::cos(pi * k / steps)});
  return line;
}

Outline pill(int steps) {
  Outline line;
  for (int k = 0; k <= steps; ++k) {
    const double angle = 0.5 * pi * k / steps;
    line.push_back({0.3 * std::sin(angle), -0.25 - 0.3 * std::cos(angle)});
  }
  for (int k = 0; k <= steps; ++k) {
    const double angle = 0.5 * pi * k / steps;
    line.push_back({0.3 * std::cos(angle), 0.25 + 0.3 * std::sin(angle)});
  }
  return line;
}

Outline can(int) { return {{0.3, -0.4}, {0.3, 0.4}}; }
Outline hat(int) { return {{0.45, -0.45}, {0.0, 0.45}}; }

const Body bodies[] = {
    {"sphere", "cmb/1 sphere radius=0.4", ball, {0.4, 0.4, 0.4}},
    {"ellipsoid", "cmb/1 ellipsoid size=0.6,0.7,1.1", ball, {0.3, 0.35, 0.55}},
    {"capsule", "cmb/1 capsule radius=0.3 length=0.5", pill, {1, 1, 1}},
    {"cylinder", "cmb/1 cylinder radius=0.3 length=0.8", can, {1, 1, 1}},
    {"cone", "cmb/1 cone radius=0.45 length=0.9", hat, {1, 1, 1}},
    {"box", "cmb/1 box size=0.6,0.9,0.7", nullptr, {}},
    {"hull", "cmb/1 hull vertices=0.4,0.1,0.1,-0.3,0.4,0.2,0,-0.5,0.1,0.1,0.2,0.6,-0.2,-0.1,-0.6,0.35,-0.3,-0.2", nullptr, {}},
};

// The hull of points on the body's surface, scaled by `factor` about its middle.
std::string hull_of(const Body &body, int around, int along, double factor) {
  if (body.outline == nullptr) return body.text;
  std::string text = "cmb/1 hull vertices=";
  const char *comma = "";
  for (const auto &[radius, height] : body.outline(along)) {
    for (int k = 0; k < (radius > 1e-9 ? around : 1); ++k) {
      const double angle = 2.0 * pi * k / around;
      text += comma + digits(factor * body.stretch.x * radius * std::cos(angle)) + "," +
              digits(factor * body.stretch.y * radius * std::sin(angle)) + "," + digits(factor * body.stretch.z * height);
      comma = ",";
    }
  }
  return text;
}

class RoundPair : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(RoundPair, LiesBetweenPolytopesWithinAndAround) {
  const Body &a = bodies[GetParam().first], &b = bodies[GetParam().second];
  const PairScene scene(a.text, b.text);
  constexpr int around = 24, along = 10;
  // What holds the body: all that is nearer than a facet's middle is inside the hull.
  const double grown = 1.0 / (std::cos(pi / around) * std::cos(pi / (2.0 * along)));
  const PairScene within(hull_of(a, around, along, 1.0), hull_of(b, around, along, 1.0));
  const PairScene fine(hull_of(a, 2 * around, 2 * along, 1.0), hull_of(b, 2 * around, 2 * along, 1.0));
  const PairScene beyond(hull_of(a, around, along, grown), hull_of(b, around, along, grown));
  Random random(static_cast<unsigned>(10 * GetParam().first + GetParam().second));
  for (int k = 0; k < 6; ++k) {
    const BodyPose pose_a = random.pose(0.25), pose_b = random.pose(0.25);
    const double volume = overlap_of(scene, pose_a, pose_b).volume, low = overlap_of(within, pose_a, pose_b).volume,
                 better = overlap_of(fine, pose_a, pose_b).volume, high = overlap_of(beyond, pose_a, pose_b).volume;
    EXPECT_GE(volume, low * (1.0 - 1e-9)) << k;
    EXPECT_GE(volume, better * (1.0 - 1e-9)) << k;
    EXPECT_LE(volume, high * (1.0 + 1e-9)) << k;
    // Facets are off by the square of their size: the limit.
    EXPECT_NEAR(volume, (4.0 * better - low) / 3.0, 4e-3 * volume) << k;
  }
}

TEST_P(RoundPair, IsTheSameTurnedExchangedAndScaled) {
  const Body &a = bodies[GetParam().first], &b = bodies[GetParam().second];
  const PairScene scene(a.text, b.text), exchanged(b.text, a.text);
  Random random(static_cast<unsigned>(100 + 10 * GetParam().first + GetParam().second));
  for (int k = 0; k < 12; ++k) {
    const BodyPose pose_a = random.pose(0.35), pose_b = random.pose(0.35), motion = random.pose(1.0);
    const BodyPose moved_a = moved_by(motion, pose_a), moved_b = moved_by(motion, pose_b);
    const cmb_overlap overlap = overlap_of(scene, pose_a, pose_b), other = overlap_of(exchanged, moved_b, moved_a);
    if (overlap.volume == 0.0) {
      EXPECT_EQ(other.volume, 0.0);
      continue;
    }
    EXPECT_NEAR(other.volume, overlap.volume, 1e-8 * overlap.volume) << k;
    const Vec3 centroid = motion.position + motion.rotation * vector_of(overlap.centroid);
    EXPECT_NEAR(norm(vector_of(other.centroid) - centroid), 0.0, 1e-8) << k;
    // The patch goes with the normal, which is less exact, and where two translations are as short another one.
    const Vec3 normal = motion.rotation * normal_of(scene, pose_a, pose_b);
    if (norm(normal + normal_of(exchanged, moved_b, moved_a)) > 1e-7) continue;
    EXPECT_NEAR(other.patch_area, overlap.patch_area, 1e-6 * overlap.patch_area) << k;
    const Vec3 patch = motion.rotation * vector_of(overlap.patch_centroid) + motion.position;
    EXPECT_NEAR(norm(vector_of(other.patch_centroid) - patch), 0.0, 1e-6) << k;
  }
}

TEST_P(RoundPair, HasNoJumps) {
  const Body &a = bodies[GetParam().first], &b = bodies[GetParam().second];
  const PairScene scene(a.text, b.text);
  Random random(static_cast<unsigned>(200 + 10 * GetParam().first + GetParam().second));
  const BodyPose pose_b = random.pose(0.1);
  const Mat3 turn = random.turn();
  const Vec3 from = random.place(0.3), way = random.place(1.0), axis = normalized(random.place(1.0));
  double before = -1.0;
  constexpr int steps = 60;
  constexpr double step = 2e-4;
  for (int k = 0; k < steps; ++k) {
    const double s = step * k;
    const double volume =
        overlap_of(scene, {from + s * way, product(rotation_about(axis, s), turn)}, pose_b).volume;
    // A volume changes by at most the surface times the motion: less than 4 m2, 2.4 m along each metre of s.
    if (k > 0) {
      EXPECT_LE(std::fabs(volume - before), 9.6 * step) << k;
    }
    before = volume;
  }
  // Second differences: a jump of 1e-7 would show.
  const auto at = [&](double s) {
    return overlap_of(scene, {from + s * way, product(rotation_about(axis, s), turn)}, pose_b).volume;
  };
  for (int k = 1; k < steps; ++k) {
    const double s = 0.003 * k, h = 1e-5;
    EXPECT_NEAR(at(s + h) - 2.0 * at(s) + at(s - h), 0.0, 1e-7) << k;
  }
}

std::vector<std::pair<int, int>> round_pairs() {
  std::vector<std::pair<int, int>> pairs;
  for (int a = 0; a < 5; ++a) {
    for (int b = a; b < 7; ++b) {
      if (b > 0) pairs.push_back({a, b});
    }
  }
  return pairs;
}

INSTANTIATE_TEST_SUITE_P(AllKinds, RoundPair, testing::ValuesIn(round_pairs()), [](const auto &info) {
  return std::string(bodies[info.param.first].name) + "And" + bodies[info.param.second].name;
});

TEST(RoundOverlap, GrowsByItsPatchTimesTheDepth) {
  // On a face the normal stays, and one side of the overlap is the body's alone: dV/d(depth) is the patch's area.
  Random random(3);
  for (int kind = 0; kind < 5; ++kind) {
    const PairScene scene(bodies[kind].text, "cmb/1 box size=6,6,6");
    for (int k = 0; k < 6; ++k) {
      const Mat3 turn = random.turn();
      double height = 3.0 + 1.0;
      // Down until it is 5 cm deep.
      for (int step = 0; step < 60; ++step) {
        const double distance = scene.query({{0.2, 0.1, height}, turn}, {}).distance;
        height -= distance + 0.05;
      }
      const double h = 1e-4;
      const auto at = [&](double z) { return overlap_of(scene, {{0.2, 0.1, z}, turn}, {}); };
      const cmb_overlap middle = at(height);
      const double slope = (8.0 * (at(height - h).volume - at(height + h).volume) -
                            (at(height - 2.0 * h).volume - at(height + 2.0 * h).volume)) / (12.0 * h);
      // Where flat ends begin to dip in, the third derivative is large.
      EXPECT_NEAR(middle.patch_area, slope, 1e-5 * slope) << bodies[kind].name << " " << k;
    }
  }
}

TEST(RoundOverlap, SlenderBodiesAreNotMissed) {
  Random random(11);
  const PairScene scene("cmb/1 capsule radius=0.03 length=1.5", "cmb/1 cylinder radius=0.5 length=0.02");
  int overlapping = 0;
  for (int k = 0; k < 500; ++k) {
    const BodyPose a = random.pose(0.4), b = random.pose(0.4);
    if (scene.query(a, b).distance > -1e-6) continue;
    ++overlapping;
    EXPECT_GT(overlap_of(scene, a, b).volume, 0.0) << k;
  }
  EXPECT_GT(overlapping, 150);
}

TEST(RoundOverlap, GivesTheSameBitsAfterOtherQueries) {
  const PairScene scene(bodies[2].text, bodies[4].text), other(bodies[1].text, bodies[3].text);
  Random random(5);
  const BodyPose a = random.pose(0.2), b = random.pose(0.2);
  const cmb_overlap first = overlap_of(scene, a, b);
  for (int k = 0; k < 5; ++k) overlap_of(other, random.pose(0.3), random.pose(0.3));
  const cmb_overlap again = overlap_of(scene, a, b);
  EXPECT_EQ(first.volume, again.volume);
  EXPECT_EQ(first.patch_area, again.patch_area);
  for (int i = 0; i < 9; ++i) EXPECT_EQ(first.patch_moment[i], again.patch_moment[i]);
}

}  // namespace
}  // namespace test_round_overlap
