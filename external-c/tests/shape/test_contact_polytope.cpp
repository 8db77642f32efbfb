// What polytopes know of their faces against looking at all of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "scene/descriptor.hpp"
#include "shape/contact_polytope.hpp"
#include "support/random_bodies.hpp"

namespace test_contact_polytope {
namespace {

using namespace cmb;
using random_bodies::Random;

// The hull of points on an ellipsoid.
Shape hull(int points, const Vec3 &half, Random &random) {
  std::string text = "cmb/1 hull vertices=";
  for (int k = 0; k < points; ++k) {
    const Vec3 p = random.direction();
    text += (k > 0 ? "," : "") + std::to_string(half.x * p.x) + "," + std::to_string(half.y * p.y) + "," +
            std::to_string(half.z * p.z);
  }
  return parse_descriptor(text)[0];
}

// Few faces and many, round bodies, plates and rods.
template <typename Check>
void for_hulls(const Check &check) {
  Random random(3);
  for (const int points : {12, 20, 40, 100, 400}) {
    for (const Vec3 &half : {Vec3{1, 1, 1}, Vec3{1, 1, 0.1}, Vec3{0.2, 0.05, 1}}) {
      SCOPED_TRACE(std::to_string(points) + " points, height " + std::to_string(half.z));
      check(*hull(points, half, random).polytope, random);
    }
  }
}

TEST(ContactPolytope, FindsTheFaceNearestToADirection) {
  for_hulls([](const ContactPolytope &polytope, Random &random) {
    for (int sample = 0; sample < 3000; ++sample) {
      const Vec3 direction = random.direction();
      double greatest = -1.0;
      for (const convex::Polytope::Face &face : polytope.geometry().faces()) {
        greatest = std::max(greatest, dot(face.normal, direction));
      }
      ASSERT_NEAR(polytope.greatest_face_cosine(direction), greatest, 1e-14)
          << sample;
    }
  });
}

// Walking from face to face as long as the polar corners lie farther finds the face beyond which a place is by the greatest part.
TEST(ContactPolytope, PolarCornersLeadToTheFaceBeyond) {
  for_hulls([](const ContactPolytope &polytope, Random &random) {
    const convex::Polytope &geometry = polytope.geometry();
    for (int sample = 0; sample < 500; ++sample) {
      const Vec3 place = geometry.center() + random.uniform(0.1, 2.0) * random.direction();
      double greatest = -1.0;
      for (const convex::Polytope::Face &face : geometry.faces()) {
        const double own = face.offset - dot(face.normal, geometry.center());
        greatest = std::max(greatest, dot(face.normal, place - geometry.center()) / own);
      }
      std::size_t best = 0;
      for (bool farther = true; farther;) {
        farther = false;
        const convex::Polytope::Face face = geometry.faces()[best];
        for (std::int32_t k = face.first; k < face.first + face.count; ++k) {
          const auto next = static_cast<std::size_t>(polytope.faces_across()[static_cast<std::size_t>(k)].face);
          if (!(dot(polytope.polar_corners()[next] - polytope.polar_corners()[best], place - geometry.center()) > 0.0)) continue;
          best = next;
          farther = true;
        }
      }
      ASSERT_NEAR(dot(polytope.polar_corners()[best], place - geometry.center()), greatest, 1e-12 * greatest) << sample;
    }
  });
}

TEST(ContactPolytope, KnowsEdgesAndFacesAtAVertexAsSets) {
  for_hulls([](const ContactPolytope &polytope, Random &) {
    const convex::Polytope &geometry = polytope.geometry();
    ASSERT_EQ(polytope.has_sets(), geometry.edges().size() <= ContactPolytope::most_in_set);
    if (!polytope.has_sets()) return;
    for (std::size_t v = 0; v < geometry.vertices().size(); ++v) {
      const auto number = static_cast<std::int32_t>(v);
      std::uint64_t edges = 0, faces = 0;
      for (std::int32_t slot = geometry.neighbour_begin(number); slot < geometry.neighbour_begin(number + 1); ++slot) {
        edges |= std::uint64_t{1} << geometry.neighbour_edges()[static_cast<std::size_t>(slot)];
      }
      for (const std::int32_t *face = polytope.faces_at(number); face != polytope.faces_at(number + 1); ++face) {
        faces |= std::uint64_t{1} << *face;
      }
      EXPECT_EQ(polytope.incidence(number).edges, edges);
      EXPECT_EQ(polytope.incidence(number).faces, faces);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        EXPECT_EQ(polytope.coordinates(axis)[v], geometry.vertices()[v][static_cast<int>(axis)]);
      }
    }
  });
}

// Every face is in one group, and no place is less far below a group's planes than the group's bound says.
TEST(ContactPolytope, GroupsOfFacesHaveBounds) {
  for_hulls([](const ContactPolytope &polytope, Random &random) {
    const std::vector<convex::Polytope::Face> &faces = polytope.geometry().faces();
    const FaceClusters &clusters = polytope.clusters();
    const std::size_t planes = FaceClusters::size * clusters.count();
    const double radius = polytope.geometry().radius();
    std::vector<double> bounds(clusters.count());
    const auto plane = [&](std::size_t k) {
      return convex::Polytope::Face{{clusters.normals(0)[k], clusters.normals(1)[k], clusters.normals(2)[k]}, clusters.offsets()[k]};
    };
    for (const convex::Polytope::Face &face : faces) {
      std::size_t found = 0;
      for (std::size_t k = 0; k < planes; ++k) {
        found += plane(k).offset == face.offset && norm(plane(k).normal - face.normal) == 0.0 ? 1 : 0;
      }
      EXPECT_EQ(found, 1u);
    }
    std::size_t exact = 0, far = 0;
    for (int sample = 0; sample < 300; ++sample) {
      const Vec3 place = random.uniform(0.0, 1.2 * radius) * random.direction();
      clusters.find_bounds(place, bounds.data());
      for (std::size_t g = 0; g < clusters.count(); ++g) {
        double least = HUGE_VAL;
        for (std::size_t k = g * FaceClusters::size; k < (g + 1) * FaceClusters::size; ++k) {
          least = std::min(least, plane(k).offset - dot(plane(k).normal, place));
        }
        ASSERT_LE(bounds[g], least + 1e-14 * radius);
        exact += bounds[g] > least - 0.5 * radius ? 1 : 0;
        far += bounds[g] > 0.1 * radius ? 1 : 0;
      }
    }
    // Bounds that are of use: not far from the truth, and above nothing where there are many groups.
    EXPECT_GT(exact, 30 * clusters.count());
    if (clusters.count() > 20) {
      EXPECT_GT(far, 30u);
    }
  });
}

// Of the faces below whose planes a place is no farther than that none is left out, and their corners lie in the groups' balls.
TEST(ContactPolytope, GroupsOfFacesFindThoseNearAPlace) {
  for_hulls([](const ContactPolytope &polytope, Random &random) {
    const convex::Polytope &geometry = polytope.geometry();
    const FaceClusters &clusters = geometry.clusters();
    std::size_t visited = 0, count = 0;
    for (int sample = 0; sample < 100; ++sample) {
      const Vec3 place = random.uniform(0.0, 1.2 * geometry.radius()) * random.direction();
      const double depth = random.uniform(-0.1, 0.1) * geometry.radius();
      std::vector<int> visits(geometry.faces().size(), 0);
      EXPECT_TRUE(clusters.visit_near(place, depth, [&](std::int32_t f) { return ++visits[static_cast<std::size_t>(f)] == 1; }));
      for (std::size_t f = 0; f < visits.size(); ++f) {
        const convex::Polytope::Face &face = geometry.faces()[f];
        if (face.offset - dot(face.normal, place) <= depth) {
          EXPECT_EQ(visits[f], 1);
        }
        visited += static_cast<std::size_t>(visits[f]), ++count;
      }
    }
    if (clusters.count() > 20) {
      EXPECT_LT(3 * visited, 2 * count);
    }
    for (std::size_t g = 0; g < clusters.count(); ++g) {
      const Vec3 center{clusters.ball_centers(0)[g], clusters.ball_centers(1)[g], clusters.ball_centers(2)[g]};
      for (const std::int32_t f : clusters.faces(g)) {
        const convex::Polytope::Face &face = geometry.faces()[static_cast<std::size_t>(f)];
        for (std::int32_t k = face.first; k < face.first + face.count; ++k) {
          const std::int32_t v = geometry.face_vertices()[static_cast<std::size_t>(k)];
          EXPECT_LE(norm(geometry.vertices()[static_cast<std::size_t>(v)] - center), clusters.ball_radii()[g]);
        }
      }
    }
  });
}

}  // namespace
}  // namespace test_contact_polytope
