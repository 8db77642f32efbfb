// What scenes keep of their descriptors.
#include <gtest/gtest.h>

#include "scene/registry.hpp"
#include "support/engine_calls.hpp"
#include "support/scene_query.hpp"

namespace test_registry {
namespace {

using namespace cmb;

const char *const hull = "cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,0,0,1";

TEST(Registry, BodiesOfOneDescriptorShareTheirGeometry) {
  const std::string lifted = std::string(hull) + " position=0,0,1";
  const Scene *const scene = find_scene(test::intern({hull, "cmb/1 sphere radius=1", hull, lifted}, {1, 3}));
  ASSERT_NE(scene, nullptr);
  ASSERT_EQ(scene->bodies.size(), 4u);
  EXPECT_EQ(scene->bodies[0][0].polytope, scene->bodies[2][0].polytope);
  EXPECT_EQ(scene->bodies[2][0].body.polytope, &scene->bodies[0][0].polytope->geometry());
  EXPECT_NE(scene->bodies[0][0].polytope, scene->bodies[3][0].polytope);
  EXPECT_EQ(scene->bodies[1][0].kind, ShapeKind::sphere);
}

TEST(Registry, ScenesShareGeometryWhileOneHasIt) {
  const std::string only_here = std::string(hull) + " position=0,0,7";
  const cmb_scene one = test::intern({only_here, "cmb/1 halfspace"}, {1, 2});
  const cmb_scene two = test::intern({"cmb/1 sphere radius=1", only_here}, {1, 2});
  const std::weak_ptr<const ContactPolytope> shared = find_scene(one)->bodies[0][0].polytope;
  EXPECT_EQ(find_scene(two)->bodies[1][0].polytope, shared.lock());
  EXPECT_EQ(cmb_release_scene(one), CMB_OK);
  EXPECT_FALSE(shared.expired());
  EXPECT_EQ(cmb_release_scene(two), CMB_OK);
  EXPECT_TRUE(shared.expired());
}

TEST(Registry, SceneLivesUntilItIsReleasedAsOftenAsInterned) {
  const std::vector<std::string> geometry = {"cmb/1 sphere radius=0.625"};
  const cmb_scene first = test::intern(geometry, {}), second = test::intern(geometry, {});
  ASSERT_EQ(first, second);
  EXPECT_EQ(cmb_release_scene(first), CMB_OK);
  EXPECT_NE(find_scene(first), nullptr);
  EXPECT_EQ(cmb_release_scene(first), CMB_OK);
  EXPECT_EQ(find_scene(first), nullptr);
  EXPECT_EQ(cmb_release_scene(first), CMB_ERROR_ARGUMENT);
  EXPECT_NE(std::string(cmb_last_error()).find("no scene"), std::string::npos) << cmb_last_error();
  // Neither the same scene again nor another one in its place answers to the old handle.
  const cmb_scene again = test::intern(geometry, {}), other = test::intern({"cmb/1 sphere radius=0.626"}, {});
  EXPECT_NE(again, first);
  EXPECT_NE(other, first);
  EXPECT_EQ(find_scene(first), nullptr);
}

TEST(Registry, ScenesWithoutEndNeedNoMoreMemoryWhenReleased) {
  cmb_scene scene{};
  for (int k = 0; k < 3 * CMB_SCENE_LIMIT; ++k) {
    const std::string text = "cmb/1 halfspace position=0,0," + std::to_string(k);
    const char *const geometry[] = {text.c_str()};
    ASSERT_EQ(test::intern_scene(geometry, 1, nullptr, 0, CMB_BACKEND_AUTO, &scene), CMB_OK) << cmb_last_error();
    ASSERT_EQ(cmb_release_scene(scene), CMB_OK);
  }
}

TEST(Registry, BroadPhasesKeepTheirScene) {
  const cmb_scene scene = test::intern({"cmb/1 sphere radius=0.5", "cmb/1 sphere radius=0.75"}, {});
  cmb_broadphase broadphase{};
  ASSERT_EQ(cmb_intern_broadphase(scene, nullptr, &broadphase), CMB_OK);
  ASSERT_EQ(cmb_release_scene(scene), CMB_OK);
  const double position[] = {0, 0, 0, 1.2, 0, 0}, rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  std::size_t count = 0;
  ASSERT_EQ(test::query_contacts(broadphase, position, rotation, 2, 0, nullptr, &count), CMB_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(cmb_release_broadphase(broadphase), CMB_OK);
  EXPECT_EQ(test::query_contacts(broadphase, position, rotation, 2, 0, nullptr, &count), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb_release_broadphase(broadphase), CMB_ERROR_ARGUMENT);
}

TEST(Registry, ErrorsNameTheFirstOfEqualDescriptors) {
  const char *const geometry[] = {"cmb/1 sphere radius=1", "cmb/1 sphere radius=-1", "cmb/1 sphere radius=-1"};
  cmb_scene scene{};
  EXPECT_EQ(test::intern_scene(geometry, 3, nullptr, 0, CMB_BACKEND_AUTO, &scene), CMB_ERROR_DESCRIPTOR);
  EXPECT_NE(std::string(cmb_last_error()).find("descriptor 2"), std::string::npos) << cmb_last_error();
}

}  // namespace
}  // namespace test_registry
