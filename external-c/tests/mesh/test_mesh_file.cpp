// Mesh files: round trips, and refusal of all that is malformed.
#include <gtest/gtest.h>

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "support/mesh_refusals.hpp"
#include "support/mesh_samples.hpp"
#include "support/mesh_writers.hpp"
#include "support/random_bodies.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size);

namespace {

using namespace mesh_refusals;
using namespace mesh_samples;
using namespace mesh_writers;

void expect_same(const MeshData &given, MeshData read, double tolerance = 0.0) {
  ASSERT_EQ(read.triangles.size(), given.triangles.size());
  for (std::size_t t = 0; t < given.triangles.size(); ++t) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 &a = given.vertices[given.triangles[t][k]], &b = read.vertices.at(read.triangles[t][k]);
      ASSERT_LE(norm(a - b), tolerance);
    }
  }
  // Welded, the mesh is closed again.
  cmb::mesh::weld_vertices(read, "read");
  EXPECT_NO_THROW(cmb::mesh::check_mesh(read, MeshUse::solid, "read"));
}

std::string replaced(std::string text, const std::string &from, const std::string &to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(MeshFile, RoundTrips) {
  const MeshData data = sphere_mesh(0.1, 2);
  expect_same(data, read_stl(stl_ascii(data), "a.stl"));
  expect_same(data, read_stl(stl_ascii(data, "\r\n"), "a.stl"));
  expect_same(data, read_stl(stl_ascii(data, "\r"), "a.stl"));
  expect_same(data, read_stl(stl_ascii(data) + stl_ascii({data.vertices, {}}), "a.stl"));
  expect_same(data, read_stl(stl_binary(data, "solid"), "a.stl"), 1e-8);
  expect_same(data, read_stl(stl_binary(data, "CAD"), "a.stl"), 1e-8);
  expect_same(data, read_obj(obj(data), "a.obj"));
  for (const char *format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    expect_same(data, read_ply(ply(data, format), "a.ply"));
  }
}

TEST(MeshFile, ReadsByTheNamesEnding) {
  const MeshData data = box_mesh({1, 2, 3}, 2);
  const auto folder = std::filesystem::temp_directory_path() / ("cmb_mesh_file_" + std::to_string(::getpid()));
  std::filesystem::create_directory(folder);
  const std::pair<const char *, std::string> files[] = {
      {"a.STL", stl_binary(data)}, {"b.obj", obj(data)}, {"c.ply", ply(data, "binary_big_endian")}};
  for (const auto &[name, contents] : files) {
    std::ofstream(folder / name, std::ios::binary) << contents;
    const MeshData read = cmb::mesh::read_mesh_file((folder / name).string());
    EXPECT_EQ(read.vertices.size(), data.vertices.size());
    EXPECT_NEAR(TriangleMesh(read, MeshUse::solid, name).mass_properties().volume, 6.0, 1e-12);
  }
  EXPECT_THROW(cmb::mesh::read_mesh_file((folder / "a.step").string()), MeshError);
  EXPECT_THROW(cmb::mesh::read_mesh_file((folder / "missing.stl").string()), MeshError);
  std::filesystem::create_directory(folder / "folder.stl");
  EXPECT_THROW(cmb::mesh::read_mesh_file((folder / "folder.stl").string()), MeshError);
  std::filesystem::remove_all(folder);
}

TEST(MeshFile, PolygonsBecomeTriangles) {
  const MeshData read = read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf -4 -3 -2 -1\n", "a.obj");
  const std::vector<Triangle> expected{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(read.triangles, expected);
}

TEST(MeshFile, EveryCutIsRefusedOrHarmless) {
  // All formats but OBJ know their length. A cut OBJ has fewer faces, and its surface is open.
  const MeshData data = box_mesh({1, 1, 1});
  const std::pair<Reader, std::string> files[] = {{read_stl, stl_ascii(data)},
                                                  {read_stl, stl_binary(data, "CAD")},
                                                  {read_ply, ply(data, "ascii")},
                                                  {read_ply, ply(data, "binary_little_endian")},
                                                  {read_ply, ply(data, "binary_big_endian")}};
  for (const auto &[read, contents] : files) {
    for (std::size_t length = 0; length + 24 < contents.size(); ++length) refusal(read, contents.substr(0, length));
  }
  const std::string whole = obj(data);
  for (std::size_t length = 0; length + 6 < whole.size(); ++length) {
    try {
      EXPECT_LT(read_obj(whole.substr(0, length), "a.obj").triangles.size(), 12u);
    } catch (const MeshError &) {
    }
  }
}

TEST(MeshFile, MalformedStlIsRefused) {
  const MeshData data = box_mesh({1, 1, 1});
  const std::string ascii = stl_ascii(data);
  expect_refusal(read_stl, "", "neither");
  expect_refusal(read_stl, "PK archive", "neither");
  expect_refusal(read_stl, "solid\nendsolid\n", "no triangles");
  expect_refusal(read_stl, replaced(ascii, "vertex -0.5", "vertex nan"), "line 4: 'nan' is not a finite number");
  expect_refusal(read_stl, replaced(ascii, "vertex -0.5", "vertex 1e999"), "'1e999' is not a finite number");
  expect_refusal(read_stl, replaced(ascii, "vertex -0.5", "vertex x"), "line 4: 'x'");
  expect_refusal(read_stl, replaced(ascii, "outer loop", "inner loop"), "'outer' is missing");
  expect_refusal(read_stl, replaced(ascii, "endloop", "vertex 1 1 1\nendloop"), "'endloop' is missing");
  std::string binary = stl_binary(data, "CAD");
  binary[83] = '\x7f';  // a count of two thousand millions
  expect_refusal(read_stl, binary, "cut short: room for 12 of 2130706444");
  binary = stl_binary(data, "CAD");
  binary[81] = '\x01';
  expect_refusal(read_stl, binary, "cut short: room for 12 of 268");
  MeshData bad = data;
  bad.vertices[0].x = std::nan("");
  expect_refusal(read_stl, stl_binary(bad, "CAD"), "triangle 1 has a coordinate");
}

TEST(MeshFile, MalformedObjIsRefused) {
  const std::string start = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  expect_refusal(read_obj, "", "no faces");
  expect_refusal(read_obj, start, "no faces");
  expect_refusal(read_obj, start + "f 1 2 4\n", "line 4: there is no vertex 4");
  expect_refusal(read_obj, start + "f 0 1 2\n", "no vertex 0");
  expect_refusal(read_obj, start + "f 1 2 -4\n", "no vertex -4");
  expect_refusal(read_obj, start + "f 1 2 99999999999999999999\n", "not a whole number");
  expect_refusal(read_obj, start + "f 1 2\n", "fewer than three corners");
  expect_refusal(read_obj, start + "f 1 2 x\n", "'x' is not a whole number");
  expect_refusal(read_obj, start + "f 1 2 /3\n", "a number is missing");
  expect_refusal(read_obj, "v 0 0\n", "line 1: a number is missing");
  expect_refusal(read_obj, "v 0 0 inf\n", "'inf' is not a finite number");
  expect_refusal(read_obj, std::string("v 0 0 \x01\n"), "'?' is not a finite number");
}

TEST(MeshFile, MalformedPlyIsRefused) {
  const std::string ascii = ply(box_mesh({1, 1, 1}), "ascii");
  const std::string binary = ply(box_mesh({1, 1, 1}), "binary_little_endian");
  expect_refusal(read_ply, "plx\n", "not a PLY file");
  expect_refusal(read_ply, replaced(ascii, "format ascii 1.0\n", ""), "'format' is missing");
  expect_refusal(read_ply, replaced(ascii, "format ascii", "format gzip"), "unknown format");
  expect_refusal(read_ply, replaced(ascii, "property double x", "property quad x"), "unknown type");
  expect_refusal(read_ply, replaced(ascii, "property double x", "property double u"), "no vertices with x, y and z");
  expect_refusal(read_ply, replaced(ascii, "property double y", "property double x"), "comes twice");
  expect_refusal(read_ply, replaced(ascii, "vertex_indices", "edges"), "no faces with vertex_indices");
  expect_refusal(read_ply, replaced(ascii, "face 12", "face 0"), "no faces; export");
  expect_refusal(read_ply, replaced(ascii, "list uchar int", "list uchar float"), "no list of whole numbers");
  expect_refusal(read_ply, replaced(ascii, "list uchar int", "list double int"), "without a whole count");
  expect_refusal(read_ply, replaced(ascii, "list uchar int", "int"), "no list of whole numbers");
  expect_refusal(read_ply, replaced(ascii, "element face", "element vertex"), "comes twice");
  expect_refusal(read_ply, replaced(ascii, "vertex 8", "vertex -8"), "negative number of elements");
  expect_refusal(read_ply, replaced(ascii, "vertex 8", "vertex 8e3"), "not a whole number");
  expect_refusal(read_ply, replaced(ascii, "comment", "remark"), "unknown entry");
  expect_refusal(read_ply, replaced(ascii, "vertex 8", "vertex 14000000"), "no room for 14000000 elements 'vertex'");
  expect_refusal(read_ply, replaced(binary, "vertex 8", "vertex 14000000"), "no room for 14000000");
  expect_refusal(read_ply, replaced(binary, "vertex 8", "vertex 99999999999"), "more than 15000000 vertices");
  expect_refusal(read_ply, replaced(binary, "face 12", "face 9000000000000000000"), "no room for");
  expect_refusal(read_ply, replaced(ascii, "3 0 ", "3 8 "), "names vertex 8 of 8");
  expect_refusal(read_ply, replaced(ascii, "3 0 ", "3 -1 "), "no vertex");
  expect_refusal(read_ply, replaced(ascii, "3 0 ", "2 0 "), "fewer than three corners");
  expect_refusal(read_ply, replaced(ascii, "3 0 ", "-3 0 "), "negative length");
  expect_refusal(read_ply, replaced(ascii, "end_header\n-0.5", "end_header\nnan"), "not a finite number");
}

// The fuzz target: aborts where its properties do not hold.
TEST(MeshFile, DamagedFilesAreRefusedOrHarmless) {
  const MeshData data = box_mesh({1, 1, 1});
  const std::pair<char, std::string> files[] = {{0, stl_ascii(data)},
                                                {0, stl_binary(data, "CAD")},
                                                {1, obj(data)},
                                                {2, ply(data, "ascii")},
                                                {2, ply(data, "binary_little_endian")},
                                                {2, ply(data, "binary_big_endian")}};
  random_bodies::Random random(1);
  for (const auto &[kind, contents] : files) {
    for (int i = 0; i < 4000; ++i) {
      std::string damaged = kind + contents;
      for (int changes = random.integer(1, 4); changes > 0; --changes) {
        const auto at = static_cast<std::size_t>(random.integer(1, static_cast<int>(damaged.size()) - 1));
        switch (random.integer(0, 3)) {
          case 0: damaged[at] = static_cast<char>(random.integer(0, 255)); break;
          case 1: damaged.erase(at, 1); break;
          case 2: damaged.insert(at, 1, "0123456789-+.e \n"[random.integer(0, 15)]); break;
          default: damaged[at] = "0123456789-+.e \n"[random.integer(0, 15)]; break;
        }
      }
      LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t *>(damaged.data()), damaged.size());
    }
  }
}

}  // namespace
