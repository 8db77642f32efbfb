// The C interface's own promises: whatever must not be NULL is refused by name, so are sizes and handles, and nothing is
// written then; capacities that are too small still tell how much there is.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "c_api/call_guard.hpp"
#include "support/engine_calls.hpp"
#include "contact_multibody_scene.h"
#include "response/pair_law.hpp"
#include "support/rigid_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_interface {
namespace {

using namespace cmb::test;

const double not_a_number = std::numeric_limits<double>::quiet_NaN();

void expect_refused(cmb_status status, const std::string &part, cmb_status expected = CMB_ERROR_ARGUMENT) {
  EXPECT_EQ(status, expected);
  EXPECT_NE(std::string(cmb_last_error()).find(part), std::string::npos) << cmb_last_error();
}

struct PairCall {
  double position[6] = {0, 0, 0.4, 0, 0, 0};
  double rotation[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  double distance = -77, depth = -77, weight = -77, normal[3] = {-77, -77, -77}, point[3] = {-77, -77, -77};

  bool untouched() const {
    return distance == -77 && depth == -77 && weight == -77 && normal[0] == -77 && normal[2] == -77 &&
           point[0] == -77 && point[2] == -77;
  }
  std::array<double *, 5> outputs() { return {&distance, &depth, &weight, normal, point}; }
};

class Interface : public testing::Test {
 protected:
  cmb_scene scene_ = intern({"cmb/1 sphere radius=0.5", "cmb/1 halfspace"}, {1, 2});
  PairCall c_;
};

TEST_F(Interface, EveryOutputHasToBeThere) {
  for (std::size_t missing = 0; missing < 5; ++missing) {
    auto out = c_.outputs();
    out[missing] = nullptr;
    expect_refused(query_scene(scene_, c_.position, c_.rotation, 2, 1, 1, out[0], out[1], out[2], out[3], out[4]),
                   "output array is NULL");
    expect_refused(query_pair(scene_, 1, c_.position, c_.rotation, 2, 1, out[0], out[1], out[2], out[3], out[4]),
                   "output array is NULL");
    EXPECT_TRUE(c_.untouched());
  }
}

TEST_F(Interface, QueriesOfAPairRefuseWhatQueriesOfAllDo) {
  cmb_overlap overlap{};
  overlap.volume = -77;
  cmb_backend backend = CMB_BACKEND_FCL;
  const auto all_refuse = [&](cmb_scene scene, std::size_t pair, const double *position, const double *rotation,
                              std::size_t bodies, const char *says, cmb_status expected = CMB_ERROR_ARGUMENT) {
    const auto out = c_.outputs();
    expect_refused(query_pair(scene, pair, position, rotation, bodies, 1, out[0], out[1], out[2], out[3], out[4]),
                   says, expected);
    expect_refused(query_overlap(scene, pair, position, rotation, bodies, &overlap), says, expected);
    expect_refused(query_backend(scene, pair, position, rotation, bodies, &backend), says, expected);
    EXPECT_TRUE(c_.untouched());
    EXPECT_EQ(overlap.volume, -77);
    EXPECT_EQ(backend, CMB_BACKEND_FCL);
  };
  all_refuse({}, 1, c_.position, c_.rotation, 2, "no scene 0");
  all_refuse(scene_, 2, c_.position, c_.rotation, 2, "no pair 2");
  all_refuse(scene_, 0, c_.position, c_.rotation, 2, "no pair 0");
  all_refuse(scene_, 1, nullptr, c_.rotation, 2, "position or rotation is NULL");
  all_refuse(scene_, 1, c_.position, nullptr, 2, "position or rotation is NULL");
  all_refuse(scene_, 1, c_.position, c_.rotation, 1, "poses of 1 bodies for a scene of 2");
  for (const std::size_t body : {0u, 1u}) {
    PairCall bad;
    bad.position[3 * body + 1] = not_a_number;
    all_refuse(scene_, 1, bad.position, bad.rotation, 2, "not finite", CMB_ERROR_POSE);
  }
  expect_refused(query_overlap(scene_, 1, c_.position, c_.rotation, 2, nullptr), "overlap is NULL");
  expect_refused(query_backend(scene_, 1, c_.position, c_.rotation, 2, nullptr), "backend is NULL");
  const auto out = c_.outputs();
  expect_refused(query_pair(scene_, 1, c_.position, c_.rotation, 2, 0, out[0], out[1], out[2], out[3], out[4]),
                 "point_capacity");
  EXPECT_EQ(query_pair(scene_, 1, c_.position, c_.rotation, 2, 1, out[0], out[1], out[2], out[3], out[4]), CMB_OK);
  EXPECT_NEAR(c_.depth, 0.1, 1e-15);
}

TEST_F(Interface, ScenesWithoutPairsNeedNoArrays) {
  const cmb_scene alone = intern({"cmb/1 sphere radius=0.5"}, {});
  EXPECT_EQ(query_scene(alone, c_.position, c_.rotation, 1, 0, 1, nullptr, nullptr, nullptr, nullptr, nullptr),
            CMB_OK);
  const cmb_scene empty = intern({}, {});
  EXPECT_EQ(query_scene(empty, nullptr, nullptr, 0, 0, 1, nullptr, nullptr, nullptr, nullptr, nullptr), CMB_OK);
}

TEST_F(Interface, CountsOfABackEndNeedSceneAndRoom) {
  unsigned long long answered = 7, refused = 7;
  expect_refused(cmb_backend_counts({}, &answered, &refused), "no scene 0");
  expect_refused(cmb_backend_counts(scene_, nullptr, &refused), "NULL");
  expect_refused(cmb_backend_counts(scene_, &answered, nullptr), "NULL");
  EXPECT_EQ(answered, 7u);
  ASSERT_EQ(cmb_backend_counts(scene_, &answered, &refused), CMB_OK);
  EXPECT_EQ(answered + refused, 0u) << "the engine's own back end is not counted";
}

TEST_F(Interface, BackEndsOutOfRangeAreRefused) {
  const char *geometry[] = {"cmb/1 halfspace"};
  cmb_scene scene{-5};
  for (const int backend : {-1, 5, 1000}) {
    expect_refused(intern_scene(geometry, 1, nullptr, 0, static_cast<cmb_backend>(backend), &scene), "no back end");
  }
  if (intern_scene(geometry, 1, nullptr, 0, CMB_BACKEND_COAL, &scene) != CMB_OK) {
    EXPECT_NE(std::string(cmb_last_error()).find("the module "), std::string::npos);
    EXPECT_NE(std::string(cmb_last_error()).find("choose another back end than coal"), std::string::npos);
    EXPECT_EQ(scene.number, -5);
  }
}

TEST_F(Interface, PairsNameBodiesThatExist) {
  const char *geometry[] = {"cmb/1 halfspace", ""};
  cmb_scene scene{-5};
  for (const auto &[first, second] : {std::pair{0, 1}, {1, 0}, {1, 3}, {-1, 2}}) {
    const int pairs[] = {first, second};
    expect_refused(intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene), "numbered from 1 to 2");
  }
  EXPECT_EQ(scene.number, -5);
}

TEST_F(Interface, ThicknessIsThatOfTheThinnestShapeOfAPair) {
  const cmb_scene scene = intern({"cmb/1 box size=0.6,0.2,0.4;cmb/1 capsule radius=0.05 length=3", "cmb/1 halfspace",
                                  "cmb/1 ellipsoid size=0.8,0.04,0.6", "cmb/1 halfspace",
                                  "cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2,3"},
                                 {1, 2, 1, 3, 2, 4, 2, 5});
  const double expected[] = {0.1, 0.04, CMB_DISTANCE_NONE, CMB_DISTANCE_NONE};
  for (std::size_t pair = 1; pair <= 4; ++pair) {
    double thickness = -77;
    ASSERT_EQ(cmb_pair_thickness(scene, pair, &thickness), CMB_OK) << cmb_last_error();
    EXPECT_NEAR(thickness, expected[pair - 1], 1e-15 * expected[pair - 1]) << pair;
  }
}

TEST_F(Interface, ThicknessNeedsSceneAndPair) {
  double thickness = -77;
  expect_refused(cmb_pair_thickness({999}, 1, &thickness), "no scene 999");
  expect_refused(cmb_pair_thickness(scene_, 0, &thickness), "no pair 0");
  expect_refused(cmb_pair_thickness(scene_, 2, &thickness), "no pair 2");
  expect_refused(cmb_pair_thickness(scene_, 1, nullptr), "thickness is NULL");
  EXPECT_EQ(thickness, -77);
}

TEST_F(Interface, InliningNeedsTextAndRoom) {
  std::size_t length = 99;
  char text[8] = "before";
  expect_refused(cmb_inline_files(nullptr, nullptr, text, 8, &length), "geometry or length is NULL");
  expect_refused(cmb_inline_files("cmb/1 halfspace", nullptr, text, 8, nullptr), "geometry or length is NULL");
  expect_refused(cmb_inline_files("cmb/1 halfspace", nullptr, nullptr, 8, &length), "text is NULL");
  expect_refused(cmb_inline_files("cmb/1 torus", nullptr, text, 8, &length), "column 7", CMB_ERROR_DESCRIPTOR);
  expect_refused(cmb_inline_files("cmb/1 mesh file=a.obj", nullptr, text, 8, &length), "no folder",
                 CMB_ERROR_DESCRIPTOR);
  EXPECT_EQ(length, 99u);
  ASSERT_EQ(cmb_inline_files("cmb/1 halfspace", nullptr, text, 8, &length), CMB_OK);
  EXPECT_EQ(length, 16u);
  EXPECT_STREQ(text, "before") << "too little room: left alone";
  char room[16];
  ASSERT_EQ(cmb_inline_files("cmb/1 halfspace", "", room, 16, &length), CMB_OK);
  EXPECT_STREQ(room, "cmb/1 halfspace");
}

TEST(CallGuard, TurnsEveryExceptionIntoAStatus) {
  const auto run = [](std::function<void()> work) {
    return cmb::guarded([&] {
      work();
      return CMB_OK;
    });
  };
  EXPECT_EQ(run([] {}), CMB_OK);
  expect_refused(run([] { throw cmb::SceneError(CMB_ERROR_POSE, "a pose"); }), "a pose", CMB_ERROR_POSE);
  expect_refused(run([] { throw std::bad_alloc(); }), "out of memory", CMB_ERROR_MEMORY);
  expect_refused(run([] { throw std::runtime_error("a failure"); }), "a failure", CMB_ERROR_INTERNAL);
  expect_refused(run([] { throw 7; }), "unknown failure", CMB_ERROR_INTERNAL);
}

TEST(LastError, IsCutNotOverrun) {
  std::string longer;
  for (int k = 0; k < 1 << 16; ++k) longer += std::to_string(k) + ' ';
  cmb::set_last_error(longer.c_str());
  const std::string kept = cmb_last_error(), gap = " ... ";
  const std::size_t middle = kept.find(gap);
  ASSERT_NE(middle, std::string::npos) << kept;
  const std::string end = kept.substr(middle + gap.size());
  EXPECT_EQ(kept.substr(0, middle), longer.substr(0, middle));
  EXPECT_EQ(end, longer.substr(longer.size() - end.size()));
  EXPECT_GT(middle, 400u);
  EXPECT_GT(end.size(), 400u);
  // Whatever just has room is whole.
  for (const std::size_t length : {std::size_t{0}, kept.size() - 1, kept.size()}) {
    const std::string whole = longer.substr(0, length);
    cmb::set_last_error(whole.c_str());
    EXPECT_EQ(whole, cmb_last_error());
  }
}

// Two balls that touch, above a fixed floor that one of them touches.
struct TwoBalls {
  Bodies bodies;
  Motion motion{3};

