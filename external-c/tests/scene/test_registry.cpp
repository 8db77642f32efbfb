// What scenes keep of their descriptors.
#include <gtest/gtest.h>

#include "scene/registry.hpp"
#include "support/scene_query.hpp"

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

TEST(Registry, ErrorsNameTheFirstOfEqualDescriptors) {
  const char *const geometry[] = {"cmb/1 sphere radius=1", "cmb/1 sphere radius=-1", "cmb/1 sphere radius=-1"};
  cmb_scene scene = 0;
  EXPECT_EQ(cmb_intern(geometry, 3, nullptr, 0, CMB_BACKEND_AUTO, &scene), CMB_ERROR_DESCRIPTOR);
  EXPECT_NE(std::string(cmb_last_error()).find("descriptor 2"), std::string::npos) << cmb_last_error();
}

}  // namespace
