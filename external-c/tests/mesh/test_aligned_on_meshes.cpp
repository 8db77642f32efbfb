// Convex bodies on meshes and height fields in poses that users have: faces in faces, edges along edges and over inner ones, axes through corners, by
// rounding; from next to nothing deep on. The sibling of manifold/test_aligned_bodies.cpp.
#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "support/mesh_text.hpp"
#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_aligned_on_meshes {
namespace {

using namespace cmb::test;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;

struct Body {
  std::string text;
  double lengths[3], least;
};

// As wide as a metre, as thin as a fortieth.
Body any_body(Random &random, const std::string &kind) {
  const auto length = [&] { return random.integer(0, 1) == 1 ? 0.1 * random.integer(1, 8) : random.log_uniform(0.025, 1.0); };
  const double a = length(), b = length(), c = length();
  if (kind == "box" || kind == "ellipsoid") {
    return {"cmb/1 " + kind + " size=" + digits(a) + "," + digits(b) + "," + digits(c), {a, b, c}, std::min({a, b, c})};
  }
  if (kind == "octahedron") {
    const std::string x = digits(0.5 * a), y = digits(0.5 * b), z = digits(0.5 * c);
    return {"cmb/1 hull vertices=" + x + ",0,0,-" + x + ",0,0,0," + y + ",0,0,-" + y + ",0,0,0," + z + ",0,0,-" + z, {a, b, c},
            0.5 * std::min({a, b, c})};
  }
  const double high = kind == "capsule" ? a + b : b;
  return {"cmb/1 " + kind + " radius=" + digits(0.5 * a) + " length=" + digits(b), {a, a, high}, std::min(a, b)};
}

// About a metre large, with sides at multiples of a quarter of that.
std::string ground_of(const std::string &kind) {
  using namespace mesh_samples;
  if (kind == "cube") return mesh_text(with_speck(box_mesh({1, 1, 1}, 1)));
  if (kind == "divided_cube") return mesh_text(with_speck(box_mesh({1, 1, 1}, 4)));
  if (kind == "angle") return mesh_text(angle_prism({-0.5, 0.5, 0.5, 0, 0, -0.5}, {-0.5, -0.5, 0, 0, 0.5, 0.5}, -0.5, 0.5));
  // Half a field level, the other half roofs at 45 degrees.
  return height_field_text(2, 9, [](double x, double) { return x <= 0.0 ? 0.0 : 0.25 - std::fabs(x - 0.25 - 0.5 * std::floor(2.0 * x)); });
}

Mat3 any_aligned(Random &random) {
  Mat3 rotation;
  for (const Vec3 &axis : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}}) {
    const int turn = random.integer(0, 2) > 0 ? 2 * random.integer(0, 3) : random.integer(0, 7);
    rotation = product(rotation_about(axis, 0.25 * pi * turn), rotation);
  }
  return rotation;
}

// Along the ground's axes or halfway between two of them; from above a field.
Vec3 any_way(Random &random, bool field) {
  if (field) return {0, 0, 1};
  const int axis = random.integer(0, 2);
  Vec3 way;
  way.set(axis, random.integer(0, 1) == 1 ? 1.0 : -1.0);
  if (random.integer(0, 2) == 0) way.set((axis + 1) % 3, random.integer(0, 1) == 1 ? 1.0 : -1.0);
  return normalized(way);
}

// Middles, sides or ends of the body over lines of the ground, or to the side of these by half a length.
Vec3 any_place(Random &random, const Body &body, const Mat3 &rotation) {
  Vec3 place;
  for (int k = 0; k < 3; ++k) place.set(k, 0.25 * random.integer(-2, 2));
  for (int k = 0; k < 3; ++k) {
    if (random.integer(0, 2) == 0) place = place + (random.integer(0, 1) == 1 ? 0.5 : -0.5) * body.lengths[k] * rotation.column(k);
  }
  if (random.integer(0, 5) == 0) place = place + 0.1 * random.direction();
  return place;
}

double carried(const Contact &contact) {
  double load = 0.0;
  for (const Point &point : contact.points) load += point.weight * point.depth;
  return load;
}

using Kinds = std::tuple<std::string, std::string>;

class AlignedOnMeshes : public testing::TestWithParam<Kinds> {};

