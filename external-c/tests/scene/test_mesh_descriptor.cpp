// Descriptors of meshes, height fields and hulls from files: what is accepted, and what is said of the rest.
#include <gtest/gtest.h>

#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "contact_multibody.h"
#include "mesh/core/triangle_mesh.hpp"
#include "support/engine_calls.hpp"
#include "scene/descriptor.hpp"
#include "support/scene_query.hpp"
#include "support/scratch_folder.hpp"

namespace test_mesh_descriptor {
namespace {

using cmb::parse_descriptor;
using cmb::ShapeKind;
using cmb::test::PairScene;

const std::string tetrahedron = "vertices=0,0,0,1,0,0,0,1,0,0,0,1 triangles=1,3,2,1,2,4,1,4,3,2,3,4";

class MeshFiles : public testing::Test {
 protected:
  MeshFiles() {
    std::filesystem::create_directories(path("inside"));
    write("tetrahedron.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  }

  std::string path(const std::string &name) const { return folder_.path(name); }
  void write(const std::string &name, const std::string &contents) const { folder_.write(name, contents); }
  cmb::BodyShapes parse(const std::string &text) const {
    cmb::GeometryFiles files(folder_.path());
    return parse_descriptor(text, files);
  }
  // What is said of a descriptor; empty where it is accepted.
  std::string complaint(const std::string &text, std::size_t column = 0) const {
    try {
      parse(text);
    } catch (const cmb::DescriptorError &error) {
      EXPECT_EQ(column > 0 ? error.column() : 0, column) << text;
      return error.what();
    }
    return "";
  }
  void refuses(const std::string &text, std::size_t column, const std::string &part) const {
    const std::string said = complaint(text, column);
    EXPECT_NE(said.find(part), std::string::npos) << text << "\nsays: " << said;
    EXPECT_NE(said.find(';'), std::string::npos) << "no remedy: " << said;
  }

 private:
  cmb::test::ScratchFolder folder_{"cmb_mesh_descriptor"};
};

TEST_F(MeshFiles, KindsParse) {
  write("two rows.csv", "# heights\n0, 1, 2\n\n3, 4, 5\n");
  const auto shapes = parse("cmb/1 mesh " + tetrahedron + ";cmb/1 mesh file=tetrahedron.obj scale=2;" +
                            "cmb/1 hull file=tetrahedron.obj position=1,0,0;" +
                            "cmb/1 heightfield size=2,1 grid=3,2 heights=0,0,0,1,1,1;" +
                            "cmb/1 heightfield size=2,1 file=\"two rows.csv\" scale=0.1");
  ASSERT_EQ(shapes.size(), 5u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::hull);  // closed and convex
  EXPECT_NEAR(shapes[0].mesh->mass_properties().volume, 1.0 / 6.0, 1e-15);
  EXPECT_NEAR(shapes[1].mesh->mass_properties().volume, 8.0 / 6.0, 1e-14);
  EXPECT_EQ(shapes[2].polytope->geometry().vertices().size(), 4u);
  EXPECT_EQ(shapes[3].kind, ShapeKind::mesh);
  EXPECT_FALSE(shapes[3].mesh->closed());
  EXPECT_EQ(shapes[3].mesh->vertices()[5].z, 1.0);
  EXPECT_EQ(shapes[3].mesh->vertices()[5].x, 1.0);
  EXPECT_EQ(shapes[3].mesh->vertices()[5].y, 0.5);
  EXPECT_NEAR(shapes[4].mesh->vertices()[5].z, 0.5, 1e-15);
}

TEST_F(MeshFiles, OneFileIsReadOnce) {
  cmb::GeometryFiles files(path(""));
  const auto one = parse_descriptor("cmb/1 mesh file=tetrahedron.obj", files);
  const auto two = parse_descriptor("cmb/1 mesh file=./inside/../tetrahedron.obj;cmb/1 mesh file=tetrahedron.obj scale=3", files);
  EXPECT_EQ(one[0].mesh, two[0].mesh);
  EXPECT_NE(one[0].mesh, two[1].mesh);
  EXPECT_EQ(one[0].polytope, two[0].polytope);
}

TEST_F(MeshFiles, NoFileOutsideOfTheFolderIsRead) {
  EXPECT_THROW(parse_descriptor("cmb/1 mesh file=" + path("tetrahedron.obj")), cmb::DescriptorError);
  refuses("cmb/1 mesh file=../tetrahedron.obj", 17, "outside");
  refuses("cmb/1 mesh file=inside/../../tetrahedron.obj", 17, "outside");
  refuses("cmb/1 mesh file=/etc/hostname.stl", 17, "outside");
  std::filesystem::create_symlink("/etc", path("link"));
  refuses("cmb/1 mesh file=link/hostname.stl", 17, "outside");
  EXPECT_EQ(complaint("cmb/1 mesh file=" + path("tetrahedron.obj")), "");
  cmb::GeometryFiles inner(path("inside"));
  EXPECT_THROW(parse_descriptor("cmb/1 mesh file=" + path("tetrahedron.obj"), inner), cmb::DescriptorError);
}

TEST_F(MeshFiles, BadTextIsRefusedWithColumnAndRemedy) {
  refuses("cmb/1 mesh", 7, "lacks its geometry");
  refuses("cmb/1 mesh file=", 17, "empty");
  refuses("cmb/1 mesh file=\"a b.stl", 17, "not closed");
  refuses("cmb/1 mesh file=\"a\"b\"", 17, "not closed");
  refuses("cmb/1 mesh file=none.stl", 17, "no such file");
  refuses("cmb/1 mesh file=inside", 17, ".stl, .obj or .ply");
  refuses("cmb/1 mesh file=tetrahedron.obj scale=0", 39, "greater than 0");
  refuses("cmb/1 mesh file=tetrahedron.obj vertices=0,0,0", 33, "no key 'vertices'");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0", 7, "triangles");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1 triangles=1,2,3", 21, "three a point");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2", 49, "three vertices a triangle");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2,4", 53, "triangle 1 names vertex 4");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=0,1,2", 49, "triangle 1 names vertex 0");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2,2.5", 53, "2.5");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,nan,1,0 triangles=1,2,3", 33, "not finite");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,1e10,1,0 triangles=1,2,3", 33, "within 1e9");
  refuses("cmb/1 heightfield size=1,1 grid=2,2 heights=0,0,0", 45, "3 heights");
  refuses("cmb/1 heightfield size=1,1 grid=1,2 heights=0,0", 33, "at least 2");
  refuses("cmb/1 heightfield size=1,0 grid=2,2 heights=0,0,0,0", 26, "greater than 0");
  refuses("cmb/1 heightfield size=1,1 heights=0,0,0,0", 7, "'grid'");
  refuses("cmb/1 heightfield size=1,1 grid=2,2 heights=0,0,inf,0", 49, "not finite");
}

