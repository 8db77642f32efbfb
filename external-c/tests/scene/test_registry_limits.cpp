// Full registries: refused with a reason, and what is interned already still answers. A program of its own, because
// nothing can be interned in this process afterwards.
#include <gtest/gtest.h>

#include <string>

#include "contact_multibody_scene.h"
#include "support/engine_calls.hpp"

namespace {

TEST(Registry, FullOnesRefuseAndStillAnswer) {
  const char *sphere[] = {"cmb/1 sphere radius=1"};
  cmb_scene first{};
  ASSERT_EQ(cmb::test::intern_scene(sphere, 1, nullptr, 0, CMB_BACKEND_AUTO, &first), CMB_OK);
  // Filters first: they need a scene.
  cmb_broadphase filter_handle{}, last_filter{};
  cmb_status status = CMB_OK;
  int filters = 0;
  for (; status == CMB_OK && filters < 100000; ++filters) {
    last_filter = filter_handle;
    const cmb_collision_filter filter{1, nullptr, &filters, nullptr, nullptr, 0};
    status = cmb_intern_broadphase(first, &filter, &filter_handle);
  }
  EXPECT_EQ(status, CMB_ERROR_MEMORY);
  EXPECT_NE(std::string(cmb_last_error()).find("filters already"), std::string::npos);
  EXPECT_EQ(last_filter, filter_handle) << "the handle changed in the call that failed";

  cmb_scene scene{};
  int scenes = 0;
  for (status = CMB_OK; status == CMB_OK && scenes < 1000000; ++scenes) {
    const std::string text = "cmb/1 halfspace position=0,0," + std::to_string(scenes);
    const char *geometry[] = {text.c_str()};
    status = cmb::test::intern_scene(geometry, 1, nullptr, 0, CMB_BACKEND_AUTO, &scene);
  }
  EXPECT_EQ(status, CMB_ERROR_MEMORY);
  EXPECT_NE(std::string(cmb_last_error()).find("scenes already"), std::string::npos);
  ASSERT_EQ(cmb_release_scene(scene), CMB_OK);
  const char *another[] = {"cmb/1 sphere radius=2"};
  EXPECT_EQ(cmb::test::intern_scene(another, 1, nullptr, 0, CMB_BACKEND_AUTO, &scene), CMB_OK) << "what was released makes room";
  cmb_scene again{};
  EXPECT_EQ(cmb::test::intern_scene(sphere, 1, nullptr, 0, CMB_BACKEND_AUTO, &again), CMB_OK);
  EXPECT_EQ(again, first);
}

}  // namespace
