// Bodies in the corner between a floor and a wall of one mesh: what each of these does alone, both do together, whatever else of the mesh is
// behind them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "support/mesh_text.hpp"
#include "support/modelica_format_error.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_corners_of_rooms {
namespace {

using namespace cmb::test;
using namespace mesh_samples;
using random_bodies::Random;

constexpr double pi = 3.14159265358979323846;

// Each triangle in four.
MeshData subdivided(const MeshData &data) {
  MeshData result;
  for (const auto &t : data.triangles) {
    for (std::size_t k = 0; k < 3; ++k) result.vertices.push_back(data.vertices[t[k]]);
    const auto first = static_cast<std::uint32_t>(result.vertices.size()) - 3;
    for (std::size_t k = 0; k < 3; ++k) {
      result.vertices.push_back(0.5 * (result.vertices[first + k] + result.vertices[first + (k + 1) % 3]));
    }
    result.triangles.push_back({first, first + 3, first + 5});
    result.triangles.push_back({first + 3, first + 1, first + 4});
    result.triangles.push_back({first + 5, first + 4, first + 2});
    result.triangles.push_back({first + 3, first + 4, first + 5});
  }
  return result;
}

// The inner corner of an L is the z axis: its floor is y = 0, its wall x = 0. As thick as a twentieth of a metre to half of one.
MeshData any_angle(Random &random) {
  const auto length = [&](double least, double most) {
    return random.integer(0, 1) == 1 ? 0.1 * random.integer(static_cast<int>(10 * least), static_cast<int>(10 * most)) : random.uniform(least, most);
  };
  const double below = length(0.1, 0.5), behind = length(0.1, 0.5), wide = length(0.4, 1.5), high = length(0.6, 1.5), deep = length(0.4, 2.0);
  MeshData data = angle_prism({-behind, wide, wide, 0, 0, -behind}, {-below, -below, 0, 0, high, high}, -deep, deep);
  for (int k = random.integer(0, 3); k > 0; --k) data = subdivided(data);
  return data;
}

// Two walls and a floor between them.
MeshData any_channel(Random &random) {
  const double below = random.uniform(0.05, 0.4), behind = random.uniform(0.05, 0.4), wide = random.uniform(0.5, 1.0);
  const double high = random.uniform(0.6, 1.2), deep = random.uniform(0.4, 2.0);
  const Vec3 outline[] = {{-behind, -below, 0}, {wide + behind, -below, 0}, {wide + behind, high, 0}, {wide, high, 0}, {wide, 0, 0}, {0, 0, 0}, {0, high, 0},
                          {-behind, high, 0}};
  MeshData data;
  for (const double z : {-deep, deep}) {
    for (Vec3 p : outline) p.z = z, data.vertices.push_back(p);
  }
  const std::uint32_t cap[][3] = {{0, 1, 4}, {0, 4, 5}, {1, 2, 3}, {1, 3, 4}, {0, 5, 6}, {0, 6, 7}};
  for (const auto &t : cap) {
    data.triangles.push_back({t[0], t[2], t[1]});
    data.triangles.push_back({t[0] + 8, t[1] + 8, t[2] + 8});
  }
  for (std::uint32_t k = 0; k < 8; ++k) {
    const std::uint32_t next = (k + 1) % 8;
    data.triangles.push_back({k, next, next + 8});
    data.triangles.push_back({k, next + 8, k + 8});
  }
  for (int k = random.integer(0, 2); k > 0; --k) data = subdivided(data);
  return data;
}

// Its size from its middle along x and y; its axes along the ground's, a cylinder's or capsule's along y. A cone stands on its tip: its rim is at the wall
// alone.
struct Body {
  std::string text;
  double x, y;
};

Body any_body(Random &random, const std::string &kind) {
  const double a = random.uniform(0.05, 0.3), b = random.uniform(0.05, 0.3), c = random.uniform(0.05, 0.3);
  if (kind == "box" || kind == "ellipsoid") return {"cmb/1 " + kind + " size=" + digits(a) + "," + digits(b) + "," + digits(c), 0.5 * a, 0.5 * b};
  if (kind == "mesh") return {mesh_text(with_speck(box_mesh({a, b, c}, 1), {0, 0.5 * b, 0})), 0.5 * a, 0.5 * b};
  if (kind == "octahedron") {
    const std::string x = digits(0.5 * a), y = digits(0.5 * b), z = digits(0.5 * c);
    return {"cmb/1 hull vertices=" + x + ",0,0,-" + x + ",0,0,0," + y + ",0,0,-" + y + ",0,0,0," + z + ",0,0,-" + z, 0.5 * a, 0.5 * b};
  }
  return {"cmb/1 " + kind + " radius=" + digits(0.5 * a) + " length=" + digits(b), 0.5 * a, kind == "capsule" ? 0.5 * (a + b) : 0.5 * b};
}

using Kinds = std::tuple<std::string, std::string>;

class CornersOfRooms : public testing::TestWithParam<Kinds> {};

void expect_sums(const Kinds &kinds, std::uint64_t seed, int samples) {
  const auto &[kind, ground_kind] = kinds;
  Random random(seed);
  const double upright = kind == "cone" ? 0.5 : kind == "cylinder" || kind == "capsule" ? -0.5 : 0.0;
  for (int k = 0; k < samples; ++k) {
    const Body body = any_body(random, kind);
    const Mat3 frame = random.integer(0, 1) == 1 ? random_bodies::random_rotation(random) : rotation_about({0, 0, 1}, 0.0);
    MeshData data = ground_kind == "angle" ? any_angle(random) : any_channel(random);
    for (Vec3 &p : data.vertices) p = frame * p;
    const PairScene scene(body.text, mesh_text(data));
    const double size = 2.0 * std::fmin(body.x, body.y), wall = size * random.log_uniform(1e-4, 1e-2), floor = size * random.log_uniform(1e-4, 1e-2);
    const double clear = 0.25, z = random.uniform(-0.1, 0.1);
    const Mat3 turn = product(frame, rotation_about({1, 0, 0}, upright * pi));
    const auto load = [&](double x, double y) { return scene.query({frame * Vec3{x, y, z}, turn}, {}, 128).load(); };
    const Vec3 both = load(body.x - wall, body.y - floor), on_floor = load(std::fmax(body.x, 0.2), body.y - floor), at_wall = load(body.x - wall, body.y + clear);
    const std::string where = std::to_string(k) + " " + body.text + ", wall " + digits(wall) + ", floor " + digits(floor);
    EXPECT_GT(dot(on_floor, frame.column(1)), 0.05 * floor) << where;
    EXPECT_GT(dot(at_wall, frame.column(0)), 0.02 * wall) << where;
    // What is beyond both surfaces counts for one of them: as wide as the other depth.
    EXPECT_LT(norm(both - on_floor - at_wall), 0.05 * (norm(on_floor) + norm(at_wall))) << where;
    cmb_release_scene(scene.handle());
  }
}

TEST_P(CornersOfRooms, CarryWhatFloorAndWallDo) { expect_sums(GetParam(), 1, 12); }

TEST_P(CornersOfRooms, CarryWhatFloorAndWallDoInManyPoses) { expect_sums(GetParam(), 2, 400); }

const auto name_of = [](const auto &info) { return std::get<0>(info.param) + "In" + std::get<1>(info.param); };

INSTANTIATE_TEST_SUITE_P(All, CornersOfRooms,
                         testing::Combine(testing::Values("box", "octahedron", "capsule", "ellipsoid", "cylinder", "cone", "mesh"),
                                          testing::Values("angle", "channel")),
                         name_of);

}  // namespace
}  // namespace test_corners_of_rooms
