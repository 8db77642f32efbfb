// Full registries: refused with a reason, and what is interned already still answers. A program of its own, because
// nothing can be interned in this process afterwards.
#include <gtest/gtest.h>

#include <string>

#include "contact_multibody_scene.h"

namespace {

TEST(Registry, FullOnesRefuseAndStillAnswer) {
  const char *sphere[] = {"cmb/1 sphere radius=1"};
  cmb_scene first = 0;
  ASSERT_EQ(cmb_intern(sphere, 1, nullptr, 0, CMB_BACKEND_AUTO, &first), CMB_OK);
  // Filters first: they need a scene.
  cmb_broadphase filter_handle = 0, last_filter = 0;
  cmb_status status = CMB_OK;
  int filters = 0;
  for (; status == CMB_OK && filters < 100000; ++filters) {
    last_filter = filter_handle;
    const cmb_collision_filter filter{nullptr, &filters, nullptr, nullptr, 0};
    status = cmb_intern_broadphase(first, 1, &filter, &filter_handle);
  }
  EXPECT_EQ(status, CMB_ERROR_MEMORY);
  EXPECT_NE(std::string(cmb_last_error()).find("filters already"), std::string::npos);
  EXPECT_EQ(last_filter, filter_handle) << "the handle changed in the call that failed";

  cmb_scene scene = 0;
  int scenes = 0;
  for (status = CMB_OK; status == CMB_OK && scenes < 1000000; ++scenes) {
    const std::string text = "cmb/1 halfspace position=0,0," + std::to_string(scenes);
    const char *geometry[] = {text.c_str()};
    status = cmb_intern(geometry, 1, nullptr, 0, CMB_BACKEND_AUTO, &scene);
  }
  EXPECT_EQ(status, CMB_ERROR_MEMORY);
  EXPECT_NE(std::string(cmb_last_error()).find("scenes already"), std::string::npos);
  cmb_scene again = 0;
  EXPECT_EQ(cmb_intern(sphere, 1, nullptr, 0, CMB_BACKEND_AUTO, &again), CMB_OK);
  EXPECT_EQ(again, first);
}

}  // namespace
