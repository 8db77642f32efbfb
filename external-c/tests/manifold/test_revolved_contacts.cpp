// Cylinders and cones on boxes, hulls and each other: the surface of their overlap, and closed forms of what it stores.
#include "manifold/revolved/revolved_on_polytope.hpp"
#include "manifold/revolved/revolved_pair.hpp"
#include "math/pose_algebra.hpp"
#include "shape/contact_polytope.hpp"
#include "support/mesh_text.hpp"
#include "support/overlap_of.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_revolved_contacts {
namespace {

using namespace cmb::test;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;
constexpr double depth = 1e-3, radius = 0.3, length = 0.5;
const char *const cylinder = "cmb/1 cylinder radius=0.3 length=0.5";
const char *const cone = "cmb/1 cone radius=0.3 length=0.5";
const char *const table = "cmb/1 box size=4,4,1";
const char *const drum = "cmb/1 cylinder radius=2 length=1";
const char *const base_up = "cmb/1 cone radius=2 length=1 rotation=1,0,0,0,-1,0,0,0,-1";
const char *const same_as_hull = "cmb/1 hull vertices=2,2,0.5,2,2,-0.5,2,-2,0.5,2,-2,-0.5,-2,2,0.5,-2,2,-0.5,-2,-2,0.5,-2,-2,-0.5";
const Mat3 lying = rotation_about({0, 1, 0}, pi / 2), yaw = rotation_about({0, 0, 1}, 0.7);

// Flat, a face carries its depth and rights itself by three times the second moment of its area: of a disc, 3/4 radius^2.
TEST(RevolvedContacts, StandingOnAFlatFace) {
  for (const char *body : {cylinder, cone}) {
    for (const char *support : {table, same_as_hull, drum, base_up}) {
      if (body == cone && support == base_up) continue;  // two cones
      const PairScene scene(body, support);
      EXPECT_NEAR(scene.query({{0.2, 0.1, 0.75 - depth}, yaw}, {}, 64).load().z, depth, 2e-7 * depth);
      const double tilt = 1e-6;
      const BodyPose pose{{0, 0, 0.75 - depth}, rotation_about({0, 1, 0}, tilt)};
      const Contact contact = scene.query(pose, {}, 64);
      const Vec3 middle = pose.position + 0.5 * length * (pose.rotation * Vec3{0, 0, -1});
      // A cone's area is less, the deeper in.
      EXPECT_NEAR(contact.moment(middle).y / (-0.75 * radius * radius * tilt), 1.0, 3.0 * depth / length) << body;
    }
  }
}

// The overlap is a segment h = d - x^2/(2 r) high: the mean of h^2 is 16/35 by 2/3 of d^2. Tilted along its axis, d grows linearly.
TEST(RevolvedContacts, LyingOnAFlatFace) {
  for (const char *support : {table, same_as_hull, drum, base_up}) {
    const PairScene scene(cylinder, support);
    for (const double deep : {1e-3, 1e-5, 1e-7}) {
      const BodyPose level{{0.2, 0.1, 0.5 + radius - deep}, product(yaw, lying)};
      EXPECT_NEAR(scene.query(level, {}, 64).load().z, 24.0 / 35.0 * deep, 2.0 * deep / radius * deep + 1e-15);
    }
    const double tilt = 1e-3 * depth / length;
    const BodyPose tilted{{0, 0, 0.5 + radius - depth}, product(rotation_about({0, 1, 0}, tilt), lying)};
    const double righting = 24.0 / 35.0 * length * length / 3.0 * tilt;
    EXPECT_NEAR(scene.query(tilted, {}, 64).moment(tilted.position).y, -righting, 0.02 * righting);
  }
}

// In the middle of an end there is no way from one axis to the other, but by rounding. Slender cones, and cones base on base, too.
TEST(RevolvedContacts, StandingInTheMiddleOfAnEnd) {
  Random random(2);
  const Mat3 over = rotation_about({1, 0, 0}, pi);
  for (int k = 0; k < 500; ++k) {
    const double r = random.log_uniform(0.02, 0.5), l = r * random.log_uniform(0.2, 20.0), deep = r * random.log_uniform(1e-7, 1e-4);
    const std::string standing = "cmb/1 cone radius=" + digits(r) + " length=" + digits(l);
    const double wide = random.uniform(1.0, 3.0) * r;
    for (const char *kind : {"cylinder", "cone"}) {
      const PairScene scene(standing, "cmb/1 " + std::string(kind) + " radius=" + digits(wide) + " length=0.5");
      const BodyPose pose{{0, 0, 0.5 * l + 0.25 - deep}, rotation_about({0, 0, 1}, random.uniform(0, 2 * pi))};
      const BodyPose support{{}, kind == std::string("cone") ? over : Mat3{}};
      EXPECT_NEAR(scene.query(pose, support, 64).load().z, deep, 2e-2 * deep) << kind << " " << r << " " << l << " " << deep;
    }
  }
}

// On its mantle a cone carries as a lying cylinder does: the depth is the same all along.
TEST(RevolvedContacts, ConeLyingOnItsMantle) {
  for (const char *support : {table, same_as_hull, drum}) {
    const PairScene scene(cone, support);
    for (const double deep : {1e-3, 1e-4, 1e-5, 1e-6, 1e-7}) {
      const Mat3 level = product(yaw, rotation_about({0, 1, 0}, pi / 2 + std::atan2(radius, length)));
      const Vec3 apex = level * Vec3{0, 0, 0.5 * length};
      const BodyPose pose{{0.2, 0.1, 0.5 - deep - apex.z}, level};
      EXPECT_NEAR(scene.query(pose, {}, 64).load().z / deep, 24.0 / 35.0, 20.0 * deep / radius + 1e-5) << support << " " << deep;
    }
  }
}

// Level, a disc over a face's corner is carried at the middle of the area that both have in common.
TEST(RevolvedContacts, DiscOverAFacesCornerIsCarriedAtTheAreasMiddle) {
  const PairScene scene(cylinder, table);
  const Contact contact = scene.query({{1.9, 1.95, 0.75 - depth}, yaw}, {}, 64);
  double area = 0.0;
  Vec3 first;
  constexpr int count = 200000;
  for (int k = 0; k < count; ++k) {  // strips along x
    const double y = 1.65 + 0.35 * (k + 0.5) / count, half = std::sqrt(radius * radius - (y - 1.95) * (y - 1.95));
    const double from = 1.9 - half, to = std::min(2.0, 1.9 + half);
    area += to - from;
    first = first + (to - from) * Vec3{0.5 * (from + to), y, 0};
  }
  Vec3 carried;
  for (const Point &p : contact.points) carried = carried + p.weight * p.depth * p.position;
  EXPECT_NEAR(contact.load().z, depth, 1e-6 * depth);
  EXPECT_NEAR(carried.x / depth, first.x / area, 2e-5);
  EXPECT_NEAR(carried.y / depth, first.y / area, 2e-5);
}

// Where a cylinder or cone lies along a face, next to touching, the overlap is thinner than rounding of its border: what it carries is of its
// depth all the same, and where it is.
TEST(RevolvedContacts, LyingNextToTouchingTheyCarryNoMoreThanTheirDepth) {
  Random random(7);
  for (const char *kind : {"cylinder", "cone"}) {
    for (const char *support : {table, same_as_hull, drum}) {
      for (const double wide : {0.02, 0.1, 0.3}) {
        const PairScene scene(std::string("cmb/1 ") + kind + " radius=" + digits(wide) + " length=0.2", support);
        const double half_angle = std::string(kind) == "cone" ? std::atan(wide / 0.2) : 0.0;
        const Mat3 on_mantle = product(rotation_about({0, 1, 0}, half_angle), lying);
        for (int k = 0; k < 100; ++k) {
          const double deep = random.log_uniform(1e-17, 1e-7), turned = random.integer(0, 1) * random.log_uniform(1e-16, 1e-7);
          const Mat3 rotation = product(rotation_about(random.direction(), turned), product(rotation_about({0, 0, 1}, random.uniform(0, 6)), on_mantle));
          BodyPose pose{{0.2, 0.1, 0.5 + wide}, rotation};
          pose.position.z -= scene.query(pose, {}, 64).distance + deep;
          const Contact contact = scene.query(pose, {}, 64);
          const double d = -contact.distance;
          if (!(d > 0.0)) continue;
          EXPECT_GT(contact.load().z, 0.0) << kind << " " << wide << " on " << support << " " << k << ", " << d << " deep";
          EXPECT_LE(contact.load().z, 4.0 * d + 1e-15) << kind << " " << wide << " on " << support << " " << k << ", " << d << " deep";
          for (const Point &point : contact.points) EXPECT_LT(norm(point.position - pose.position), 2.0) << kind << " " << k;
        }
      }
    }
  }
}

// Discs that overlap in part touch in a lens, at whose middle they are carried.
TEST(RevolvedContacts, DiscsThatOverlapInPartAreCarriedAtTheLensMiddle) {
  const PairScene scene(cylinder, "cmb/1 cylinder radius=0.4 length=1");
  const Contact contact = scene.query({{0.5, 0, 0.75 - depth}, yaw}, {}, 64);
  double area = 0.0, first = 0.0;
  constexpr int count = 200000;
  for (int k = 0; k < count; ++k) {  // strips across
    const double x = 0.2 + 0.2 * (k + 0.5) / count;
    const double half = std::sqrt(std::max(0.0, std::min(0.16 - x * x, 0.09 - (x - 0.5) * (x - 0.5))));
    area += half, first += half * x;
  }
  Vec3 carried;
  for (const Point &p : contact.points) carried = carried + p.weight * p.depth * p.position;
  EXPECT_NEAR(contact.load().z, depth, 1e-6 * depth);
  EXPECT_NEAR(carried.x / depth, first / area, 1e-4);
  EXPECT_NEAR(carried.y / depth, 0.0, 1e-6);
}

// Where surfaces of both coincide it is clear all the same whose is within.
TEST(RevolvedContacts, EqualCylindersOnOneAxisCarryAsOnAFace) {
  const PairScene scene(cylinder, cylinder);
  for (const double turn : {0.0, 0.3, 1.0}) {
    const BodyPose pose{{0, 0, length - depth}, rotation_about({0, 0, 1}, turn)};
    EXPECT_NEAR(scene.query(pose, {}, 64).load().z, depth, 1e-6 * depth) << turn;
  }
  // Side by side, ends flush: two segments of height h = d/2 - x^2/(2 r), so that the mean of (2 h)^2 is 16/35 by 2/3 of d^2.
  for (const double turn : {0.0, 0.3, 1.0}) {
    const BodyPose pose{{2 * radius - depth, 0, 0}, rotation_about({0, 0, 1}, turn)};
    EXPECT_NEAR(scene.query(pose, {}, 64).load().x, 24.0 / 35.0 * depth, 3.0 * depth / radius * depth) << turn;
  }
}

// The border of a disc 0.5 mm thick in a cylinder's edge: the overlap's spread across is next to rounding, and its load still changes by no
// more than the depth does.
TEST(RevolvedContacts, SliversCarryContinuously) {
  const PairScene scene("cmb/1 cone radius=0.34479846279395732 length=0.00045579525410665021",
                        "cmb/1 cylinder radius=0.34623904337821976 length=0.72018589449230075");
  const Vec3 axis = normalized(Vec3{-0.730365616779737, 0.682493839068252, 0.027716880413080});
  const Vec3 u = normalized(cross(axis, Vec3{0, 0, 1})), v = cross(axis, u);
  const Mat3 rotation = transposed(Mat3{{u, v, axis}});
  double last = 0.0;
  for (int k = 0; k < 200; ++k) {
    const BodyPose pose{{0.579983279081 + 1e-9 * k, 0.285067752694, -0.331446591697}, rotation};
    const double load = norm(scene.query(pose, {}, 64).load());
    if (k > 0) {
      EXPECT_NEAR(load, last, 1e-2 * last) << k;
    }
    last = load;
  }
}

class OverlapSurfaces : public testing::TestWithParam<const char *> {};

// Closed: its area vectors and their moments sum to nothing. The volume is that of slices (src/volume/), which share no code with it.
TEST_P(OverlapSurfaces, AreClosedAndHoldTheVolume) {
  const bool is_cone = std::string(GetParam()) == "cone";
  Random random(7);
  for (int k = 0; k < 400; ++k) {
    const double r = random.uniform(0.2, 0.5), l = random.uniform(0.02, 1.5);
    const Vec3 size{random.uniform(0.1, 1), random.uniform(0.1, 1), random.uniform(0.1, 1)};
    const cmb::RevolvedBody body(is_cone ? cmb::convex::make_cone(r, l) : cmb::convex::make_cylinder(r, l));
    const cmb::ContactPolytope box(cmb::convex::Polytope::box(size));
    Vec3 place;  // in both
    do {
      place = {random.uniform(-r, r), random.uniform(-r, r), random.uniform(-0.5, 0.5) * l};
    } while (body.beyond_mantle(place) >= 0.0);
    const Vec3 in_box{random.uniform(-0.5, 0.5) * size.x, random.uniform(-0.5, 0.5) * size.y, random.uniform(-0.5, 0.5) * size.z};
    const Vec3 axis = normalized(Vec3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
    const Mat3 rotation = rotation_about(axis, k % 8 == 0 ? 0.0 : random.uniform(0, pi));
    const BodyPose pose{place - rotation * in_box, rotation};
    cmb::RevolvedOnPolytope finder;
    cmb::OverlapSurface surface;
    ASSERT_TRUE(finder.find(body, box.geometry(), {rotation, pose.position}, place, surface)) << k;
    Vec3 areas, moments;
    double whole = 0.0;
    for (const auto *side : {&surface.of_a(), &surface.of_b()}) {
      for (const cmb::OverlapSurface::Node &node : *side) {
        areas = areas + node.area;
        moments = moments + cross(node.at, node.area);
        whole += norm(node.area);
      }
    }
    EXPECT_LT(norm(areas), 1e-7 * whole) << k;
    EXPECT_LT(norm(moments), 1e-7 * whole) << k;
    if (k >= 40) continue;
    const std::string text = "cmb/1 " + std::string(GetParam()) + " radius=" + digits(r) + " length=" + digits(l);
    const PairScene scene(text, "cmb/1 box size=" + digits(size.x) + "," + digits(size.y) + "," + digits(size.z));
    const cmb_overlap sliced = overlap_of(scene, {}, pose);
    EXPECT_NEAR(surface.volume(), sliced.volume, 1e-6 * sliced.volume) << k;
    EXPECT_LT(norm(surface.place() + surface.middle() - cmb::test::vector_of(sliced.centroid)), 1e-6) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(All, OverlapSurfaces, testing::Values("cylinder", "cone"));

// What a face carries by how deep it is does not depend on where the body stands: to rounding of places, by the depth. So it is for faces that
// are inclined in their body's frame, and for mantles.
TEST(RevolvedContacts, ThinOverlapsKeepTheirDigits) {
  const double half_angle = std::atan2(radius, length);
  const Vec3 n = normalized(Vec3{1, 1, 1}), u = normalized(cross(n, Vec3{1, 0, 0}));
  const struct {
    const char *text;
    Mat3 level;
    double height;
  } bodies[] = {{cylinder, {}, 0.5 * length},
                {cylinder, product(lying, yaw), radius},
                {cone, product(rotation_about({0, 1, 0}, half_angle), lying), 0.5 * length * std::sin(half_angle)},
                {"cmb/1 hull vertices=0.5,0,0,-0.5,0,0,0,0.5,0,0,-0.5,0,0,0,0.5,0,0,-0.5", {{u, cross(n, u), n}}, 0.5 / std::sqrt(3.0)}};
  Random random(3);
  for (const auto &body : bodies) {
    const PairScene scene(body.text, table);
    for (const double deep : {1e-4, 1e-6, 1e-7}) {
      double first = 0.0;
      for (int k = 0; k < 100; ++k) {
        const Mat3 turn = rotation_about({0, 0, 1}, random.uniform(0, 2 * pi));
        const BodyPose pose{{random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), 0.5 + body.height - deep}, product(turn, body.level)};
        const double load = norm(scene.query(pose, {}, 64).load());
        if (k == 0) first = load;
        EXPECT_NEAR(load / first, 1.0, 1e-13 / deep) << body.text << " " << deep;
      }
    }
  }
}

// A cone hardly off its mantle, on its rim or its apex: what overlaps is a sliver, thinner than it is wide by a thousand and more. It pushes out,
// across the face, and with no more than its depth.
TEST(RevolvedContacts, ConesHardlyOffTheirMantleArePushedOutByNoMoreThanTheirDepth) {
  Random random(6);
  for (int body = 0; body < 20; ++body) {
    const double r = random.log_uniform(0.01, 0.5), l = r * random.log_uniform(0.3, 5.0), size = std::max(r, l);
    const PairScene scene("cmb/1 cone radius=" + digits(r) + " length=" + digits(l), table);
    for (int k = 0; k < 1000; ++k) {
      const double lift = random.log_uniform(1e-4, 0.5) * (random.integer(0, 1) == 1 ? 1.0 : -1.0), deep = size * random.log_uniform(1e-7, 1e-4);
      const Mat3 yaw = rotation_about({0, 0, 1}, random.uniform(0, 2 * pi)), roll = rotation_about({0, 0, 1}, random.uniform(0, 2 * pi));
      BodyPose pose{{random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), 0.5 + 2.0 * size},
                    product(product(yaw, rotation_about({0, 1, 0}, 0.5 * pi + std::atan2(r, l) + lift)), roll)};
      pose.position.z -= scene.query(pose, {}, 64).distance + deep;
      const Vec3 load = scene.query(pose, {}, 64).load();
      EXPECT_GE(load.z, 0.0) << r << " " << l << " " << lift << " " << deep;
      EXPECT_LE(load.z, 1.01 * deep) << r << " " << l << " " << lift << " " << deep;
      EXPECT_LE(std::hypot(load.x, load.y), 0.05 * deep) << r << " " << l << " " << lift << " " << deep;
    }
  }
}

// Cones whose axis is as good as in the plane of a face: the plane's conic next to the apex turns at once. Tips under a face's border, shifted
// by rounding and more; the surface is closed all the same, to what its volume asks for.
// However near the pole of a conic is, as where a face is nearly along a mantle: rules that went by its angle alone left 1e-8 of its area open.
TEST(RevolvedContacts, SurfacesOfConesOnPolytopesAreClosed) {
  Random random(7);
  const cmb::convex::ConvexBody cube = cmb::convex::make_box({1, 1, 1});
  const cmb::ContactPolytope box(cmb::convex::Polytope::box({1, 1, 1}));
  cmb::RevolvedOnPolytope finder;
  cmb::OverlapSurface surface;
  for (int k = 0; k < 10000; ++k) {
    const cmb::convex::ConvexBody shape = cmb::convex::make_cone(random.uniform(0.1, 0.5), random.uniform(0.1, 1.0));
    const cmb::RevolvedBody body(shape);
    const Mat3 turn = random_bodies::random_rotation(random);
    const Vec3 way = random.direction(), lowest = cmb::convex::core_support(shape, -transposed_times(turn, way)).point;
    const double deep = body.radius * random.log_uniform(1e-2, 0.5);
    const cmb::Pose pose{turn, cmb::convex::core_support(cube, way).point - deep * way - turn * lowest};
    ASSERT_TRUE(finder.find(body, box.geometry(), pose.inverse(), lowest, surface)) << k;
    EXPECT_LT(surface.gap(), 1e-10 * (surface.area_a() + surface.area_b())) << k << " " << deep;
  }
}

TEST(RevolvedContacts, SurfacesOfTipsOnBordersAreClosed) {
  Random random(5);
  const cmb::ContactPolytope box(cmb::convex::Polytope::box({1, 1, 1}));
  cmb::RevolvedOnPolytope finder;
  cmb::OverlapSurface surface;
  for (int k = 0; k < 20000; ++k) {
    const cmb::RevolvedBody body(cmb::convex::make_cone(random.uniform(0.02, 0.5), random.uniform(0.02, 0.5)));
    const double deep = 2.0 * body.half * random.log_uniform(1e-6, 0.3), tilt = k % 2 == 0 ? 0.0 : random.uniform(-0.5, 0.5);
    const Mat3 down = rotation_about({1, 0, 0}, pi - tilt);  // about the normal of the face whose plane holds the axis
    const Vec3 tip = Vec3{0.5, random.uniform(-0.4, 0.4), 0.5 - deep} + random.log_uniform(1e-16, 1e-3) * random.direction();
    const cmb::Pose pose{down, tip - body.half * down.column(2)};
    const bool found = finder.find(body, box.geometry(), pose.inverse(), {0, 0, body.half - 0.1 * deep}, surface);
    if (surface.of_a().empty() && surface.of_b().empty()) continue;  // shifted out
    ASSERT_TRUE(found) << k << " " << deep;
    EXPECT_LT(surface.gap(), 1e-7 * surface.area_a()) << k << " " << deep;
  }
}

struct RevolvedKind {
  const char *name;
  bool is_cone;
  double least_ratio, most_ratio;  // of the radius by the length
};

constexpr RevolvedKind revolved_kinds[] = {{"cylinder", false, 0.3, 2.0}, {"rod", false, 1e-3, 0.05}, {"disc", false, 4.0, 1e3},
                                           {"cone", true, 0.3, 2.0},      {"needle", true, 1e-3, 0.05}, {"blunt cone", true, 4.0, 1e3}};

cmb::convex::ConvexBody any_revolved(const RevolvedKind &kind, Random &random) {
  const double ratio = random.log_uniform(kind.least_ratio, kind.most_ratio), size = random.uniform(0.2, 0.5);
  const double r = ratio < 1.0 ? ratio * size : size, l = ratio < 1.0 ? size : size / ratio;
  return kind.is_cone ? cmb::convex::make_cone(r, l) : cmb::convex::make_cylinder(r, l);
}

// A third at random, a third with axes along or across each other, a third nearly so.
Mat3 any_rotation(Random &random) {
  const int kind = random.integer(0, 2);
  if (kind == 0) return random_bodies::random_rotation(random);
  const Vec3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Mat3 rotation = rotation_about(axes[2], random.integer(0, 1) == 1 ? 0.5 * pi * random.integer(0, 3) : random.uniform(0, 2 * pi));
  for (const Vec3 &axis : axes) rotation = product(rotation_about(axis, 0.5 * pi * random.integer(0, 3)), rotation);
  return kind == 1 ? rotation : product(rotation_about(random.direction(), random.log_uniform(1e-12, 0.1)), rotation);
}

class PairSurfaces : public testing::TestWithParam<std::tuple<RevolvedKind, RevolvedKind>> {};

void PrintTo(const RevolvedKind &kind, std::ostream *stream) { *stream << kind.name; }

// All of the surface is found, however the bodies lie: it is closed, also where borders as thin as 1:1000 cross each other.
TEST_P(PairSurfaces, AreFoundWhole) {
  const auto &[kind_a, kind_b] = GetParam();
  Random random(11);
  cmb::RevolvedPair finder;
  cmb::OverlapSurface surface;
  cmb::convex::DistanceScratch scratch;
  constexpr double open = 1e-6;
  int found = 0;
  for (int k = 0; k < 500; ++k) {
    const cmb::convex::ConvexBody a = any_revolved(kind_a, random), b = any_revolved(kind_b, random);
    const Vec3 way = random.integer(0, 1) == 1 ? random.direction() : Vec3{0, 0, 1};
    const double thin = 2.0 * std::min(std::min(a.half.x, a.half.z), std::min(b.half.x, b.half.z)), deep = thin * random.log_uniform(1e-3, 0.4);
    const auto aside = [&] { return random.integer(0, 1) == 1 ? 0.05 * random.integer(-3, 3) : random.uniform(-0.2, 0.2); };
    const Mat3 rotation_b = any_rotation(random);
    cmb::Pose pose_a{any_rotation(random), Vec3{aside(), aside(), 0} + 3.0 * way};
    cmb::convex::SignedDistance answer;
    bool reached = false;
    for (int step = 0; step < 80 && !reached && norm(pose_a.translation) < 10.0; ++step) {  // it may pass by
      answer = cmb::convex::signed_distance(a, b, cmb::relative_pose(pose_a, {rotation_b, {}}), scratch);
      const double more = answer.distance + deep;
      reached = std::fabs(more) < 1e-3 * deep;
      if (!reached) pose_a.translation = pose_a.translation - more * way;
    }
    if (!reached) continue;
    ++found;
    const cmb::Pose b_in_a = cmb::relative_pose(pose_a, {rotation_b, {}});
    ASSERT_TRUE(finder.find(cmb::RevolvedBody(a), cmb::RevolvedBody(b), b_in_a, answer.point_a, answer.point_b, surface))
        << k << " " << deep << " deep";
    Vec3 moments;
    double whole = 0.0, size = 0.0;
    for (const auto *side : {&surface.of_a(), &surface.of_b()}) {
      for (const cmb::OverlapSurface::Node &node : *side) {
        moments = moments + cross(node.at, node.area);
        whole += norm(node.area), size = std::max(size, norm(node.at));
      }
    }
    EXPECT_LT(surface.gap(), open * whole) << k << " " << deep << " deep";
    EXPECT_LT(norm(moments), open * whole * size) << k << " " << deep << " deep";
  }
  EXPECT_GT(found, 150);
}

INSTANTIATE_TEST_SUITE_P(All, PairSurfaces, testing::Combine(testing::ValuesIn(revolved_kinds), testing::ValuesIn(revolved_kinds)));

// Two equal crossed cylinders, whose mantles cross in two ellipses through each other: Steinmetz' solid, of 16/3 r^3. Lying the
// same way the crossing runs along all of their rulings.
TEST(RevolvedContacts, CrossingsThroughThemselvesAreWhole) {
  cmb::RevolvedPair finder;
  cmb::OverlapSurface surface;
  const cmb::RevolvedBody body(cmb::convex::make_cylinder(0.3, 4.0));
  for (const double angle : {0.5 * pi, 1.0, 0.5}) {
    const Mat3 rotation = rotation_about({1, 0, 0}, angle);
    ASSERT_TRUE(finder.find(body, body, {rotation, {}}, {0.3, 0, 0}, {-0.3, 0, 0}, surface)) << angle;
    const double solid = 16.0 / 3.0 * 0.027 / std::sin(angle);
    EXPECT_NEAR(surface.volume(), solid, 1e-9 * solid) << angle;
  }
  for (const double tilt : {0.0, 1e-15, 1e-12, 1e-9, 1e-6}) {
    const double far = 0.5, half_angle = std::acos(0.5 * far / 0.3), lens = 2.0 * 0.09 * (half_angle - 0.5 * std::sin(2.0 * half_angle)) * 4.0;
    const cmb::Pose beside{rotation_about({1, 0, 0}, tilt), {far, 0, 0}};
    ASSERT_TRUE(finder.find(body, body, beside, {0.3, 0, 0}, {far - 0.3, 0, 0}, surface)) << tilt;
    EXPECT_NEAR(surface.volume(), lens, (1e-9 + 10.0 * tilt) * lens) << tilt;
  }
}

// A cone through a cylinder about one axis: they cross in one circle, where the radii are equal.
TEST(RevolvedContacts, CrossingsOnOneAxisAreCircles) {
  cmb::RevolvedPair finder;
  cmb::OverlapSurface surface;
  const cmb::RevolvedBody rod(cmb::convex::make_cylinder(0.2, 1.0)), tip(cmb::convex::make_cone(0.4, 1.0));
  for (const double tilt : {0.0, 1e-14, 1e-10, 1e-7}) {
    ASSERT_TRUE(finder.find(rod, tip, {rotation_about({1, 0, 0}, tilt), {}}, {0.2, 0, 0}, {-0.2, 0, 0}, surface)) << tilt;
    // Less the wedge between both ends, which lie in one plane.
    const double volume = pi * 0.04 * 0.5 + pi * 0.04 * 0.5 / 3.0 - 2.0 / 3.0 * 0.008 * tilt;
    EXPECT_NEAR(surface.volume(), volume, 1e-9 * volume) << tilt;
  }
}

}  // namespace
}  // namespace test_revolved_contacts