// Load and energy are those of poses next to it, so that rounding adds nothing to what shifts change. Where a side of the body lies in the border
// between two wedges the energy has an edge: the load is between those on either side. Where
// several lie so, few of the sides are that of the pose itself, so many are looked at.
void expect_regular(const Kinds &kinds, std::uint64_t seed, int poses) {
  const auto &[body_kind, ground_kind] = kinds;
  const std::string ground = ground_of(ground_kind);
  Random random(seed);
  int touching = 0;
  for (int k = 0; k < poses; ++k) {
    const Body body = any_body(random, body_kind);
    const PairScene scene(body.text, ground);
    // Of blunt cones that are less deep rounding of the pose is what counts (docs/engine/limits.md).
    const double deep = body.least * random.log_uniform(body_kind == "cone" ? 1e-5 : 1e-6, 0.1);
    const Mat3 rotation = any_aligned(random);
    const Vec3 way = any_way(random, ground_kind == "field"), place = any_place(random, body, rotation);
    BodyPose pose{place + (3.0 - dot(place, way)) * way, rotation};
    bool reached = false;
    for (int step = 0; step < 80 && !reached && dot(pose.position, way) > -2.0; ++step) {  // it may pass by
      const double more = scene.query(pose, {}, 64).distance + deep;
      reached = std::fabs(more) < 1e-2 * deep;
      if (!reached) pose.position = pose.position - more * way;
    }
    if (reached) {
      ++touching;
      const Contact contact = scene.query(pose, {}, 64);
      const double load = carried(contact), energy = contact.energy(), size = *std::max_element(body.lengths, body.lengths + 3);
      const auto where = [&] {
        return std::to_string(k) + " " + body.text + " at " + digits(pose.position.x) + "," + digits(pose.position.y) + "," +
               digits(pose.position.z) + ", " + digits(deep) + " deep";
      };
      EXPECT_GT(load, 0.0) << where();
      EXPECT_LT(load, 10.0 * deep) << where();
      for (const Point &point : contact.points) {
        EXPECT_LT(norm(point.position - pose.position), 2.0 * size) << where() << ", " << point.weight * point.depth / load << " of the load";
      }
      constexpr double shift = 1e-10;
      double of_load = HUGE_VAL, of_energy = HUGE_VAL;
      Vec3 least = contact.load(), most = least;
      bool any = false;
      const double tolerance = 1e-4 + 300.0 * shift * size / deep;
      for (int beside = 0; beside < 60 && !(of_load < tolerance && of_energy < tolerance); ++beside) {
        const BodyPose at{pose.position + shift * size * random.direction(), product(rotation_about(random.direction(), shift), rotation)};
        const Contact there = scene.query(at, {}, 64);
        for (int axis = 0; axis < 3; ++axis) {
          least.set(axis, any ? std::min(least[axis], there.load()[axis]) : there.load()[axis]);
          most.set(axis, any ? std::max(most[axis], there.load()[axis]) : there.load()[axis]);
        }
        any = true;
        Vec3 beyond;
        for (int axis = 0; axis < 3; ++axis) {
          beyond.set(axis, std::max({0.0, least[axis] - contact.load()[axis], contact.load()[axis] - most[axis]}));
        }
        of_load = norm(beyond) / load;
        of_energy = std::min(of_energy, std::fabs(there.energy() - energy) / energy);
      }
      EXPECT_LT(of_load, tolerance) << where();
      EXPECT_LT(of_energy, tolerance) << where();
    }
    cmb_release_scene(scene.handle());
  }
  EXPECT_GT(touching, poses / 3);
}

// The axis along an edge, and the cylinder's end in the cube's side but for rounding.
TEST(AlignedOnMeshes, CapsuleWhoseCylinderEndsInASide) {
  const PairScene scene("cmb/1 capsule radius=0.25 length=0.5", ground_of("cube"));
  const Mat3 along_x = {{Vec3{4.3297802811774652e-17, 2.2699482268387765e-16, -1},
                         Vec3{0.70710678118654735, 0.70710678118654768, 1.9112574839269165e-16},
                         Vec3{0.70710678118654768, -0.70710678118654735, -1.2989340843532396e-16}}};
  const auto load = [&](double x) { return carried(scene.query({{x, -0.67677669529663687, -0.67641797450074759}, along_x}, {}, 64)); };
  const double beside = load(-0.25 + 1e-8);
  EXPECT_GT(beside, 1e-5);
  for (const double aside : {-1e-15, -1e-16, 0.0, 1e-16, 1e-15, 1e-13}) EXPECT_NEAR(load(-0.25 + aside), beside, 1e-4 * beside) << aside;
}

TEST_P(AlignedOnMeshes, CarryWhatTheirNeighboursDo) { expect_regular(GetParam(), 1, 60); }

TEST_P(AlignedOnMeshes, CarryWhatTheirNeighboursDoInManyPoses) { expect_regular(GetParam(), 2, 2500); }

const auto name_of = [](const auto &info) { return std::get<0>(info.param) + "On" + std::get<1>(info.param); };

INSTANTIATE_TEST_SUITE_P(All, AlignedOnMeshes,
                         testing::Combine(testing::Values("box", "capsule", "ellipsoid", "cylinder", "cone"),
                                          testing::Values("cube", "divided_cube", "angle", "field")),
                         name_of);

// Not on the field's ridges: what of a slimmer tip is right over one faces neither slope (docs/engine/limits.md).
INSTANTIATE_TEST_SUITE_P(Tips, AlignedOnMeshes,
                         testing::Combine(testing::Values("octahedron"), testing::Values("cube", "divided_cube")), name_of);

}  // namespace
}  // namespace test_aligned_on_meshes