TEST_F(MeshFiles, BadGeometryIsRefusedWithItsElement) {
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,2,0,0 triangles=1,2,3", 49, "triangle 1 is degenerate");
  refuses("cmb/1 mesh vertices=0,0,0,0,0,0,0,0,0 triangles=1,2,3", 49, "triangle 1 is degenerate");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2,3,2,3,1", 49, "triangle 2 repeats triangle 1");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0,0,0,1,0,0,-1 triangles=1,2,3,2,1,4,1,2,5", 62, "3 triangles");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0,1,1,0 triangles=1,2,3,2,3,4", 55, "opposite orientation");
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0,0,0,1 triangles=1,2,3,1,4,2,1,3,4,2,4,3", 55, "inside out");
  // Two triangles back to back enclose nothing.
  refuses("cmb/1 mesh vertices=0,0,0,1,0,0,0,1,0 triangles=1,2,3,1,3,2", 49, "triangle 2 repeats triangle 1");
  refuses("cmb/1 hull file=flat.obj", 17, "no such file");
  write("flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n");
  refuses("cmb/1 hull file=flat.obj", 17, "flat.obj");
}

TEST_F(MeshFiles, BadFilesAreRefusedWithFileAndElement) {
  write("half.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\n");
  refuses("cmb/1 mesh file=half.stl", 17, "half.stl");
  write("nan.obj", "v 0 0 0\nv 1 0 0\nv 0 nan 0\nf 1 2 3\n");
  refuses("cmb/1 mesh file=nan.obj", 17, "nan.obj");
  std::filesystem::create_directories(path("folder.stl"));
  refuses("cmb/1 mesh file=folder.stl", 17, "folder.stl: a folder; name a file in it");
  refuses("cmb/1 heightfield size=1,1 file=inside", 33, "inside: a folder; name a file in it");
  ASSERT_EQ(::mkfifo(path("pipe.stl").c_str(), 0600), 0);
  refuses("cmb/1 mesh file=pipe.stl", 17, "pipe.stl: no regular file");
  std::filesystem::create_symlink("/dev/zero", path("endless.obj"));
  cmb::GeometryFiles anywhere("/");
  try {
    parse_descriptor("cmb/1 mesh file=" + path("endless.obj"), anywhere);
    ADD_FAILURE() << "accepted";
  } catch (const cmb::DescriptorError &error) {
    EXPECT_NE(std::string(error.what()).find("zero"), std::string::npos) << error.what();
  }
  try {
    parse_descriptor("cmb/1 heightfield size=1,1 file=/dev/zero", anywhere);
    ADD_FAILURE() << "accepted";
  } catch (const cmb::DescriptorError &error) {
    EXPECT_STREQ(error.what(), "/dev/zero: no regular file; name a file on a disk");
  }
  write("many.stl", std::string(80, ' ') + std::string("\x80\x96\x98\x00", 4));  // claims ten million triangles
  refuses("cmb/1 mesh file=many.stl", 17, "many.stl");
  write("many.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                    "element face 10000000\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  refuses("cmb/1 mesh file=many.ply", 17, "many.ply");
  write("empty.stl", "");
  refuses("cmb/1 mesh file=empty.stl", 17, "empty.stl");
  write("ragged.txt", "0 1 2\n0 1\n");
  refuses("cmb/1 heightfield size=1,1 file=ragged.txt", 33, "line 2");
  write("word.txt", "0 1 2\n0 x 1\n");
  refuses("cmb/1 heightfield size=1,1 file=word.txt", 33, "line 2");
  write("row.txt", "0 1 2\n");
  refuses("cmb/1 heightfield size=1,1 file=row.txt", 33, "2 x 2");
}

// The limits of lengths hold for hulls and meshes as for all other shapes.
TEST_F(MeshFiles, SizesOutOfRangeAreRefused) {
  for (const std::string kind : {"hull", "mesh"}) {
    EXPECT_EQ(complaint("cmb/1 " + kind + " file=tetrahedron.obj scale=1e-9"), "");
    EXPECT_EQ(complaint("cmb/1 " + kind + " file=tetrahedron.obj scale=1e9"), "");
  }
  write("small.obj", "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  write("large.obj", "v 0 0 0\nv 2 0 0\nv 0 2 0\nv 0 0 2\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  for (const std::string kind : {"hull", "mesh"}) {
    refuses("cmb/1 " + kind + " file=small.obj scale=1e-9", 17, "small.obj: all vertices lie within 1e-9 m; check the");
    refuses("cmb/1 " + kind + " file=large.obj scale=1e9", 17, "lies farther than 1e9 m from the origin; check the");
  }
  const std::string tiny = "vertices=0,0,0,1e-10,0,0,0,1e-10,0,0,0,1e-10";
  refuses("cmb/1 hull " + tiny, 21, "vertices: all vertices lie within 1e-9 m");
  refuses("cmb/1 mesh " + tiny + " triangles=1,3,2,1,2,4,1,4,3,2,3,4", 67, "mesh: all vertices lie within 1e-9 m");
  // Of 1e-75 m neither contacts with a box nor with an ellipsoid were numbers.
  refuses("cmb/1 hull vertices=0,0,0,1e-75,0,0,0,1e-75,0,0,0,1e-75", 21, "vertices: all vertices lie within 1e-9 m");
}

// A second body so small in a mesh that what is computed of its triangles' sides vanishes: contacts were no numbers.
TEST_F(MeshFiles, TrianglesWithoutSizeAreRefused) {
  const auto with_second_body = [](const std::string &size) {
    return "cmb/1 mesh vertices=5,0,0,6,0,0,5,1,0,5,0,1,0,0,0," + size + ",0,0,0," + size + ",0,0,0," + size +
           " triangles=1,3,2,1,2,4,1,4,3,2,3,4,5,7,6,5,6,8,5,8,7,6,7,8";
  };
  for (const std::string size : {"1e-13", "1e-40", "1e-70"}) {
    refuses(with_second_body(size), 0, "triangle 5 is degenerate: its corners coincide");
  }
  EXPECT_EQ(complaint(with_second_body("1e-12")), "");
}

// Names may be longer than the text that is kept of an error: what is wrong and what to do are said all the same.
TEST_F(MeshFiles, LongNamesLeaveRoomForProblemAndRemedy) {
  std::string name;
  for (int k = 0; k < 800; ++k) name += "a/";
  const std::string descriptor = "cmb/1 mesh file=" + name + "part.stl";
  const char *geometry[] = {descriptor.c_str()};
  cmb_scene scene{};
  ASSERT_EQ(cmb::test::intern_scene(geometry, 1, nullptr, 0, CMB_BACKEND_AUTO, &scene, path("").c_str()),
            CMB_ERROR_DESCRIPTOR);
  const std::string said = cmb_last_error();
  EXPECT_EQ(said.find("descriptor 1, column 17: "), 0u) << said;
  EXPECT_NE(said.find("part.stl: no such file; check the path"), std::string::npos) << said;
}

// Ten million triangles in a file that is really there: refused by their number, quickly.
TEST_F(MeshFiles, TenMillionTrianglesAreTooMany) {
  constexpr std::uint32_t count = 10'000'000;
  {
    std::ofstream file(path("large.stl"), std::ios::binary);
    file << std::string(80, ' ');
    file.write(reinterpret_cast<const char *>(&count), 4);
  }
  std::filesystem::resize_file(path("large.stl"), 84 + std::uintmax_t{50} * count);  // sparse
  refuses("cmb/1 mesh file=large.stl", 17, "5000000");
}

TEST_F(MeshFiles, InternNamesDescriptorColumnFileAndElement) {
  write("bad.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n");
  const char *geometry[] = {"cmb/1 halfspace", "cmb/1 mesh file=bad.obj"};
  const int pairs[] = {1, 2};
  cmb_scene scene{77};
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene, path("").c_str()),
            CMB_ERROR_DESCRIPTOR);
  EXPECT_EQ(scene.number, 77);
  const std::string said = cmb_last_error();
  EXPECT_EQ(said.find("descriptor 2, column 17: "), 0u) << said;
  EXPECT_NE(said.find("bad.obj: triangle 1 is degenerate"), std::string::npos) << said;
  EXPECT_EQ(cmb::test::intern_scene(geometry, 2, pairs, 1, CMB_BACKEND_AUTO, &scene), CMB_ERROR_DESCRIPTOR);
  EXPECT_NE(std::string(cmb_last_error()).find("no folder"), std::string::npos);
}

