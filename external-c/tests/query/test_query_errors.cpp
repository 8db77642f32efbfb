// What a query refuses, and that nothing is written then.
#include <limits>

#include "support/engine_calls.hpp"
#include "support/scene_query.hpp"

namespace test_query_errors {
namespace {

using namespace cmb::test;

struct Call {
  double position[6] = {0, 0, 0.4, 0, 0, 0};
  double rotation[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  double distance = -77, depth = -77, weight = -77, normal[3] = {-77, -77, -77}, point[3] = {-77, -77, -77};
  std::size_t bodies = 2, pairs = 1, capacity = 1;

  cmb_status operator()(cmb_scene scene) {
    return query_scene(scene, position, rotation, bodies, pairs, capacity, &distance, &depth, &weight, normal,
                           point);
  }
};

class Query : public testing::Test {
 protected:
  cmb_scene scene_ = intern({"cmb/1 sphere radius=0.5", "cmb/1 halfspace"}, {1, 2});
  Call call_;
};

TEST_F(Query, GoesWell) {
  ASSERT_EQ(call_(scene_), CMB_OK);
  EXPECT_NEAR(call_.depth, 0.1, 1e-15);
}

TEST_F(Query, RefusesUnknownScenes) {
  for (const int number : {0, -1, 65536, 65537, 60000}) {
    EXPECT_EQ(call_({number}), CMB_ERROR_ARGUMENT);
    EXPECT_NE(std::string(cmb_last_error()).find("no scene"), std::string::npos);
  }
  EXPECT_EQ(call_.distance, -77);
}

TEST_F(Query, RefusesWrongSizes) {
  call_.bodies = 3;
  EXPECT_EQ(call_(scene_), CMB_ERROR_ARGUMENT);
  call_.bodies = 2;
  call_.pairs = 2;
  EXPECT_EQ(call_(scene_), CMB_ERROR_ARGUMENT);
  call_.pairs = 1;
  call_.capacity = 0;
  EXPECT_EQ(call_(scene_), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(call_.distance, -77);
}

TEST_F(Query, RefusesNullArrays) {
  Call &c = call_;
  EXPECT_EQ(query_scene(scene_, nullptr, c.rotation, 2, 1, 1, &c.distance, &c.depth, &c.weight, c.normal, c.point),
            CMB_ERROR_ARGUMENT);
  EXPECT_EQ(query_scene(scene_, c.position, c.rotation, 2, 1, 1, nullptr, &c.depth, &c.weight, c.normal, c.point),
            CMB_ERROR_ARGUMENT);
  EXPECT_EQ(query_pair(scene_, 1, c.position, c.rotation, 2, 1, &c.distance, nullptr, &c.weight, c.normal, c.point),
            CMB_ERROR_ARGUMENT);
  EXPECT_EQ(query_pair(scene_, 2, c.position, c.rotation, 2, 1, &c.distance, &c.depth, &c.weight, c.normal, c.point),
            CMB_ERROR_ARGUMENT);
  EXPECT_EQ(query_backend(scene_, 1, c.position, c.rotation, 2, nullptr), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb_backend_counts(scene_, nullptr, nullptr), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(c.distance, -77);
}

TEST_F(Query, RefusesPosesThatAreNone) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf, 1e300}) {
    for (int i = 0; i < 6; ++i) {
      Call call;
      call.position[i] = bad;
      EXPECT_EQ(call(scene_), CMB_ERROR_POSE);
      EXPECT_NE(std::string(cmb_last_error()).find(i < 3 ? "body 1" : "body 2"), std::string::npos);
      EXPECT_EQ(call.distance, -77);
    }
    for (int i = 0; i < 18; ++i) {
      Call call;
      call.rotation[i] = bad;
      EXPECT_EQ(call(scene_), CMB_ERROR_POSE);
    }
  }
  Call reflected;
  reflected.rotation[0] = -1;
  EXPECT_EQ(reflected(scene_), CMB_ERROR_POSE);
}

TEST_F(Query, TakesRotationsThatDriftedALittle) {
  Call drifted;
  for (double &r : drifted.rotation) r *= 1.0 + 1e-4;
  ASSERT_EQ(drifted(scene_), CMB_OK);
  EXPECT_NEAR(drifted.depth, 0.1, 1e-15);
}

TEST(Status, EveryStatusHasAText) {
  for (int status = CMB_OK; status <= CMB_ERROR_INTERNAL; ++status) {
    EXPECT_STRNE(cmb_status_text(static_cast<cmb_status>(status)), "unknown status");
  }
  EXPECT_STREQ(cmb_status_text(static_cast<cmb_status>(99)), "unknown status");
  EXPECT_NE(std::string(cmb_version()).find('.'), std::string::npos);
}

}  // namespace
}  // namespace test_query_errors
