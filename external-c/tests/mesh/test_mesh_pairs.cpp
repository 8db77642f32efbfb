// Meshes and height fields against every other kind of shape, through the C interface.
#include "stress/solids.hpp"
#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_mesh_pairs {
namespace {

using namespace cmb::test;
using mesh_samples::box_mesh;
using mesh_samples::height_field_text;
using mesh_samples::mesh_text;
using mesh_samples::with_speck;
using mesh_samples::sphere_mesh;

constexpr double pi = 3.14159265358979323846;
const double flat_height = 0.5;

const std::string &flat_field() {
  static const std::string text = height_field_text(4.0, 10, [](double, double) { return flat_height; });
  return text;
}

const char *const floor_halfspace = "cmb/1 halfspace position=0,0,0.5";

double load_of(const Contact &contact) { return norm(contact.load()); }

// Round bodies on a plane cut into triangles.

TEST(EllipsoidOnMesh, PlaneGivesTheHalfspacesAnswer) {
  const char *const ellipsoid = "cmb/1 ellipsoid size=0.4,0.6,0.8";
  const PairScene on_mesh(ellipsoid, flat_field()), on_plane(ellipsoid, floor_halfspace);
  random_bodies::Random random(1);
  for (int i = 0; i < 200; ++i) {
    const Mat3 rotation = random_bodies::random_rotation(random);
    BodyPose pose{{random.uniform(-1, 1), random.uniform(-1, 1), 3.0}, rotation};
    pose.position.z -= on_plane.query(pose, {}).distance + random.uniform(1e-5, 0.02);
    const Contact a = on_mesh.query(pose, {}), b = on_plane.query(pose, {});
    ASSERT_NEAR(a.distance, b.distance, 1e-12);
    // Of the depth and its cube a cap of the unit ball, h high, has the integrals pi (h^3 / 3 - h^4 / 12) and pi (h^5 / 10 - h^6 / 60). Its energy is 5/3 of
    // their ratio by the square of what the ellipsoid is high there.
    const double high = pose.position.z - flat_height - b.distance, h = -b.distance / high;
    const double top = h * h * h / 10.0 - h * h * h * h / 60.0, base = h / 3.0 - h * h / 12.0;
    const double slope = (0.3 * h * h - h * h * h / 15.0 - top / base * (1.0 / 3.0 - h / 6.0)) / base;
    ASSERT_NEAR(norm(a.load() - Vec3{0, 0, 5.0 / 3.0 * high * slope}), 0.0, 1e-7 * norm(b.load()));
    ASSERT_NEAR(norm(a.load()), norm(b.load()), 0.3 * h * norm(b.load()));
    // The points spread over the patch; their middle stays within its depth of the lowest point.
    ASSERT_LT(norm(a.moment(b.points[0].position)), 0.4 * load_of(b) * std::sqrt(-b.distance * 0.8));
    const BodyPose above{{pose.position.x, pose.position.y, pose.position.z + 0.7}, rotation};
    ASSERT_NEAR(on_mesh.query(above, {}).distance, on_plane.query(above, {}).distance, 1e-9);
  }
}

TEST(CylinderOnMesh, StandsWithItsDepth) {
  const PairScene scene("cmb/1 cylinder radius=0.3 length=0.5", flat_field());
  for (const double x : {0.0, 0.3, 0.61}) {
    const Contact contact = scene.query({{x, 0.17, flat_height + 0.24}, rotation_about({0, 0, 1}, x)}, {}, 64);
    EXPECT_NEAR(contact.distance, -0.01, 1e-14);
    EXPECT_NEAR(load_of(contact), 0.01, 1e-14);
    EXPECT_NEAR(norm(contact.moment({x, 0.17, 0.0})), 0.0, 1e-14);
  }
}

TEST(CylinderOnMesh, LiesSofterThanItStands) {
  const PairScene scene("cmb/1 cylinder radius=0.3 length=0.5", flat_field());
  for (const double depth : {1e-6, 1e-4, 1e-2}) {
    const Mat3 lying = rotation_about({0, 1, 0}, pi / 2);
    const Contact contact = scene.query({{0.1, 0.2, flat_height + 0.3 - depth}, lying}, {}, 64);
    EXPECT_NEAR(contact.distance, -depth, 1e-12);
    // The integral of the cube of the depth by that of the depth, of a parabola's segment.
    EXPECT_NEAR(load_of(contact), 16.0 / 21.0 * depth, 0.2 * depth * depth / 0.3 + 1e-6 * depth) << depth;
    EXPECT_NEAR(norm(contact.moment({0.1, 0.2, 0.0})), 0.0, 1e-9 * depth);
  }
}

TEST(CapsuleOnMesh, AlongAnEdgeItIsAsFarAsFromTheBox) {
  // The edge is shorter than the axis, and turned by angles whose sines are not exact.
  const PairScene scene("cmb/1 capsule radius=0.5 length=1.4", mesh_text(with_speck(mesh_samples::box_mesh({0.6, 0.8, 0.3})))),
      box("cmb/1 capsule radius=0.5 length=1.4", "cmb/1 box size=0.6,0.8,0.3");
  random_bodies::Random random(4);
  for (int i = 0; i < 200; ++i) {
    const BodyPose mesh{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                        random_bodies::random_rotation(random)};
    const double turn = random.uniform(-pi, pi), out = random.uniform(0.7, 1.6);
    const Vec3 beside{out * std::cos(turn), out * std::sin(turn), random.uniform(-0.3, 0.3)};
    BodyPose capsule = mesh;
    capsule.position = mesh.position + mesh.rotation * beside;
    const double expected = box.query(capsule, mesh).distance;
    if (expected < -0.05) continue;
    const double distance = scene.query(capsule, mesh).distance;
    if (expected > 0.0) {
      ASSERT_NEAR(distance, expected, 1e-12) << i;
    } else {
      // Touching, depths are those below faces: over a right-angled edge at least by the cosine of 45 degrees as great.
      ASSERT_GE(distance, expected - 1e-12) << i;
      ASSERT_LE(distance, std::sqrt(0.5) * expected + 1e-12) << i;
    }
  }
}

TEST(CapsuleOnMesh, WhoseAxisPassesThroughIsNotApart) {
  const PairScene plate("cmb/1 capsule radius=0.05 length=2", mesh_text(with_speck(mesh_samples::box_mesh({3, 3, 0.2})))),
      sheet("cmb/1 capsule radius=0.05 length=2", flat_field());
  for (const double z : {-0.4, 0.0, 0.7}) {
    EXPECT_LE(plate.query({{0.23, 0.31, z}, {}}, {}).distance, 0.0);
    EXPECT_LE(sheet.query({{0.23, 0.31, flat_height + z}, {}}, {}).distance, 0.0);
  }
}

TEST(CylinderOnMesh, BesideFlatTetrahedraOfSupportsItIsApart) {
  // Rounding made four nearly coplanar points seem to hold the origin.
  const cmb::stress::Solid angle = cmb::stress::detail::angle_mesh(0.1, 2.0, 1.0);
  const char *const cylinder = "cmb/1 cylinder radius=0.12061870293486787 length=2";
  const PairScene on_mesh(cylinder, angle.text), on_parts(cylinder, angle.twin);
  const BodyPose pose{{0x1.744360d1c983cp-4, 0x1.2baaec790c7f1p-1, 0x1.701cd8b18817p-4},
                      {{{-0x1.7337b86fb244p-3, -0x1.b864535e8f7p-1, 0x1.e834c7f57965cp-2},
                        {0x1.16175e45bb364p-1, 0x1.4430431a0a9c2p-2, 0x1.8e2a059f77afep-1},
                        {-0x1.a3c1fcbd71dfep-1, 0x1.998254d7c2168p-2, 0x1.a3a215934f9c4p-2}}}};
  EXPECT_NEAR(on_parts.query(pose, {}).distance, 0.0023732919686147557, 1e-12);
  EXPECT_NEAR(on_mesh.query(pose, {}).distance, 0.0023732919686147557, 1e-9);
}

TEST(HullBesideMesh, WithTheMiddleOfItsBoxInTheMeshIsApart) {
  // A sliver along x + y + z = 1 beside the corner of a cube: the middle of its box lies in the cube, the sliver does not.
  const char *const sliver = "cmb/1 hull vertices=1,0,0,0,1,0,0,0,1,0.2,0.2,0.2";
  const PairScene scene(sliver, mesh_text(with_speck(mesh_samples::box_mesh({1.4, 1.4, 1.4}))));
  const BodyPose cube{{1.06, 1.06, 1.06}, {}};
  const Contact contact = scene.query({}, cube);
  EXPECT_NEAR(contact.distance, 0.08 / std::sqrt(3.0), 1e-12);
  EXPECT_TRUE(contact.points.empty());
}

TEST(RoundBodiesOnMesh, RollWithoutBumps) {
  for (const char *body : {"cmb/1 cylinder radius=0.3 length=0.5", "cmb/1 cone radius=0.3 length=0.5"}) {
    const PairScene scene(body, flat_field());
    const bool cone = std::string(body).find("cone") != std::string::npos;
    const double tilt = cone ? std::atan2(0.3, 0.5) : 0.0;  // a cone rolls on its mantle
    const auto at = [&](double turn) {
      const Mat3 down = rotation_about({0, 1, 0}, pi / 2 + tilt);
      BodyPose pose{{-0.5 + 0.3 * turn, 0.1, 3.0}, product(down, rotation_about({0, 0, 1}, turn))};
      pose.position.z = flat_height + (cone ? 0.25 * std::sin(tilt) : 0.3) - 0.005;
      return scene.query(pose, {}, 64);
    };
    const Contact first = at(0.0);
    ASSERT_GT(load_of(first), 0.0) << body;
    for (int i = 1; i <= 200; ++i) {
      const Contact contact = at(0.013 * i);
      ASSERT_NEAR(contact.distance, first.distance, 1e-12) << body;
      ASSERT_NEAR(load_of(contact), load_of(first), 1e-9 * load_of(first)) << body;
    }
  }
}

TEST(RoundBodiesOnMesh, CubeGivesTheBoxsDistanceWhereApart) {
  random_bodies::Random random(3);
  const std::string cube = mesh_text(with_speck(box_mesh({1, 2, 3}, 3)));
  for (const char *body : {"cmb/1 ellipsoid size=0.4,0.6,0.8", "cmb/1 cylinder radius=0.3 length=0.5",
                           "cmb/1 cone radius=0.3 length=0.5"}) {
    const PairScene on_mesh(body, cube), on_box(body, "cmb/1 box size=1,2,3");
    int compared = 0;
    for (int i = 0; i < 300; ++i) {
      const BodyPose pose{{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2.5, 2.5)},
                          random_bodies::random_rotation(random)};
      const Contact b = on_box.query(pose, {});
      if (!(b.distance > 1e-3)) continue;
      ++compared;
      const Contact a = on_mesh.query(pose, {});
      ASSERT_NEAR(a.distance, b.distance, 1e-8) << body;
      ASSERT_TRUE(a.points.empty());
    }
    EXPECT_GT(compared, 60) << body;
  }
}