  TwoBalls() {
    bodies.add_sphere(0.5, 1.0, 1e4);
    bodies.add_sphere(0.5, 1.0, 1e4);
    bodies.add_fixed("cmb/1 halfspace");
    bodies.intern();
    Motion::set_row(motion.position, 0, {0, 0, 0.49});
    Motion::set_row(motion.position, 1, {0.97, 0, 0.7});
    Motion::set_row(motion.velocity, 0, {0.3, 0, -0.5});
    Motion::set_row(motion.angular_velocity, 0, {0.3, 0.2, -0.5});
  }
};

TEST(SceneInterface, TooLittleRoomStillTellsHowMuchThereIs) {
  const TwoBalls s;
  const double *position = s.motion.position.data(), *rotation = s.motion.rotation.data();
  const cmb_broadphase handle = s.bodies.broadphase;
  std::size_t pairs = 0, contacts = 0;
  ASSERT_EQ(query_candidates(handle, position, rotation, 3, 0, nullptr, &pairs), CMB_OK);
  ASSERT_EQ(query_contacts(handle, position, rotation, 3, 0, nullptr, &contacts), CMB_OK);
  ASSERT_GE(pairs, 2u);
  ASSERT_EQ(contacts, 2u);
  int one[4] = {-7, -7, -7, -7};
  ASSERT_EQ(query_candidates(handle, position, rotation, 3, 1, one, &pairs), CMB_OK);
  EXPECT_EQ(one[0], 1);
  EXPECT_EQ(one[1], 2);
  EXPECT_EQ(one[2], -7);
  cmb_contact found[2];
  found[1].body_a = -7;
  ASSERT_EQ(query_contacts(handle, position, rotation, 3, 1, found, &contacts), CMB_OK);
  EXPECT_EQ(contacts, 2u);
  EXPECT_EQ(found[1].body_a, -7);
  ASSERT_EQ(query_contacts(handle, position, rotation, 3, 2, found, &contacts), CMB_OK);
  EXPECT_NEAR(found[0].depth, 1.0 - std::hypot(0.97, 0.21), 1e-14);
  EXPECT_NEAR(found[1].depth, 0.01, 1e-15);
}

TEST(SceneInterface, NullIsRefused) {
  const TwoBalls s;
  const double *position = s.motion.position.data(), *rotation = s.motion.rotation.data();
  const cmb_broadphase handle = s.bodies.broadphase;
  std::size_t count = 99;
  int pairs[2];
  expect_refused(query_candidates(handle, nullptr, rotation, 3, 1, pairs, &count), "position or rotation is NULL");
  expect_refused(query_candidates(handle, position, nullptr, 3, 1, pairs, &count), "position or rotation is NULL");
  expect_refused(query_candidates(handle, position, rotation, 3, 1, nullptr, &count), "pairs or pair_count");
  expect_refused(query_candidates(handle, position, rotation, 3, 1, pairs, nullptr), "pairs or pair_count");
  expect_refused(query_contacts({}, position, rotation, 3, 0, nullptr, &count), "no broad phase 0");
  expect_refused(query_contacts(handle, position, rotation, 3, 1, nullptr, &count), "contacts or contact_count");
  expect_refused(query_contacts(handle, position, rotation, 3, 0, nullptr, nullptr), "contacts or contact_count");
  EXPECT_EQ(count, 99u);

  const cmb_body_properties properties = s.bodies.properties();
  const cmb_motion motion = s.motion.view();
  std::vector<double> force(9, -77), torque(9, -77);
  const auto evaluate = [&](const cmb_contact_law *law, const cmb_body_properties *of, const cmb_motion *how, double *f,
                            double *t) { return cmb_evaluate_response(handle, law, of, how, f, t, nullptr); };
  const cmb_contact_law *law = &s.bodies.law;
  expect_refused(evaluate(nullptr, &properties, &motion, force.data(), torque.data()), "law, properties or motion");
  expect_refused(evaluate(law, nullptr, &motion, force.data(), torque.data()), "law, properties or motion");
  expect_refused(evaluate(law, &properties, nullptr, force.data(), torque.data()), "law, properties or motion");
  expect_refused(evaluate(law, &properties, &motion, nullptr, torque.data()), "force or torque is NULL");
  expect_refused(evaluate(law, &properties, &motion, force.data(), nullptr), "force or torque is NULL");
  cmb_motion resting = motion;
  resting.velocity = nullptr;
  expect_refused(evaluate(law, &properties, &resting, force.data(), torque.data()), "velocity");
  resting = motion;
  resting.angular_velocity = nullptr;
  expect_refused(evaluate(law, &properties, &resting, force.data(), torque.data()), "velocity");
  for (std::size_t axis = 0; axis < 3; ++axis) {
    Motion wild = s.motion;
    wild.angular_velocity[3 + axis] = not_a_number;
    const cmb_motion view = wild.view();
    expect_refused(evaluate(law, &properties, &view, force.data(), torque.data()), "body 2 has a velocity",
                   CMB_ERROR_POSE);
  }
  EXPECT_EQ(force[0], -77);
  EXPECT_EQ(torque[8], -77);
}

TEST(SceneInterface, FilterArraysMayBeLeftOut) {
  const cmb_scene scene = intern({"cmb/1 sphere radius=0.5", "cmb/1 sphere radius=0.5"}, {});
  const double position[] = {0, 0, 0, 0.9, 0, 0};
  const double rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  const int first[] = {1, 2}, second[] = {2, 1}, none[] = {0, 0}, both_fixed[] = {1, 1};
  const auto touching = [&](const cmb_collision_filter &filter) {
    cmb_broadphase handle{};
    EXPECT_EQ(cmb_intern_broadphase(scene, &filter, &handle), CMB_OK);
    std::size_t count = 99;
    EXPECT_EQ(query_contacts(handle, position, rotation, 2, 0, nullptr, &count), CMB_OK);
    return count;
  };
  EXPECT_EQ(touching({2, nullptr, nullptr, nullptr, nullptr, 0}), 1u);
  EXPECT_EQ(touching({2, both_fixed, nullptr, nullptr, nullptr, 0}), 0u);
  EXPECT_EQ(touching({2, nullptr, first, second, nullptr, 0}), 1u);
  EXPECT_EQ(touching({2, nullptr, first, first, nullptr, 0}), 0u);
  EXPECT_EQ(touching({2, nullptr, nullptr, none, nullptr, 0}), 0u);
  EXPECT_EQ(touching({2, nullptr, nullptr, nullptr, first, 1}), 0u);
}

// What check_law and check_body refuse, each with one thing changed in a scene that is right.
struct LawChange {
  const char *says;
  std::function<void(cmb_contact_law &, cmb_body_properties &)> change;
};

TEST(Law, EveryWrongNumberIsNamed) {
  const TwoBalls s;
  const double bad_positive[] = {1.0, -1.0, 1.0}, bad_nan[] = {not_a_number, 0.2, 0.2};
  const double modulus[] = {1e9, 1e9, 1e9}, curvature[] = {2, 2, 0}, negative_curvature[] = {-1, 2, 0};
  const double singular[27] = {1, 1, 0, 1, 1, 0, 0, 0, 1};
  const auto by_hertz = [&](cmb_contact_law &law, cmb_body_properties &p, const double *e, const double *k) {
    law.exponent = 1.5;
    p.stiffness = nullptr;
    p.modulus = e;
    p.curvature = k;
  };
  using L = cmb_contact_law;
  using P = cmb_body_properties;
  const LawChange changes[] = {
      {"normal_law", [](L &l, P &) { l.normal_law = static_cast<cmb_normal_law>(0); }},
      {"exponent", [](L &l, P &) { l.exponent = HUGE_VAL; }},
      {"steady_rate", [](L &l, P &) { l.steady_rate = -1; }},
      {"steady_rate", [](L &l, P &) { l.steady_rate = HUGE_VAL; }},
      {"damping is negative", [](L &l, P &) { l.damping = -1; }},
      {"damping_depth", [](L &l, P &) { l.damping_depth = 0; }},
      {"combination rule", [](L &l, P &) { l.restitution_rule = static_cast<cmb_combination_rule>(7); }},
      {"stribeck_speed", [](L &l, P &) { l.stribeck_speed = -1; }},
      {"spin_radius", [](L &l, P &) { l.spin_radius = not_a_number; }},
      {"rolling_lever", [](L &l, P &) { l.rolling_lever = -1; }},
      {"turning_regularisation_speed", [](L &l, P &) { l.turning_regularisation_speed = 0; }},
      {"neither stiffness nor", [](L &, P &p) { p.stiffness = nullptr; }},
      {"neither stiffness nor", [&](L &l, P &p) { by_hertz(l, p, modulus, nullptr); }},
      {"exponent 1.5 only", [&](L &l, P &p) { by_hertz(l, p, modulus, curvature), l.exponent = 1; }},
      {"body 2: the modulus", [&](L &l, P &p) { by_hertz(l, p, bad_positive, curvature); }},
      {"body 1: the curvature", [&](L &l, P &p) { by_hertz(l, p, modulus, negative_curvature); }},
      {"mass, center_of_mass or inertia", [](L &, P &p) { p.mass = nullptr; }},
      {"mass, center_of_mass or inertia", [](L &, P &p) { p.center_of_mass = nullptr; }},
      {"mass, center_of_mass or inertia", [](L &, P &p) { p.inertia = nullptr; }},
      {"restitution is NULL", [](L &, P &p) { p.restitution = nullptr; }},
      {"body 2: the restitution", [&](L &, P &p) { p.restitution = bad_positive; }},
      {"body 1: the inertia", [&](L &, P &p) { p.inertia = singular; }},
      {"mu_dynamic is NULL", [](L &, P &p) { p.mu_dynamic = nullptr; }},
      {"mu_static is NULL", [](L &l, P &p) { l.stribeck_speed = 1, p.mu_static = nullptr; }},
      {"body 1: mu_static", [&](L &l, P &p) { l.stribeck_speed = 1, p.mu_static = bad_nan; }},
  };
  double force[9] = {-77}, torque[9] = {-77};
  for (const LawChange &wrong : changes) {
    cmb_contact_law law = s.bodies.law;
    cmb_body_properties properties = s.bodies.properties();
    wrong.change(law, properties);
    const cmb_motion motion = s.motion.view();
    expect_refused(cmb_evaluate_response(s.bodies.broadphase, &law, &properties, &motion, force, torque, nullptr),
                   wrong.says);
    EXPECT_EQ(force[0], -77) << wrong.says;
  }
}

TEST(Law, WhatIsNotUsedMayBeLeftOut) {
  const TwoBalls s;
  cmb_contact_law law = s.bodies.law;
  law.use_restitution = law.use_friction = 0;
  cmb_body_properties properties = s.bodies.properties();
  properties.mass = properties.center_of_mass = properties.inertia = nullptr;
  properties.restitution = properties.mu_static = properties.mu_dynamic = nullptr;
  double force[9], torque[9];
  const cmb_motion motion = s.motion.view();
  ASSERT_EQ(cmb_evaluate_response(s.bodies.broadphase, &law, &properties, &motion, force, torque, nullptr), CMB_OK)
      << cmb_last_error();
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(force[axis] + force[3 + axis] + force[6 + axis], 0.0, 1e-11);
  }
}

TEST(Law, RulesCombineAsTheyAreNamed) {
  using cmb::combine;
  const double a = 0.2, b = 0.8;
  EXPECT_EQ(combine(a, b, CMB_COMBINE_MINIMUM), 0.2);
  EXPECT_EQ(combine(a, b, CMB_COMBINE_MAXIMUM), 0.8);
  EXPECT_DOUBLE_EQ(combine(a, b, CMB_COMBINE_ARITHMETIC_MEAN), 0.5);
  EXPECT_DOUBLE_EQ(combine(a, b, CMB_COMBINE_GEOMETRIC_MEAN), 0.4);
  EXPECT_DOUBLE_EQ(combine(a, b, CMB_COMBINE_HARMONIC_MEAN), 0.32);
  EXPECT_DOUBLE_EQ(combine(a, b, CMB_COMBINE_PRODUCT), 0.16);
  EXPECT_EQ(combine(0.0, 0.0, CMB_COMBINE_HARMONIC_MEAN), 0.0) << "no division by 0";
}

}  // namespace
}  // namespace test_interface
