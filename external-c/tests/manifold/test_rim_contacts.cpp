// Cylinders and cones that stand or lie on bounded shapes carry as on a half-space.
#include "support/scene_query.hpp"

namespace test_rim_contacts {
namespace {

using namespace cmb::test;

constexpr double pi = 3.14159265358979323846;
constexpr double depth = 1e-3;
const char *const cylinder = "cmb/1 cylinder radius=0.3 length=0.5";
const char *const cone = "cmb/1 cone radius=0.3 length=0.5";
const char *const ground = "cmb/1 halfspace position=0,0,0.5";

struct Case {
  const char *name, *body, *support;
  BodyPose pose;
};

void PrintTo(const Case &c, std::ostream *stream) { *stream << c.name; }

const Mat3 lying = rotation_about({0, 1, 0}, pi / 2), yaw = rotation_about({0, 0, 1}, 0.7);


const Case cases[] = {
    {"capsule on a cylinder", "cmb/1 capsule radius=0.3 length=0.5", "cmb/1 cylinder radius=1 length=1",
     {{0.2, 0.1, 0.8 - depth}, product(yaw, lying)}},
};

class RimContacts : public testing::TestWithParam<Case> {};

// Level, every load and moment is that on the half-space, and so is how the moment answers a small tilt.
TEST_P(RimContacts, EqualThoseOnAHalfspace) {
  const Case &c = GetParam();
  const PairScene bounded(c.body, c.support), half(c.body, ground);
  for (const double tilt : {0.0, 2e-4}) {
    BodyPose pose = c.pose;
    pose.rotation = product(rotation_about({0.6, 0.8, 0}, tilt), pose.rotation);
    const Contact on_bounded = bounded.query(pose, {}, 64), on_half = half.query(pose, {}, 64);
    EXPECT_NEAR(on_bounded.distance, on_half.distance, 1e-12);
    // To first order in the tilt.
    const double slack = tilt == 0.0 ? 1e-9 : 0.01 * tilt / depth;
    EXPECT_LT(norm(on_bounded.load() - on_half.load()), slack * depth) << tilt;
    EXPECT_LT(norm(on_bounded.moment(pose.position) - on_half.moment(pose.position)), slack * depth * 0.3) << tilt;
  }
}

INSTANTIATE_TEST_SUITE_P(All, RimContacts, testing::ValuesIn(cases));

// So does the disc of a cone on another one's base: whose energy is that of the overlap, as on a box, and rights it half as much again as that
// on a half-space.
TEST(RimContacts, ConeOnAConesBaseCarriesAsOnABox) {
  const PairScene on_base(cone, "cmb/1 cone radius=1 length=1 rotation=1,0,0,0,-1,0,0,0,-1"), on_box(cone, "cmb/1 box size=2,2,1");
  for (const double tilt : {0.0, 2e-4, 0.02, 0.3}) {
    BodyPose pose{{0.2, 0.1, 1.0}, product(rotation_about({0.6, 0.8, 0}, tilt), yaw)};
    pose.position.z -= on_box.query(pose, {}, 8).distance + depth;
    const Contact bases = on_base.query(pose, {}, 64), boxes = on_box.query(pose, {}, 64);
    EXPECT_NEAR(bases.distance, -depth, 1e-12);
    EXPECT_LT(norm(bases.load() - boxes.load()), 1e-6 * norm(boxes.load())) << tilt;
    EXPECT_LT(norm(bases.moment(pose.position) - boxes.moment(pose.position)), 1e-6 * 0.3 * norm(boxes.load())) << tilt;
  }
}

// On a hull a polygon stands for the disc: it is no tessellation, and carries what the disc carries on a box however deep.
TEST(RimContacts, DiscOnAHullCarriesAsOnABox) {
  std::string hull = "cmb/1 hull vertices=";
  for (const char *corner : {"2,2", "2,-2", "-2,2", "-2,-2"}) hull += std::string(corner) + ",0.5," + corner + ",-0.5,";
  hull.pop_back();
  for (const char *body : {cylinder, cone}) {
    const PairScene on_hull(body, hull), on_box(body, "cmb/1 box size=4,4,1");
    for (const double deep : {0.01, 0.03, 0.1}) {
      for (const double degrees : {0.0, 1.0, 3.0, 6.0, 12.0}) {
        BodyPose pose{{0.2, 0.1, 2.0}, product(rotation_about({0.6, 0.8, 0}, degrees * pi / 180), yaw)};
        pose.position.z -= on_box.query(pose, {}, 8).distance + deep;
        const Contact hulls = on_hull.query(pose, {}, 64), boxes = on_box.query(pose, {}, 64);
        ASSERT_NEAR(hulls.distance, -deep, 1e-9);
        EXPECT_LT(norm(hulls.load() - boxes.load()), 0.02 * norm(boxes.load())) << body << " " << deep << " " << degrees;
        EXPECT_LT(norm(hulls.moment(pose.position) - boxes.moment(pose.position)), 0.02 * 0.3 * norm(boxes.load()))
            << body << " " << deep << " " << degrees;
      }
    }
  }
}

// Whether the corner is under the disc is lost in rounding; what the outline carries is not.
TEST(RimContacts, RimThroughAFacesCornerCarriesAsBesideIt) {
  const PairScene scene(cylinder, "cmb/1 box size=4,4,1");
  for (int k = 0; k < 40; ++k) {
    const double angle = 0.02 + 0.0375 * k, tilt = 0.002 * (k % 4);
    const Mat3 rotation = product(rotation_about({0.6, 0.8, 0}, tilt), yaw);
    // The disc's middle is so placed that its rim runs through the corner.
    const Vec3 middle = 0.25 * (rotation * Vec3{0, 0, 1});
    const Vec3 rim = 0.3 * (rotation * Vec3{std::cos(angle), std::sin(angle), 0.0});
    const Vec3 on_corner{2.0 - rim.x + middle.x, 2.0 - rim.y + middle.y, 0.5 - depth - rim.z + middle.z};
    const auto load_at = [&](double aside) {
      return norm(scene.query({on_corner + Vec3{aside, aside, 0.0}, rotation}, {}, 64).load());
    };
    const double beside = load_at(1e-9);
    for (int step = -8; step <= 8; ++step) EXPECT_NEAR(load_at(step * 1e-16), beside, 1e-6 * depth) << angle;
  }
}

// The square of the tilt's sine is nothing, or hardly a number.
TEST(RimContacts, TiltsOfNothingAreNone) {
  for (const char *body : {cylinder, cone}) {
    const PairScene scene(body, ground);
    const BodyPose level{{0.1, 0.2, 0.75 - depth}, yaw};
    const Contact none = scene.query(level, {}, 64);
    for (const double tilt : {1e-140, 1e-157, 3e-161, 3e-162, 1e-170, 1e-300}) {
      BodyPose pose = level;
      pose.rotation = product(rotation_about({0.6, 0.8, 0}, tilt), pose.rotation);
      const Contact tilted = scene.query(pose, {}, 64);
      EXPECT_EQ(tilted.points.size(), none.points.size()) << tilt;
      EXPECT_LT(norm(tilted.load() - none.load()), 1e-12 * depth) << tilt;
      EXPECT_LT(norm(tilted.moment(pose.position) - none.moment(pose.position)), 1e-12 * depth) << tilt;
      for (const Point &point : tilted.points) {
        EXPECT_NEAR(std::hypot(point.position.x - 0.1, point.position.y - 0.2), 0.3, 1e-12) << tilt;
      }
    }
  }
}

TEST(RimContacts, BoxStandsOnACylinder) {
  const PairScene scene("cmb/1 box size=0.5,0.4,0.3", "cmb/1 cylinder radius=1 length=1");
  const Contact contact = scene.query({{0.1, 0.2, 0.65 - depth}, yaw}, {}, 64);
  EXPECT_NEAR(contact.total_weight(), 1.0, 1e-9);
  EXPECT_EQ(contact.points.size(), 4u);
}

}  // namespace
}  // namespace test_rim_contacts