TEST(RoundBodiesOnMesh, CubeGivesTheBoxsDepthOnFaces) {
  const std::string cube = mesh_text(with_speck(box_mesh({1, 1, 1}, 4)));
  random_bodies::Random random(4);
  for (const char *body : {"cmb/1 ellipsoid size=0.2,0.3,0.4", "cmb/1 cylinder radius=0.1 length=0.2",
                           "cmb/1 cone radius=0.1 length=0.2"}) {
    const PairScene on_mesh(body, cube), on_box(body, "cmb/1 box size=1,1,1");
    for (int i = 0; i < 100; ++i) {
      BodyPose pose{{random.uniform(-0.2, 0.2), random.uniform(-0.2, 0.2), 1.0},
                    random_bodies::random_rotation(random)};
      pose.position.z -= on_box.query(pose, {}).distance + 0.005;
      const Contact a = on_mesh.query(pose, {}), b = on_box.query(pose, {});
      ASSERT_NEAR(a.distance, b.distance, 1e-9) << body;
      ASSERT_GT(a.load().z, 0.0);
      ASSERT_NEAR(norm(a.load() - Vec3{0, 0, a.load().z}), 0.0, 1e-6 * a.load().z) << body;
    }
  }
}

// Mesh against mesh.

TEST(MeshOnMesh, CubeRestsOnATableWithItsDepth) {
  const PairScene scene(mesh_text(with_speck(box_mesh({0.5, 0.5, 0.5}, 2))),
                        mesh_text(with_speck(box_mesh({3, 3, 1}, 5), {0, 40, 0})));
  for (int i = 0; i < 50; ++i) {
    const double x = 0.017 * i, yaw = 0.05 * i, depth = 1e-3;
    const Contact contact = scene.query({{x, 0.1, 0.75 - depth}, rotation_about({0, 0, 1}, yaw)}, {}, 64);
    ASSERT_NEAR(contact.distance, -depth, 1e-14);
    ASSERT_NEAR(norm(contact.load() - Vec3{0, 0, depth}), 0.0, 1e-13);
    ASSERT_NEAR(norm(contact.moment({x, 0.1, 0.0})), 0.0, 1e-13);
  }
}

