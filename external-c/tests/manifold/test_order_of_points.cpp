// The k-th contact point is a smooth function of the pose: who differentiates the list of points, as integrators do through
// Modelica, must not see points that change places.
#include <random>

#include "support/scene_query.hpp"

namespace test_order_of_points {
namespace {

using namespace cmb::test;

constexpr double move = 1e-8, depth = 1e-3;

struct Body {
  const char *name, *descriptor;
  double height;  // of its middle over the plane, where it lies flat on it
};

void PrintTo(const Body &body, std::ostream *stream) { *stream << body.name; }

class OrderOfPoints : public testing::TestWithParam<Body> {};

// Flat, all corners are equally low: each little turn makes another one the lowest.
TEST_P(OrderOfPoints, StaysWhereAFlatBodyIsTurned) {
  const Body &body = GetParam();
  const PairScene scene(body.descriptor, "cmb/1 halfspace");
  std::mt19937 engine(1127);
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  for (int yaw = 0; yaw < 20; ++yaw) {
    BodyPose pose{{0.1, 0.2, body.height - depth}, rotation_about({0, 0, 1}, 3.0 * part(engine))};
    const Contact flat = scene.query(pose, {}, 16);
    ASSERT_GE(flat.points.size(), 3u);
    for (int k = 0; k < 50; ++k) {
      BodyPose turned = pose;
      turned.rotation = product(rotation_about({part(engine), part(engine), part(engine)}, move), pose.rotation);
      const Contact beside = scene.query(turned, {}, 16);
      ASSERT_EQ(beside.points.size(), flat.points.size());
      for (std::size_t i = 0; i < flat.points.size(); ++i) {
        ASSERT_LT(norm(beside.points[i].position - flat.points[i].position), 10 * move) << i;
        ASSERT_NEAR(beside.points[i].depth, flat.points[i].depth, 10 * move) << i;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, OrderOfPoints,
    testing::Values(Body{"box", "cmb/1 box size=1,0.6,0.4", 0.2}, Body{"cube", "cmb/1 box size=1,1,1", 0.5},
                    Body{"tetrahedron", "cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,0.3,0.3,1", 0.0},
                    Body{"prism of six sides", "cmb/1 hull vertices=1,0,0,0.5,0.8660254,0,-0.5,0.8660254,0,-1,0,0,-0.5,-0.8660254,0,0.5,-0.8660254,0,1,0,1,0.5,0.8660254,1,-0.5,0.8660254,1,-1,0,1,-0.5,-0.8660254,1,0.5,-0.8660254,1", 0.0}),
    [](const testing::TestParamInfo<Body> &info) {
      std::string name = info.param.name;
      for (char &letter : name) letter = letter == ' ' ? '_' : letter;
      return name;
    });

}  // namespace
}  // namespace test_order_of_points
