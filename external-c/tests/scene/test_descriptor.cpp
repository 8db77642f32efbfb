// Descriptor strings: what is accepted, and what is said of the rest.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "contact_multibody.h"
#include "contact_multibody_modelica.h"
#include "scene/descriptor.hpp"
#include "support/engine_calls.hpp"
#include "support/modelica_format_error.hpp"

namespace test_descriptor {
namespace {

using cmb::parse_descriptor;
using cmb::ShapeKind;

TEST(Descriptor, EveryKindParses) {
  const auto shapes = parse_descriptor(
      "cmb/1 halfspace;cmb/1 sphere radius=1e-1 ;  cmb/1 box size=1,+2,3.5 position=0,0,-1;"
      "cmb/1 capsule length=2 radius=0.5;cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,0,0,1;"
      "cmb/1 ellipsoid size=1,2,3;cmb/1 cylinder radius=1 length=2;cmb/1 cone radius=1 length=2");
  ASSERT_EQ(shapes.size(), 8u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::halfspace);
  EXPECT_EQ(shapes[1].body.radius, 0.1);
  EXPECT_EQ(shapes[2].body.half.z, 1.75);
  EXPECT_EQ(shapes[2].in_body.translation.z, -1.0);
  EXPECT_EQ(shapes[3].body.half.z, 1.0);
  EXPECT_EQ(shapes[4].polytope->geometry().vertices().size(), 4u);
}

TEST(Descriptor, BlankMeansNoShape) {
  EXPECT_TRUE(parse_descriptor("").empty());
  EXPECT_TRUE(parse_descriptor("  \t ").empty());
}

TEST(Descriptor, HullMergesFacesAndLeavesOutDuplicates) {
  std::string text = "cmb/1 hull vertices=";
  for (int copy = 0; copy < 3; ++copy) {
    for (int v = 0; v < 8; ++v) {
      text += std::string(v & 1 ? "1," : "-1,") + (v & 2 ? "1," : "-1,") + (v & 4 ? "1," : "-1,");
    }
  }
  text += "0,0,1,0,0,0,1,0,0,0.5,1,1";  // on a face, inside, on a face, on an edge
  const auto shapes = parse_descriptor(text);
  EXPECT_EQ(shapes[0].polytope->geometry().vertices().size(), 8u);
  EXPECT_EQ(shapes[0].polytope->geometry().faces().size(), 6u);
}

struct BadDescriptor {
  const char *text;
  std::size_t column;
  const char *part_of_message;
};

void PrintTo(const BadDescriptor &bad, std::ostream *stream) { *stream << bad.text; }

class Malformed : public testing::TestWithParam<BadDescriptor> {};

TEST_P(Malformed, IsRefusedWithColumnAndRemedy) {
  try {
    parse_descriptor(GetParam().text);
    FAIL() << "accepted";
  } catch (const cmb::DescriptorError &error) {
    EXPECT_EQ(error.column(), GetParam().column);
    EXPECT_NE(std::string(error.what()).find(GetParam().part_of_message), std::string::npos) << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, Malformed,
    testing::Values(
        BadDescriptor{"sphere radius=1", 1, "'cmb/1'"}, BadDescriptor{"cmb/2 sphere radius=1", 1, "'cmb/1'"},
        BadDescriptor{"cmb/1", 6, "kind of shape is missing"}, BadDescriptor{"cmb/1 torus radius=1", 7, "unknown"},
        BadDescriptor{"cmb/1 sphere", 7, "lacks the key 'radius'"},
        BadDescriptor{"cmb/1 sphere radius=", 21, "number is missing"},
        BadDescriptor{"cmb/1 sphere radius=0", 21, "greater than 0"},
        BadDescriptor{"cmb/1 sphere radius=-1", 21, "greater than 0"},
        BadDescriptor{"cmb/1 sphere radius=nan", 21, "not finite"},
        BadDescriptor{"cmb/1 sphere radius=inf", 21, "not finite"},
        BadDescriptor{"cmb/1 sphere radius=1e999", 21, "out of range"},
        BadDescriptor{"cmb/1 sphere radius=1e-12", 21, "between"},
        BadDescriptor{"cmb/1 sphere radius=1e12", 21, "between"},
        BadDescriptor{"cmb/1 sphere radius=1,2", 21, "give 1"},
        BadDescriptor{"cmb/1 sphere radius=1x", 21, "not a number"},
        BadDescriptor{"cmb/1 sphere radius=+-1", 21, "not a number"},
        BadDescriptor{"cmb/1 sphere radius=+", 21, "number is missing"},
        BadDescriptor{"cmb/1 sphere radius=1 radius=2", 23, "twice"},
        BadDescriptor{"cmb/1 sphere radius=1 colour=2", 23, "no key 'colour'"},
        BadDescriptor{"cmb/1 sphere radius", 14, "key=numbers"},
        BadDescriptor{"cmb/1 sphere =1", 14, "key=numbers"},
        BadDescriptor{"cmb/1 box size=1,2", 16, "give 3"}, BadDescriptor{"cmb/1 box size=1,,2", 18, "missing"},
        BadDescriptor{"cmb/1 box size=1,2,0", 20, "greater than 0"},
        BadDescriptor{"cmb/1 halfspace;", 17, "missing between"},
        BadDescriptor{"cmb/1 halfspace; ;cmb/1 halfspace", 17, "missing between"},
        BadDescriptor{"cmb/1 halfspace position=1,2", 26, "give 3"},
        BadDescriptor{"cmb/1 halfspace position=1,2,1e10", 30, "within 1e9"},
        BadDescriptor{"cmb/1 halfspace rotation=1,0,0,0,1,0,0,0,2", 26, "not orthonormal"},
        BadDescriptor{"cmb/1 halfspace rotation=1,0,0,0,1,0,0,0,-1", 26, "reflection"},
        BadDescriptor{"cmb/1 hull vertices=0,0,0,1,0,0,0,1,0", 21, "at least 4"},
        BadDescriptor{"cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,1", 21, "three a point"},
        BadDescriptor{"cmb/1 hull vertices=0,0,0,1,0,0,0,1,0,1,1,0", 21, "do not lie in a plane"},
        BadDescriptor{"cmb/1 hull vertices=0,0,0,0,0,0,0,0,0,0,0,0", 21, "do not lie in a plane"}));

TEST(Descriptor, SizeIsLimited) {
  EXPECT_THROW(parse_descriptor(std::string(cmb::DescriptorLimits::characters + 1, ' ')), cmb::DescriptorError);
  std::string many = "cmb/1 halfspace";
  for (std::size_t i = 0; i < cmb::DescriptorLimits::shapes; ++i) many += ";cmb/1 halfspace";
  EXPECT_THROW(parse_descriptor(many), cmb::DescriptorError);
  std::string points = "cmb/1 hull vertices=0,0,0";
  for (std::size_t i = 0; i < cmb::DescriptorLimits::hull_points; ++i) points += ",0,0,1";
  EXPECT_THROW(parse_descriptor(points), cmb::DescriptorError);
}

TEST(Descriptor, CharactersOfCodeZeroAreRefused) {
  using namespace std::string_literals;
  for (const std::string &text : {"cmb/1 mesh file=\"\0 part.obj\""s, "cmb/1 sphere rad\0us=1"s, "\0"s, "cmb/1 box\0"s}) {
    try {
      parse_descriptor(text);
      FAIL() << "accepted";
    } catch (const cmb::DescriptorError &error) {
      EXPECT_EQ(error.column(), text.find('\0') + 1);
      EXPECT_NE(std::string(error.what()).find("code 0"), std::string::npos);
    }
  }
}

TEST(Intern, SameArgumentsGiveTheSameHandle) {
  const char *one[] = {"cmb/1 sphere radius=0.11", "cmb/1 halfspace"};
  const char *other[] = {"cmb/1 sphere radius=0.12", "cmb/1 halfspace"};
  const int pairs[] = {1, 2};
  cmb_scene first{}, again{}, different{}, other_backend{};
  ASSERT_EQ(cmb::test::intern_scene(one, 2, pairs, 1, CMB_BACKEND_AUTO, &first), CMB_OK);
  ASSERT_EQ(cmb::test::intern_scene(one, 2, pairs, 1, CMB_BACKEND_AUTO, &again), CMB_OK);
  ASSERT_EQ(cmb::test::intern_scene(other, 2, pairs, 1, CMB_BACKEND_AUTO, &different), CMB_OK);
  ASSERT_EQ(cmb::test::intern_scene(one, 2, pairs, 1, CMB_BACKEND_ANALYTIC, &other_backend), CMB_OK);
  EXPECT_GT(first.number, 0);
  EXPECT_EQ(first, again);
  EXPECT_NE(first, different);
  EXPECT_NE(first, other_backend);
}

TEST(Intern, ErrorsNameDescriptorAndColumnAndLeaveTheHandleAlone) {
  const char *geometry[] = {"cmb/1 halfspace", "cmb/1 sphere radius=-2"};
  const int pairs[] = {1, 2};
  cmb_scene scene{77};
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_DESCRIPTOR);
  EXPECT_EQ(scene.number, 77);
  EXPECT_STREQ(cmb_last_error(), "descriptor 2, column 21: radius is -2; it has to be greater than 0");
}

TEST(Intern, RefusesWrongArguments) {
  const char *geometry[] = {"cmb/1 halfspace", nullptr};
  const int pairs[] = {1, 2};
  const int same[] = {1, 1};
  const int unknown[] = {1, 3};
  cmb_scene scene{};
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_ARGUMENT);
  geometry[1] = "";
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, same, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, unknown, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, nullptr, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb::test::intern_scene(nullptr, 2, pairs, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, nullptr), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, pairs, 1, static_cast<cmb_backend>(9), &scene), CMB_ERROR_ARGUMENT);
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, nullptr, 0, CMB_BACKEND_AUTO, &scene), CMB_OK);
  EXPECT_EQ(cmb::test::intern_scene(nullptr, 0, nullptr, 0, CMB_BACKEND_AUTO, &scene), CMB_OK);
}