TEST(MeshOnMesh, FieldCarriesACubeAsAHalfspaceDoes) {
  const PairScene scene(mesh_text(with_speck(box_mesh({0.5, 0.5, 0.5}, 2))), flat_field());
  const Contact contact = scene.query({{0.1, 0.2, flat_height + 0.24}, rotation_about({0, 0, 1}, 0.3)}, {}, 64);
  EXPECT_NEAR(contact.distance, -0.01, 1e-14);
  EXPECT_NEAR(norm(contact.load() - Vec3{0, 0, 0.01}), 0.0, 1e-13);
}

TEST(MeshOnMesh, CubesGiveTheBoxesDistanceWhereApart) {
  random_bodies::Random random(5);
  const PairScene meshes(mesh_text(with_speck(box_mesh({1, 0.5, 0.7}, 2))),
                         mesh_text(with_speck(box_mesh({1, 2, 3}, 3), {0, 40, 0})));
  const PairScene boxes("cmb/1 box size=1,0.5,0.7", "cmb/1 box size=1,2,3");
  int compared = 0;
  for (int i = 0; i < 400; ++i) {
    const BodyPose a{{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-2.5, 2.5)},
                     random_bodies::random_rotation(random)};
    const BodyPose b{{0.3, -0.2, 0.1}, random_bodies::random_rotation(random)};
    const Contact exact = boxes.query(a, b);
    if (!(exact.distance > 0.0)) continue;
    ++compared;
    ASSERT_NEAR(meshes.query(a, b).distance, exact.distance, 1e-12);
  }
  EXPECT_GT(compared, 100);
}

