// Bodies that a mesh passes through: each is pushed, however little or deep, and to the right side.
#include <cmath>
#include <string>
#include <vector>

#include "mesh/contact/triangle_convex_distance.hpp"
#include "mesh/distance/mesh_pair_distance.hpp"
#include "mesh/intersection/triangle_crossing.hpp"
#include "mesh/intersection/triangle_section.hpp"
#include "mesh/wedges/triangle_wedge.hpp"
#include "support/mesh_text.hpp"
#include "support/random_bodies.hpp"
#include "support/scene_query.hpp"

namespace test_pierced_mesh {
namespace {

using namespace cmb::test;
using cmb::convex::ConvexBody;
using mesh_samples::angle_prism;
using mesh_samples::box_mesh;
using mesh_samples::mesh_text;
using mesh_samples::with_speck;
using mesh_samples::MeshData;
using mesh_samples::sheet_mesh;
using mesh_samples::sphere_mesh;
using random_bodies::Random;
using random_bodies::random_rotation;

const char *const ellipsoid = "cmb/1 ellipsoid size=0.4,0.5,0.6", *const cylinder = "cmb/1 cylinder radius=0.2 length=0.4",
                  *const cone = "cmb/1 cone radius=0.2 length=0.4", *const box = "cmb/1 box size=0.4,0.4,0.4",
                  *const sphere = "cmb/1 sphere radius=0.2", *const capsule = "cmb/1 capsule radius=0.1 length=0.3";
const char *const kinds[] = {ellipsoid, cylinder, cone, box, sphere, capsule};

double largest_depth(const Contact &contact) {
  double most = 0.0;
  for (const Point &p : contact.points) most = std::fmax(most, p.depth);
  return most;
}

BodyPose at(double x, double y, double z) { return {{x, y, z}, {}}; }

// An L: a rectangle of half sizes a and b without a quarter, from -h to h.
MeshData angle_mesh(double a, double b, double h) {
  return angle_prism({-a, a, a, 0, 0, -a}, {-b, -b, 0, 0, b, b}, -h, h);
}

// The roof of an L, as the stress program found it: the part of an edge inside the ellipsoid is shorter than the pieces of
// the ellipsoid's surface are off it.
TEST(EdgeInRoundBody, EllipsoidOnTheEdgesOfAnAngle) {
  const double a = 0.14125405647717162, h = 0.070627028238585812;
  const std::string body = "cmb/1 ellipsoid size=1.0648032008156281,1.6290731915290635,2";
  const PairScene scene(body, mesh_text(angle_mesh(a, a, h)));
  const PairScene parts(body, "cmb/1 box size=" + std::to_string(2 * a) + "," + std::to_string(a) + "," +
                                  std::to_string(2 * h) + " position=0," + std::to_string(-0.5 * a) + ",0");
  const double s = std::sqrt(0.5);
  BodyPose pose = at(0.5847852, -0.55912602, 0.72651587);
  pose.rotation = cmb::convex::Mat3{{{-s, s, 0}, {-s, -s, 0}, {0, 0, 1}}};
  ASSERT_LT(parts.query(pose, {}).distance, -4e-3);
  const Contact contact = scene.query(pose, {});
  EXPECT_LT(contact.distance, -1e-3);
  EXPECT_GT(dot(contact.load(), {1, -1, 1}), 1e-3);
}

// A ridge below round bodies: at every depth, however small, it pushes up.
TEST(EdgeInRoundBody, PushesAtOnce) {
  const std::string cube = mesh_text(with_speck(box_mesh({1, 1, 1})));
  const PairScene scenes[] = {{ellipsoid, cube}, {cylinder, cube}, {cone, cube}, {sphere, cube}, {capsule, cube}};
  const BodyPose ridge{{0, 0, -std::sqrt(0.5)}, rotation_about({0, 1, 0}, 0.78539816339744831)};
  Random random(11);
  for (const PairScene &scene : scenes) {
    for (int k = 0; k < 200; ++k) {
      BodyPose pose{{0, random.uniform(-0.2, 0.2), 0.8}, random_rotation(random)};
      for (int step = 0; step < 60; ++step) {  // down until it touches
        const double gap = scene.query(pose, ridge).distance;
        if (gap < 1e-12) break;
        pose.position.z -= gap;
      }
      pose.position.z -= random.log_uniform(1e-8, 1e-2);
      const Contact contact = scene.query(pose, ridge);
      EXPECT_LT(contact.distance, 0.0);
      EXPECT_GT(contact.load().z, 0.0) << k;
    }
  }
}

// A plate right through a cube, wider than it: the cube leaves by the side from which less has to come through.
TEST(PiercedBody, LeavesAPlateByTheShorterWay) {
  const PairScene scene(box, mesh_text(with_speck(box_mesh({2, 2, 0.02}, 3))));
  for (const double z : {-0.15, -0.08, -0.03, 0.03, 0.08, 0.15}) {
    const Contact contact = scene.query(at(0.013, 0.02, z), {});
    const Vec3 load = contact.load();
    EXPECT_LT(contact.distance, -0.02);
    EXPECT_GT(load.z * z, 0.0) << z;
    EXPECT_LT(std::hypot(load.x, load.y), 1e-9) << z;
    EXPECT_LE(largest_depth(contact), 0.22);
  }
}

// A plate's end in a cube's side, deeper than the plate is thick, above the cube's middle: the exit direction is back.
TEST(PiercedBody, LeavesAPlatesEndTheWayItCame) {
  const PairScene scene(box, mesh_text(with_speck(box_mesh({1, 1, 0.02}, 3))));
  for (const double depth : {0.02, 0.05, 0.08}) {
    const Vec3 load = scene.query(at(0.7 - depth, 0.01, -0.05), {}).load();
    EXPECT_GT(load.x, 0.5 * depth);
    EXPECT_LT(load.x, 1.1 * depth);
    EXPECT_LT(std::hypot(load.y, load.z), 0.2 * load.x) << depth;
  }
}

// Moving by the load leads out: of plate, ball and beam meshes, from random poses. Some come to rest between the sides of a
// plate that reaches through a body, where what both sides push is equal and there is no better side.
TEST(PiercedBody, LoadLeadsOutOfClosedMeshes) {
  const std::string meshes[] = {mesh_text(with_speck(box_mesh({0.5, 0.6, 0.1}, 2))), mesh_text(with_speck(sphere_mesh(0.25, 1))),
                                mesh_text(with_speck(box_mesh({0.08, 0.07, 2.0}, 1)))};
  Random random(3);
  int pierced = 0, all = 0, out = 0;
  for (const std::string &mesh : meshes) {
    for (const char *kind : kinds) {
      const PairScene scene(kind, mesh);
      for (int k = 0; k < 16; ++k) {
        BodyPose pose{0.35 * random.uniform(0, 1) * random.direction(), random_rotation(random)};
        Contact contact = scene.query(pose, {});
        pierced += contact.distance < -0.03;
        for (int step = 0; step < 1200 && contact.distance < -1e-3; ++step) {
          ASSERT_GT(contact.points.size(), 0u) << kind;
          pose.position = pose.position + 0.5 * contact.load();
          contact = scene.query(pose, {});
        }
        ++all;
        out += contact.distance >= -1e-3;
      }
    }
  }
  EXPECT_GE(out, all - all / 40) << "of " << all;
  EXPECT_GT(pierced, 100);
}

// A sheet pushes to its front, however far a body has come through.
TEST(PiercedBody, SheetPushesToItsFront) {
  const auto height = [](double x, double y) { return 0.1 * std::sin(3 * x) * std::cos(2 * y); };
  const std::string sheet = mesh_text(sheet_mesh(3.0, 6, height));
  Random random(5);
  for (const char *kind : kinds) {
    const PairScene scene(kind, sheet);
    for (int k = 0; k < 300; ++k) {
      const double x = random.uniform(-1, 1), y = random.uniform(-1, 1);
      // Its middle within 0.06 of the sheet: every kind reaches through.
      const BodyPose pose{{x, y, height(x, y) + random.uniform(-0.06, 0.06)}, random_rotation(random)};
      const Contact contact = scene.query(pose, {});
      EXPECT_LT(contact.distance, 0.0);
      EXPECT_GT(contact.load().z, 0.0) << kind << " " << k;
    }
  }
}

TEST(PiercedBody, BallBesideARimIsPushedAsideAndToTheFront) {
  const PairScene scene(sphere, mesh_text(sheet_mesh(2.0, 2, [](double, double) { return 0.0; })));
  for (const double z : {-0.1, -0.01, 0.0, 1e-3, 0.1}) {
    const Contact contact = scene.query(at(1.1, 0.3, z), {});
    const double away = std::hypot(0.1, z), depth = 0.2 - away;
    EXPECT_NEAR(contact.distance, -depth, 1e-12);
    EXPECT_NEAR(norm(contact.load() - (depth / away) * Vec3{0.1, 0.0, std::fabs(z)}), 0.0, 1e-12) << z;
    EXPECT_NEAR(norm(contact.moment({1.1, 0.3, z})), 0.0, 1e-12) << z;
  }
}

// On an edge, but for rounding that lies in the sheet's plane.
TEST(PiercedBody, BallWithItsCentreOnAnEdgeIsPushedToTheFront) {
  const PairScene scene(sphere, mesh_text(sheet_mesh(2.4, 7, [](double, double) { return 0.0; })));
  Random random(13);
  for (int k = 0; k < 500; ++k) {
    const double along = random.uniform(-1, 1);
    const Contact contact = scene.query(k % 2 == 0 ? at(along, along, 0.0) : at(2.4 * (2.0 / 7.0 - 0.5), along, 0.0), {});
    EXPECT_NEAR(contact.load().z, 0.2, 1e-12) << along;
  }
}

// The sides of an angle that stands about a sheet's corner are nearer exits, but a sheet has but one front.
TEST(PiercedBody, SheetPushesMeshesToItsFront) {
  const auto height = [](double x, double y) { return 2e-4 * std::sin(5 * x + 1) * std::cos(2 * y); };
  const PairScene scene(mesh_text(angle_mesh(1, 0.13, 0.1)), mesh_text(sheet_mesh(24.0, 16, height)));
  Random random(21);
  for (int k = 0; k < 2000; ++k) {
    const double inclination = k % 2 == 0 ? 0.0 : random.uniform(-0.7, 0.7);
    const BodyPose pose{{random.uniform(-0.01, 0.01), random.uniform(-0.01, 0.01), random.uniform(-0.2, 0.2)},
                        rotation_about({0, 1, 0}, (k % 4 < 2 ? 1.5707963267948966 : -1.5707963267948966) + inclination)};
    const Contact contact = scene.query(pose, {});
    EXPECT_LT(contact.distance, 0.0);
    EXPECT_GT(contact.load().z, 0.0) << k;
  }
}

// Meshes through each other, as the bodies they are made of, touch and carry.
TEST(PiercedBody, MeshesThroughEachOther) {
  const std::string plate = mesh_text(with_speck(box_mesh({1, 1, 0.03}, 4))),
                    rod = mesh_text(with_speck(box_mesh({0.1, 0.12, 2}, 3), {0, 40, 0}));
  const PairScene scene(plate, rod), boxes("cmb/1 box size=1,1,0.03", "cmb/1 box size=0.1,0.12,2");
  Random random(8);
  int touching = 0;
  for (int k = 0; k < 2000; ++k) {
    const BodyPose a{0.6 * random.uniform(0, 1) * random.direction(), random_rotation(random)};
    const double expected = boxes.query(a, {}).distance;
    const Contact contact = scene.query(a, {});
    if (expected > -1e-9) continue;
    ++touching;
    EXPECT_LT(contact.distance, 0.0);
    double load = 0.0;
    for (const Point &p : contact.points) load += p.depth * p.weight;
    EXPECT_GT(load, 0.0);
  }
  EXPECT_GT(touching, 500);
}

// The load has no jumps on paths through plates, beams and sheets, where surface that faces the mesh comes and goes. (A ball turns
// about where its centre is midway between the sides of a closed mesh.)
TEST(PiercedBody, LoadHasNoJumps) {
  const std::string grounds[] = {mesh_text(with_speck(box_mesh({2, 2, 0.05}, 2))),
                                 mesh_text(with_speck(box_mesh({0.08, 0.07, 2.0}, 1))),
                                 mesh_text(sheet_mesh(2.0, 4, [](double x, double y) { return 0.1 * x * y; }))};
  for (const std::string &ground : grounds) {
    for (const char *kind : kinds) {
      if (&ground != &grounds[2] && kind == sphere) continue;
      const PairScene scene(kind, ground);
      const auto load = [&](double s) {
        const Mat3 rotation = rotation_about(normalized(Vec3{0.3, 1, 0.2}), 0.4 + 0.6 * s);
        return scene.query({{-0.05 + 0.1 * s, 0.07 - 0.05 * s, 0.14 - 0.09 * s}, rotation}, {}, 512).load();
      };
      constexpr int samples = 200;
      double largest = 0.0, most = 0.0, begin = 0.0;
      for (int i = 0; i < samples; ++i) {
        const double s = static_cast<double>(i) / samples;
        largest = std::fmax(largest, norm(load(s)));
        const double change = norm(load(s + 1.0 / samples) - load(s));
        if (change > most) most = change, begin = s;
      }
      ASSERT_GT(largest, 1e-3);
      double end = begin + 1.0 / samples, jump = most;
      for (int halving = 0; halving < 26; ++halving) {
        const double middle = 0.5 * (begin + end);
        const double first = norm(load(middle) - load(begin)), second = norm(load(end) - load(middle));
        jump = std::fmax(first, second);
        (first > second ? end : begin) = middle;
      }
      EXPECT_LT(jump, 1e-5 * largest) << kind << " at s = " << begin << " in " << ground.substr(0, 60);
    }
  }
}

// A triangle has a section exactly where the search for a gap finds none.
TEST(TriangleSection, IsThereWhereTriangleAndBodyMeet) {
  using namespace cmb::convex;
  const ConvexBody bodies[] = {make_sphere(0.4), make_capsule(0.2, 0.6), make_ellipsoid({0.1, 0.4, 0.7}), make_cylinder(0.3, 0.5),
                               make_cone(0.4, 0.6)};
  Random random(21);
  std::vector<Vec3> polygon, room;
  for (const ConvexBody &body : bodies) {
    const Pose place{random_rotation(random), 0.1 * random.direction()};
    const cmb::mesh::SectionedBody sectioned(body, place, polygon, room);
    int meeting = 0, apart = 0;
    for (int k = 0; k < 5000; ++k) {
      const double size = random.log_uniform(0.02, 2.0);
      const Vec3 middle = random.uniform(0, 0.9) * random.direction();
      const auto near_middle = [&] { return middle + size * random.direction(); };
      const Vec3 corner[3] = {near_middle(), near_middle(), near_middle()};
      const auto core_gap = cmb::mesh::triangle_convex_gap(corner[0], corner[1], corner[2], body, place, 1e300);
      const double gap = core_gap.distance - body.radius;
      const auto section = sectioned.section(corner);
      (gap > 0.0 ? apart : meeting) += 1;
      if (gap > 1e-6) {
        EXPECT_EQ(section.depth, 0.0) << k;
      }
      if (gap < -1e-6 || (body.radius == 0.0 && gap == 0.0)) {
        EXPECT_GT(section.depth, 0.0) << k;
      }
      if (!(section.depth > 0.0)) continue;
      const Vec3 local = transposed_times(place.rotation, section.place - place.translation);
      EXPECT_LT(norm(local), 1.03 * (core_radius(body) + body.radius));
    }
    EXPECT_GT(meeting, 500);
    EXPECT_GT(apart, 500);
  }
}

// The depth of a triangle's section is that of its deepest place below all sides: no place of a fine grid is deeper, and one is nearly as deep.
TEST(TriangleSection, IsAsDeepAsItsDeepestPlace) {
  using namespace cmb::convex;
  Random random(22);
  std::vector<Vec3> polygon, room;
  for (int k = 0; k < 400; ++k) {
    const double radius = random.log_uniform(0.05, 0.5), half = random.log_uniform(0.005, 0.5);
    const bool cone = k % 2 == 0;
    const ConvexBody body = cone ? make_cone(radius, 2.0 * half) : make_cylinder(radius, 2.0 * half);
    const Pose place{};
    const cmb::mesh::SectionedBody sectioned(body, place, polygon, room);
    // Across the border at the base.
    const Vec3 middle{radius * random.uniform(0.5, 1.0), 0.0, -half * random.uniform(0.5, 1.0)};
    const double size = random.log_uniform(0.1, 1.0) * std::fmin(radius, half);
    const Vec3 corner[3] = {middle + size * random.direction(), middle + size * random.direction(), middle + size * random.direction()};
    const double slope = cone ? 0.5 * radius / half : 0.0, top = cone ? slope * half : radius;
    double deepest = 0.0;
    constexpr int fine = 120;
    for (int i = 0; i <= fine; ++i) {
      for (int j = 0; i + j <= fine; ++j) {
        const double u = static_cast<double>(i) / fine, v = static_cast<double>(j) / fine;
        const Vec3 p = (1.0 - u - v) * corner[0] + u * corner[1] + v * corner[2];
        const double below_mantle = (top - slope * p.z - std::hypot(p.x, p.y)) / std::hypot(1.0, slope);
        deepest = std::fmax(deepest, std::min({below_mantle, p.z + half, cone ? below_mantle : half - p.z}));
      }
    }
    const double found = sectioned.section(corner).depth;
    EXPECT_GE(found, deepest - 1e-12) << k;
    EXPECT_LT(found, deepest + 2.0 * size / fine) << k;
    // What is asked for is whether it is deeper than that.
    if (!(found > 0.0)) continue;
    EXPECT_NEAR(sectioned.section(corner, 0.7 * found).depth, found, 1e-12 * radius) << k;
    EXPECT_EQ(sectioned.section(corner, 1.001 * found).depth, 0.0) << k;
  }
}

// So that of a polytope's, on all kinds of triangles across its edges and corners.
TEST(TriangleSection, IsAsDeepInPolytopesAsItsDeepestPlace) {
  using namespace cmb::convex;
  Random random(23);
  std::vector<Vec3> polygon, room;
  int meeting = 0;
  for (int k = 0; k < 600; ++k) {
    Polytope body;
    if (k % 3 == 0) {
      body = Polytope::box({random.log_uniform(0.01, 1), random.log_uniform(0.01, 1), random.log_uniform(0.01, 1)});
    } else {
      const double thin = random.log_uniform(0.01, 0.5);
      build_convex_hull(random_bodies::random_points(random, random.integer(6, 40), {0.5, 0.4, thin}, false), body, nullptr, nullptr);
    }
    const Pose place{random_rotation(random), random.direction()};
    std::vector<Vec3> vertices, normals;
    for (const Vec3 &v : body.vertices()) vertices.push_back(place(v));
    for (const auto &face : body.faces()) normals.push_back(place.rotation * face.normal);
    const cmb::mesh::SectionedBody sectioned(body, place, vertices, normals, polygon, room);
    const Vec3 &corner_of_body = vertices[static_cast<std::size_t>(random.integer(0, static_cast<int>(vertices.size()) - 1))];
    const Vec3 middle = corner_of_body + random.uniform(0.0, 0.5) * (place(body.center()) - corner_of_body);
    const double size = random.log_uniform(0.01, 10.0);
    const Vec3 corner[3] = {middle + size * random.direction(), middle + size * random.direction(), middle + size * random.direction()};
    // What of the triangle is that deep.
    const auto is_there = [&](double deep) {
      polygon.assign(corner, corner + 3);
      for (std::size_t f = 0; f < normals.size() && !polygon.empty(); ++f) {
        const double offset = dot(normals[f], place(body.vertices()[static_cast<std::size_t>(body.face_vertices()[static_cast<std::size_t>(body.faces()[f].first)])]));
        cmb::mesh::clip_polygon(polygon, -normals[f], deep - offset, room);
      }
      return !polygon.empty();
    };
    const double found = sectioned.section(corner).depth;
    if (!(found > 1e-6 * size)) {
      EXPECT_FALSE(is_there(2e-6 * size)) << k;
      continue;
    }
    ++meeting;
    EXPECT_TRUE(is_there(found - 1e-9 * size)) << k;
    EXPECT_FALSE(is_there(found + 1e-9 * size)) << k;
    EXPECT_NEAR(sectioned.section(corner, 0.7 * found).depth, found, 1e-12 * size) << k;
    EXPECT_EQ(sectioned.section(corner, 1.001 * found).depth, 0.0) << k;
  }
  EXPECT_GT(meeting, 200);
}

// The depth of crossing triangles is the least overlap along all directions.
TEST(TriangleCrossing, IsTheLeastOverlap) {
  using cmb::convex::norm;
  using cmb::mesh::nearest_on_triangle;
  Random random(31);
  int crossing = 0;
  for (int k = 0; k < 400; ++k) {
    Vec3 a[3], b[3];
    for (int i = 0; i < 3; ++i) a[i] = random.direction(), b[i] = random.direction();
    const Vec3 na = normalized(cross(a[1] - a[0], a[2] - a[0])), nb = normalized(cross(b[1] - b[0], b[2] - b[0]));
    const auto found = cmb::mesh::triangle_crossing(a, na, b, nb);
    const bool meet = cmb::mesh::triangle_distance(a, b).distance == 0.0;
    EXPECT_EQ(found.depth > 0.0, meet) << k;
    if (!meet) continue;
    ++crossing;
    const auto overlap = [&](const Vec3 &n) {
      double low = 1e300, high = -1e300;
      for (const Vec3 &p : a) {
        for (const Vec3 &q : b) low = std::fmin(low, dot(n, p - q)), high = std::fmax(high, dot(n, p - q));
      }
      return std::fmin(high, -low);
    };
    double least = 1e300;
    Vec3 best;
    for (int d = 0; d < 2000; ++d) {
      const Vec3 n = random.direction();
      if (overlap(n) < least) least = overlap(n), best = n;
    }
    for (double size = 0.1; size > 1e-7; size *= 0.8) {  // downhill
      for (int d = 0; d < 12; ++d) {
        const Vec3 n = normalized(best + size * random.direction());
        if (overlap(n) < least) least = overlap(n), best = n;
      }
    }
    EXPECT_GE(least, found.depth - 1e-12) << k;
    EXPECT_LT(least, found.depth + 1e-2) << k;
    EXPECT_LT(norm(nearest_on_triangle(found.place, a[0], a[1], a[2]).point - found.place), 1e-9);
    EXPECT_LT(norm(nearest_on_triangle(found.place, b[0], b[1], b[2]).point - found.place), 1e-9);
  }
  EXPECT_GT(crossing, 50);
}

}  // namespace
}  // namespace test_pierced_mesh