TEST(Modelica, ErrorsGoToModelicaFormatError) {
  const char *geometry[] = {"cmb/1 sphere radius=0"};
  try {
    cmb_modelica_intern(geometry, 1, nullptr, 0, 0);
    FAIL() << "accepted";
  } catch (const ModelicaError &error) {
    EXPECT_STREQ(error.what(),
                 "ContactMultiBody: wrong descriptor: descriptor 1, column 21: radius is 0; it has to be greater than 0\n");
  }
}

TEST(Modelica, QueriesAsTheEngineDoes) {
  const char *geometry[] = {"cmb/1 sphere radius=0.5", "cmb/1 halfspace"};
  const int pairs[] = {1, 2};
  const int scene = cmb_modelica_intern(geometry, 2, pairs, 1, 0);
  const double position[] = {0, 0, 0.4, 0, 0, 0};
  double rotation[18] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  double distance, depth, weight, normal[3], point[3];
  cmb_modelica_query_within(scene, HUGE_VAL, position, 2, rotation, 1, 1, &distance, &depth, &weight, normal, point);
  EXPECT_NEAR(depth, 0.1, 1e-15);
  rotation[0] = 2.0;
  EXPECT_THROW(
      cmb_modelica_query_within(scene, HUGE_VAL, position, 2, rotation, 1, 1, &distance, &depth, &weight, normal, point),
      ModelicaError);
}

}  // namespace
}  // namespace test_descriptor