// An L of two boxes, as one mesh and as two boxes.
TEST(MeshOnMesh, AngleBodyCarriesAsItsConvexPieces) {
  mesh_samples::MeshData angle;
  // The outline in the xz plane, counter-clockwise seen from -y, extruded along y.
  const double outline[6][2] = {{0, 0}, {2, 0}, {2, 0.5}, {0.5, 0.5}, {0.5, 2}, {0, 2}};
  for (const double y : {-0.5, 0.5}) {
    for (const auto &p : outline) angle.vertices.push_back({p[0], y, p[1]});
  }
  const std::uint32_t cap[4][3] = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 5}};
  for (const auto &t : cap) {
    angle.triangles.push_back({t[0], t[1], t[2]});
    angle.triangles.push_back({t[0] + 6, t[2] + 6, t[1] + 6});
  }
  for (std::uint32_t i = 0; i < 6; ++i) {
    const std::uint32_t j = (i + 1) % 6;
    angle.triangles.push_back({i, i + 6, j + 6});
    angle.triangles.push_back({i, j + 6, j});
  }
  const std::string pieces =
      "cmb/1 box size=2,1,0.5 position=1,0,0.25;cmb/1 box size=0.5,1,1.5 position=0.25,0,1.25";
  // The speck is in nobody's way, and near: the larger body is the one that pushes.
  const std::string cube = mesh_text(with_speck(box_mesh({0.4, 0.4, 0.4}, 2), {0, 0.8, 0}));
  const PairScene meshes(cube, mesh_text(angle)), convex("cmb/1 box size=0.4,0.4,0.4", pieces);
  struct Case {
    Vec3 position, force;
  };
  const double depth = 0.004;
  // On the foot's top, against the upright's inner side, in the corner, on the upright's top.
  const Case cases[] = {{{1.3, 0.1, 0.7 - depth}, {0, 0, depth}},
                        {{0.7 - depth, 0.05, 1.4}, {depth, 0, 0}},
                        {{0.7 - depth, 0.0, 0.7 - depth}, {depth, 0, depth}},
                        {{0.25, 0.0, 2.2 - depth}, {0, 0, depth}}};
  for (const Case &c : cases) {
    const Contact a = meshes.query({c.position, {}}, {}, 64), b = convex.query({c.position, {}}, {}, 64);
    EXPECT_NEAR(a.distance, b.distance, 1e-12);
    EXPECT_NEAR(norm(b.load() - c.force), 0.0, 1e-9);
    EXPECT_NEAR(norm(a.load() - c.force), 0.0, 0.02 * depth) << c.position.x << ' ' << c.position.z;
  }
}

