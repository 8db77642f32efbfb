// What Modelica's external functions get: the engine's numbers to the bit, the volume law's points with the volume's
// moments, and errors through ModelicaFormatError.
#include <gtest/gtest.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <string>
#include <vector>

#include "contact_multibody_modelica.h"
#include "contact_multibody_scene_modelica.h"
#include "support/engine_calls.hpp"
#include "support/modelica_format_error.hpp"
#include "support/rigid_bodies.hpp"

namespace test_modelica_adapter {
namespace {

using namespace cmb::test;

const double upright[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};

struct VolumePoints {
  double distance = 0.0, depth[4], weight[4], normal[12], point[12];

  VolumePoints(const char *a, const char *b, const Vec3 &position_a, const double *rotation = upright) {
    const char *geometry[] = {a, b};
    const int pairs[] = {1, 2};
    const int scene = cmb_modelica_intern(geometry, 2, pairs, 1, 0);
    const double position[] = {position_a.x, position_a.y, position_a.z, 0, 0, 0};
    cmb_modelica_query_volume_within(scene, HUGE_VAL, position, 2, rotation, 1, &distance, depth, weight, normal, point);
  }
  double volume() const {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += weight[k] * depth[k];
    return sum;
  }
  double mean(int axis) const {
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += 0.25 * point[3 * k + axis];
    return sum;
  }
  double second_moment(int i, int j) const {  // about the mean
    double sum = 0.0;
    for (int k = 0; k < 4; ++k) sum += 0.25 * (point[3 * k + i] - mean(i)) * (point[3 * k + j] - mean(j));
    return sum;
  }
};

TEST(VolumeLaw, BoxOnHalfspaceHasTheVolumesMoments) {
  const double d = 0.02;
  const VolumePoints box("cmb/1 box size=2,1,0.5", "cmb/1 halfspace", {0.3, -0.2, 0.25 - d});
  EXPECT_NEAR(box.volume(), 2 * 1 * d, 1e-14);
  EXPECT_NEAR(box.mean(0), 0.3, 1e-13);
  EXPECT_NEAR(box.mean(1), -0.2, 1e-13);
  EXPECT_NEAR(box.mean(2), -0.5 * d, 1e-13);
  EXPECT_NEAR(box.second_moment(0, 0), 4.0 / 12, 1e-12);
  EXPECT_NEAR(box.second_moment(1, 1), 1.0 / 12, 1e-12);
  EXPECT_NEAR(box.second_moment(0, 1), 0.0, 1e-12);
  double energy = 0.0;
  for (int k = 0; k < 4; ++k) {
    energy += 0.5 * box.weight[k] * box.depth[k] * box.depth[k];
    EXPECT_NEAR(box.normal[3 * k + 2], 1.0, 1e-14);
  }
  EXPECT_NEAR(energy, 0.5 * 2 * 1 * d * d, 1e-14) << "half the squared depth over the area";
}

TEST(VolumeLaw, FollowsTheNormalIntoEveryAxis) {
  // The floor stands as a wall: its normal points along the first, the second axis.
  const double along_x[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 0, 0, 0, 1, 1, 0, 0};
  const double along_y[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 0, 1, 0};
  for (const double *rotation : {along_x, along_y}) {
    const int axis = rotation == along_x ? 0 : 1;
    Vec3 position;
    position.set(axis, 0.49);
    const VolumePoints cube("cmb/1 box size=1,1,1", "cmb/1 halfspace", position, rotation);
    EXPECT_NEAR(cube.volume(), 0.01, 1e-14);
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(cube.mean(i), i == axis ? -0.005 : 0.0, 1e-13);
      EXPECT_NEAR(cube.second_moment(i, i), i == axis ? 0.0 : 1.0 / 12, 1e-12);
    }
  }
}

TEST(VolumeLaw, HoldsForWallsAtAnySlant) {
  // Whatever axes the points are placed along: the cap's volume, its disc's second moment across the normal, none along it.
  const double r = 0.5, d = 0.1, pi = 3.14159265358979323846;
  const double area = pi * d * (2.0 * r - d), volume = pi * d * d * (r - d / 3.0);
  for (const Vec3 &direction : {Vec3{1, 2, 3}, Vec3{3, 1, 2}, Vec3{2, 3, 1}, Vec3{-1, 3, 2}, Vec3{2, -1, 3}, Vec3{3, 2, -1}}) {
    const Vec3 normal = normalized(direction), u = cmb::convex::any_perpendicular(normal), v = cross(normal, u);
    double rotation[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    for (int i = 0; i < 3; ++i) rotation[9 + i] = u[i], rotation[12 + i] = v[i], rotation[15 + i] = normal[i];
    const VolumePoints cap("cmb/1 sphere radius=0.5", "cmb/1 halfspace", (r - d) * normal, rotation);
    EXPECT_NEAR(cap.volume(), volume, 1e-12);
    double along = 0.0, trace = 0.0;
    for (int i = 0; i < 3; ++i) {
      trace += cap.second_moment(i, i);
      for (int j = 0; j < 3; ++j) along += normal[i] * cap.second_moment(i, j) * normal[j];
    }
    EXPECT_NEAR(along, 0.0, 1e-14);
    EXPECT_NEAR(trace, area / (2.0 * pi), 1e-13) << "twice a quarter of the radius squared";
  }
}

TEST(VolumeLaw, SphereHasItsCapsVolume) {
  const double r = 0.5, d = 0.1;
  const VolumePoints cap("cmb/1 sphere radius=0.5", "cmb/1 halfspace", {0, 0, r - d});
  EXPECT_NEAR(cap.volume(), 3.14159265358979323846 * d * d * (r - d / 3), 1e-12);
}

TEST(VolumeLaw, NothingIsPushedWhereBodiesAreApart) {
  const VolumePoints apart("cmb/1 box size=1,1,1", "cmb/1 halfspace", {0, 0, 0.75});
  EXPECT_NEAR(apart.distance, 0.25, 1e-15);
  for (int k = 0; k < 4; ++k) {
    EXPECT_EQ(apart.depth[k], 0.0);
    EXPECT_EQ(apart.weight[k], 0.0);
    for (int axis = 0; axis < 3; ++axis) EXPECT_EQ(apart.point[3 * k + axis], apart.point[axis]);
  }
  // Apart, it does not matter that the overlap would not be known.
  EXPECT_GT(VolumePoints("cmb/1 cone radius=1 length=1", "cmb/1 box size=1,1,1", {0, 0, 9}).distance, 0.0);
}

TEST(VolumeLaw, VolumesTooSmallForANumberPushNothing) {
  const VolumePoints grazing("cmb/1 box size=1e-9,1e-9,1e-9", "cmb/1 halfspace", {0, 0, 0.5e-9 - 1e-300});
  for (int k = 0; k < 4; ++k) EXPECT_TRUE(std::isfinite(grazing.weight[k]) && std::isfinite(grazing.point[3 * k]));
}

TEST(VolumeLaw, HoldsForRoundBodiesOnBoxesAndMeshes) {
  // A standing cylinder, 1 mm deep: volume, the disc's second moment, twice the mean depth.
  const double pi = 3.14159265358979323846;
  for (const char *below : {"cmb/1 box size=1,1,1",
                            "cmb/1 mesh vertices=-1,-1,0.5,1,-1,0.5,0,2,0.5,0,0,-2 triangles=1,2,3,2,1,4,3,2,4,1,3,4"}) {
    const VolumePoints disc("cmb/1 cylinder radius=0.1 length=0.4", below, {0, 0, 0.699});
    EXPECT_NEAR(disc.volume(), pi * 1e-5, 1e-12) << below;
    EXPECT_NEAR(disc.depth[0], 1e-3, 1e-9) << below;
    EXPECT_NEAR(disc.second_moment(0, 0), 0.0025, 1e-9) << below;
    EXPECT_NEAR(disc.second_moment(1, 1), 0.0025, 1e-9) << below;
  }
}

TEST(VolumeLaw, UnknownOverlapsAndBadPosesAreErrors) {
  EXPECT_THROW(VolumePoints("cmb/1 sphere radius=0.1",
                            "cmb/1 heightfield size=1,1 grid=2,2 heights=0,0,0,0", {0.1, 0.2, 0.05}), ModelicaError);
  const double reflected[] = {-1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  EXPECT_THROW(VolumePoints("cmb/1 sphere radius=1", "cmb/1 halfspace", {}, reflected), ModelicaError);
}

enum class Law { points, volume };

// A cube on a cube, and one across from both.
struct ThreeCubes {
  double distance[3], depth[12], weight[12], normal[36], point[36];

  ThreeCubes(Law law, double exact_within) {
    const char *geometry[] = {"cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1", "cmb/1 box size=1,1,1"};
    const int pairs[] = {1, 2, 1, 3, 2, 3};
    const int scene = cmb_modelica_intern(geometry, 3, pairs, 3, 0);
    const double position[] = {0, 0, 0.99, 0, 0, 0, 2.1, 2.1, 0};
    const double rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
    if (law == Law::volume) {
      cmb_modelica_query_volume_within(scene, exact_within, position, 3, rotation, 3, distance, depth, weight, normal, point);
    } else {
      cmb_modelica_query_within(scene, exact_within, position, 3, rotation, 3, 4, distance, depth, weight, normal, point);
    }
  }
};

class QueryWithin : public testing::TestWithParam<Law> {};

TEST_P(QueryWithin, GivesBoundsFarApartAndTheSameContacts) {
  const ThreeCubes exact(GetParam(), HUGE_VAL), bounds(GetParam(), 0.1);
  EXPECT_NEAR(exact.distance[2], 1.1 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(bounds.distance[2], 2.1 * std::sqrt(2.0) - std::sqrt(3.0), 1e-12) << "the gap of the cubes' bounding spheres";
  EXPECT_LT(bounds.distance[1], exact.distance[1]);
  EXPECT_NEAR(exact.distance[0], -0.01, 1e-12);
  EXPECT_EQ(bounds.distance[0], exact.distance[0]);
  EXPECT_GT(bounds.depth[0] * bounds.weight[0], 0.0);
  EXPECT_TRUE(std::equal(exact.depth, exact.depth + 12, bounds.depth));
  EXPECT_TRUE(std::equal(exact.weight, exact.weight + 12, bounds.weight));
  EXPECT_TRUE(std::equal(exact.normal, exact.normal + 12, bounds.normal));  // of the cubes that touch
  EXPECT_TRUE(std::equal(exact.point, exact.point + 12, bounds.point));
}

TEST_P(QueryWithin, ModelicasInfinityMeansExact) {
  const ThreeCubes exact(GetParam(), HUGE_VAL);
  for (const double infinity : {DBL_MAX, 1e60}) {  // of the Standard Library on various tools
    const ThreeCubes same(GetParam(), infinity);
    EXPECT_TRUE(std::equal(exact.distance, exact.distance + 3, same.distance)) << infinity;
    EXPECT_TRUE(std::equal(exact.normal, exact.normal + 36, same.normal)) << infinity;
    EXPECT_TRUE(std::equal(exact.point, exact.point + 36, same.point)) << infinity;
  }
}

TEST_P(QueryWithin, NeedsAPositiveLength) { EXPECT_THROW(ThreeCubes(GetParam(), -0.1), ModelicaError); }

INSTANTIATE_TEST_SUITE_P(Laws, QueryWithin, testing::Values(Law::points, Law::volume), [](const auto &info) {
  return std::string(info.param == Law::points ? "Points" : "Volume");
});

class Response : public testing::Test {
 protected:
  Response() {
    bodies_.add_sphere(0.5, 2.0, 1e4, 0.6, 0.2);
    bodies_.add("cmb/1 halfspace", 0.0, {}, 1e9);
    const char *geometry[] = {bodies_.geometry[0].c_str(), bodies_.geometry[1].c_str()};
    scene_ = cmb_modelica_intern(geometry, 2, nullptr, 0, 0);
    handle_ = cmb_modelica_intern_broadphase(scene_, bodies_.fixed.data(), 2, group_, mask_, nullptr, 0);
    Motion::set_row(motion_.position, 0, {0, 0, 0.48});
    Motion::set_row(motion_.velocity, 0, {0.3, 0, -0.5});
    Motion::set_row(motion_.angular_velocity, 0, {0.1, 0.2, 0.4});
  }
  void call(const int *choice, const double *number) {
    cmb_modelica_response(handle_, motion_.position.data(), 2, motion_.rotation.data(), motion_.velocity.data(),
                          motion_.angular_velocity.data(), bodies_.mass.data(), bodies_.center_of_mass.data(),
                          bodies_.inertia.data(), bodies_.stiffness.data(), modulus_, curvature_,
                          bodies_.restitution.data(), bodies_.mu_static.data(), bodies_.mu_dynamic.data(), choice,
                          number, force_, torque_, &energy_, &count_, &depth_, &relative_depth_);
  }

  const int group_[2] = {1, 1}, mask_[2] = {1, 1};
  const double modulus_[2] = {1e6, 1e9}, curvature_[2] = {2.0, 0.0};
  Bodies bodies_;
  Motion motion_{2};
  int scene_ = 0, handle_ = 0;
  double force_[6] = {}, torque_[6] = {}, energy_ = 0, count_ = 0, depth_ = 0, relative_depth_ = 0;
};

TEST_F(Response, IsTheEnginesToTheBit) {
  const int choice[] = {CMB_LAW_FLORES, 1, 0, CMB_COMBINE_PRODUCT, 1, CMB_COMBINE_MAXIMUM};
  const double number[] = {1.25, 0.4, 900, 2e-4, 2e-3, 0.05, 1e-3, 2e-3, 2e-2};
  call(choice, number);
  cmb_contact_law law{};
  law.normal_law = CMB_LAW_FLORES;
  law.use_restitution = law.use_friction = 1;
  law.restitution_rule = CMB_COMBINE_PRODUCT;
  law.friction_rule = CMB_COMBINE_MAXIMUM;
  law.exponent = 1.25;
  law.steady_rate = 0.4;
  law.damping = 900;
  law.damping_depth = 2e-4;
  law.regularisation_speed = 2e-3;
  law.stribeck_speed = 0.05;
  law.spin_radius = 1e-3;
  law.rolling_lever = 2e-3;
  law.turning_regularisation_speed = 2e-2;
  const cmb_body_properties properties = bodies_.properties();
  const cmb_motion motion = motion_.view();
  double force[6], torque[6];
  cmb_response_sums sums{};
  ASSERT_EQ(cmb_evaluate_response({handle_}, &law, &properties, &motion, force, torque, &sums), CMB_OK);
  EXPECT_GT(force[2], 0.0);
  for (int i = 0; i < 6; ++i) {
    EXPECT_EQ(force_[i], force[i]);
    EXPECT_EQ(torque_[i], torque[i]);
  }
  EXPECT_EQ(energy_, sums.elastic_energy);
  EXPECT_EQ(count_, 1.0);
  EXPECT_NEAR(depth_, 0.02, 1e-15);
  EXPECT_NEAR(relative_depth_, 0.02 / 1.0, 1e-15);
}

TEST_F(Response, HertzTakesModulusAndCurvature) {
  const int choice[] = {CMB_LAW_EXACT, 0, 1, CMB_COMBINE_MINIMUM, 0, CMB_COMBINE_MINIMUM};
  const double number[] = {1.5, 0, 0, 1e-4, 1e-3, 0, 0, 0, 1e-2};
  call(choice, number);
  const double modulus = 1 / (1 / 1e6 + 1 / 1e9);
  EXPECT_NEAR(force_[2], 4.0 / 3 * modulus * std::sqrt(0.5) * std::pow(0.02, 1.5), 1e-9);
}

TEST_F(Response, ErrorsGoToModelicaFormatError) {
  const int choice[] = {99, 0, 0, CMB_COMBINE_MINIMUM, 0, CMB_COMBINE_MINIMUM};
  const double number[] = {1, 0, 0, 1e-4, 1e-3, 0, 0, 0, 1e-2};
  try {
    call(choice, number);
    FAIL() << "accepted";
  } catch (const ModelicaError &error) {
    EXPECT_NE(std::string(error.what()).find("normal_law is unknown"), std::string::npos) << error.what();
  }
  EXPECT_THROW(cmb_modelica_intern_broadphase(scene_, bodies_.fixed.data(), 3, group_, mask_, nullptr, 0),
               ModelicaError);
}

}  // namespace
}  // namespace test_modelica_adapter