TEST_F(MeshFiles, SceneFromFileAnswersAsOneFromNumbers) {
  const char *from_file[] = {"cmb/1 sphere radius=0.2", "cmb/1 mesh file=tetrahedron.obj"};
  const int pairs[] = {1, 2};
  cmb_scene scene{}, again{};
  ASSERT_EQ(cmb::test::intern_scene(from_file, 2, pairs, 1, CMB_BACKEND_AUTO, &scene, path("").c_str()), CMB_OK);
  ASSERT_EQ(cmb::test::intern_scene(from_file, 2, pairs, 1, CMB_BACKEND_AUTO, &again, path("").c_str()), CMB_OK);
  EXPECT_EQ(scene, again);
  const PairScene numbers("cmb/1 sphere radius=0.2", "cmb/1 mesh " + tetrahedron);
  const double position[] = {0.2, 0.3, -0.15, 0, 0, 0};
  const double rotation[] = {1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  double distance, depth[4], weight[4], normal[12], point[12];
  ASSERT_EQ(cmb::test::query_scene(scene, position, rotation, 2, 1, 4, &distance, depth, weight, normal, point), CMB_OK);
  const auto expected = numbers.query({{0.2, 0.3, -0.15}, {}}, {});
  EXPECT_EQ(distance, expected.distance);
  EXPECT_NEAR(distance, -0.05, 1e-15);
  EXPECT_EQ(depth[0], expected.points[0].depth);
}

TEST_F(MeshFiles, ModelicaNamesAreToBeResolvedFirst) {
  refuses("cmb/1 mesh file=modelica://Library/part.stl", 17, "loadResource");
}

TEST_F(MeshFiles, InlinedDescriptorsNeedNoFiles) {
  write("my heights.csv", "0,0.1\n0.2,0.3\n");
  const std::string text = "cmb/1 sphere radius=0.5 ;cmb/1 mesh position=1,2,3 file=tetrahedron.obj scale=0.1;"
                           "cmb/1 hull file=tetrahedron.obj;cmb/1 heightfield size=1,1 file=\"my heights.csv\" scale=2";
  std::size_t length = 0;
  ASSERT_EQ(cmb_inline_files(text.c_str(), path("").c_str(), nullptr, 0, &length), CMB_OK);
  std::string inlined(length, '?');
  ASSERT_EQ(cmb_inline_files(text.c_str(), path("").c_str(), inlined.data(), inlined.size(), &length), CMB_OK);
  inlined.pop_back();
  EXPECT_EQ(inlined.find("cmb/1 sphere radius=0.5 ;"), 0u);
  EXPECT_EQ(inlined.find("file"), std::string::npos);
  const auto with = parse(text), without = parse_descriptor(inlined);
  ASSERT_EQ(without.size(), 4u);
  EXPECT_EQ(without[1].in_body.translation.z, 3.0);
  EXPECT_EQ(without[1].mesh->triangles(), with[1].mesh->triangles());
  for (std::size_t shape : {1u, 3u}) {
    for (std::size_t v = 0; v < 4; ++v) {
      EXPECT_EQ(norm(without[shape].mesh->vertices()[v] - with[shape].mesh->vertices()[v]), 0.0);
    }
  }
  EXPECT_EQ(without[2].polytope->geometry().vertices().size(), 4u);
  EXPECT_EQ(cmb_inline_files("cmb/1 mesh file=none.obj", path("").c_str(), nullptr, 0, &length), CMB_ERROR_DESCRIPTOR);
  EXPECT_EQ(std::string(cmb_last_error()).find("column 17: "), 0u);
  EXPECT_EQ(cmb_inline_files(nullptr, "", nullptr, 0, &length), CMB_ERROR_ARGUMENT);
}

// A descriptor that is as long as may be has no room for what a file holds.
TEST_F(MeshFiles, DescriptorsTooLongWithTheirFilesAreRefusedByName) {
  const std::string begin = "cmb/1 hull file=tetrahedron.obj position=0.", end = ",0,0";
  const std::string text = begin + std::string(cmb::DescriptorLimits::characters - begin.size() - end.size(), '0') + end;
  EXPECT_EQ(complaint(text), "");
  std::size_t length = 77;
  ASSERT_EQ(cmb_inline_files(text.c_str(), path("").c_str(), nullptr, 0, &length), CMB_ERROR_DESCRIPTOR);
  EXPECT_EQ(length, 77u);
  const std::string said = cmb_last_error();
  EXPECT_NE(said.find("tetrahedron.obj"), std::string::npos) << said;
  EXPECT_NE(said.find(std::to_string(cmb::DescriptorLimits::characters)), std::string::npos) << said;
}

// One polygon of as many corners as make one triangle too many.
TEST_F(MeshFiles, PolygonsOfTooManyTrianglesAreRefused) {
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf";
  for (std::size_t k = 0; k < cmb::mesh::MeshLimits::triangles + 3; ++k) text += " 1";
  write("wide.obj", text + "\n");
  refuses("cmb/1 mesh file=wide.obj", 17, "5000000 triangles");
}

}  // namespace
}  // namespace test_mesh_descriptor