TEST(MeshOnMesh, ExchangeReversesTheNormals) {
  const std::string one = mesh_text(with_speck(sphere_mesh(0.5, 2))),
                    two = mesh_text(with_speck(box_mesh({1, 0.8, 0.6}, 3), {0, 40, 0}));
  const PairScene forward(one, two), backward(two, one);
  random_bodies::Random random(6);
  for (int i = 0; i < 100; ++i) {
    const BodyPose a{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)},
                     random_bodies::random_rotation(random)};
    const Contact x = forward.query(a, {}, 256), y = backward.query({}, a, 256);
    ASSERT_NEAR(x.distance, y.distance, 1e-12);
    ASSERT_NEAR(norm(x.load() + y.load()), 0.0, 1e-12);
  }
}

// Of two meshes as large as each other, the same one or another one, none is the first.
TEST(MeshOnMesh, ExchangeOfEqualOnesReversesTheNormals) {
  const std::string one = mesh_text(mesh_samples::angle_prism({-0.5, 0.5, 0.5, 0, 0, -0.5}, {-0.5, -0.5, 0, 0, 0.5, 0.5}, -0.25, 0.25)),
                    another = mesh_text(mesh_samples::angle_prism({-0.5, 0.5, 0.5, 0, 0, -0.5}, {-0.5, -0.5, 0.1, 0.1, 0.5, 0.5}, -0.25, 0.25));
  random_bodies::Random random(8);
  for (const std::string &two : {one, another}) {
    const PairScene forward(one, two), backward(two, one);
    int touching = 0;
    for (int i = 0; i < 80; ++i) {
      const BodyPose a{{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-0.6, 0.6)}, random_bodies::random_rotation(random)};
      const Contact x = forward.query(a, {}, 256), y = backward.query({}, a, 256);
      ASSERT_NEAR(x.distance, y.distance, 1e-12);
      ASSERT_NEAR(norm(x.load() + y.load()), 0.0, 1e-9 * norm(x.load())) << i;
      ASSERT_NEAR(norm(x.moment({}) + y.moment({})), 0.0, 1e-9 * norm(x.load())) << i;
      touching += x.distance < 0.0 ? 1 : 0;
    }
    EXPECT_GT(touching, 20);
  }
}

// Both directions of the load of equal spheres lie on the line of centres; its size is that of the mean depth.
TEST(MeshOnMesh, SpheresPushAlongTheLineOfCentres) {
  const PairScene scene(mesh_text(with_speck(sphere_mesh(0.5, 4))), mesh_text(with_speck(sphere_mesh(0.5, 4), {0, 40, 0})));
  random_bodies::Random random(7);
  for (int i = 0; i < 20; ++i) {
    const Vec3 d = random_bodies::random_rotation(random).column(0);
    const double depth = 0.02;
    const Contact contact = scene.query({(1.0 - depth) * d, random_bodies::random_rotation(random)}, {}, 64);
    EXPECT_NEAR(contact.distance, -depth, 0.004);
    const Vec3 direction = normalized(contact.load());
    EXPECT_GT(dot(direction, d), 0.9995);
    EXPECT_NEAR(load_of(contact), 0.5 * depth, 0.12 * depth);
  }
}

TEST(MeshOnMesh, SwallowedBodyIsPushedOut) {
  const PairScene scene(mesh_text(with_speck(box_mesh({0.1, 0.1, 0.1}, 1))),
                        mesh_text(with_speck(box_mesh({2, 2, 2}, 2), {0, 40, 0})));
  const Contact contact = scene.query({{0.6, 0.1, 0}, {}}, {});
  EXPECT_LT(contact.distance, 0.0);
  EXPECT_GT(contact.load().x, 0.0);
  EXPECT_NEAR(norm(contact.load() - Vec3{contact.load().x, 0, 0}), 0.0, 1e-12);
}

// A body around a whole mesh pushes it out, whatever pushes at its surface.
TEST(MeshInside, EveryBodyThatHoldsAMeshPushes) {
  const std::string mesh = mesh_text(with_speck(box_mesh({1, 0.5, 0.75}, 2)));
  for (const char *body : {"cmb/1 capsule radius=1.25 length=1", "cmb/1 sphere radius=2"}) {
    const PairScene scene(body, mesh);
    for (const Vec3 &place : {Vec3{0, 0, 0}, Vec3{0.1, 0.05, 0.02}}) {
      const Contact contact = scene.query({place, {}}, {});
      EXPECT_LT(contact.distance, 0.0) << body;
      EXPECT_GT(contact.total_weight(), 0.0) << body;
    }
  }
}

}  // namespace
}  // namespace test_mesh_pairs
