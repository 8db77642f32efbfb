// All kinds of numbers, elements and ends of line that the mesh formats allow, and the limits of each.
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>

#include "mesh/core/height_field.hpp"
#include "support/mesh_refusals.hpp"
#include "support/mesh_samples.hpp"
#include "support/mesh_writers.hpp"

namespace test_mesh_file_kinds {
namespace {

using namespace mesh_refusals;
using namespace mesh_samples;
using namespace mesh_writers;

// One number of a PLY type by its name, as text or bytes.
void put_number(std::string &out, const std::string &type, const std::string &format, int value) {
  const bool big = format == "binary_big_endian";
  if (format == "ascii") {
    out += std::to_string(value) + " ";
  } else if (type == "char" || type == "int8") {
    put(out, static_cast<std::int8_t>(value), big);
  } else if (type == "uchar" || type == "uint8") {
    put(out, static_cast<std::uint8_t>(value), big);
  } else if (type == "short" || type == "int16") {
    put(out, static_cast<std::int16_t>(value), big);
  } else if (type == "ushort" || type == "uint16") {
    put(out, static_cast<std::uint16_t>(value), big);
  } else if (type == "int" || type == "int32") {
    put(out, static_cast<std::int32_t>(value), big);
  } else if (type == "uint" || type == "uint32") {
    put(out, static_cast<std::uint32_t>(value), big);
  } else if (type == "float" || type == "float32") {
    put(out, static_cast<float>(value), big);
  } else {
    put(out, static_cast<double>(value), big);
  }
}

const char *const whole_types[] = {"char", "int8",  "uchar", "uint8",  "short", "int16",
                                   "ushort", "uint16", "int", "int32", "uint",  "uint32"};
const char *const fraction_types[] = {"float", "float32", "double", "float64"};
const char *const formats[] = {"ascii", "binary_little_endian", "binary_big_endian"};

// A tetrahedron with coordinates of one type, corners of another, and an element with a list before the faces.
std::string tetrahedron(const std::string &format, const std::string &coordinate, const std::string &whole,
                        const std::string &end_of_line = "\n") {
  const int vertices[4][3] = {{0, 0, 0}, {3, 0, 0}, {0, 5, 0}, {0, 0, 7}};
  const int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}};
  std::string out;
  for (const std::string &line :
       {std::string("ply"), "format " + format + " 1.0", std::string("obj_info made by hand"), std::string(""),
        std::string("element vertex 4"), "property " + coordinate + " x", "property " + coordinate + " y",
        "property " + coordinate + " z", "property list " + whole + " " + coordinate + " weights",
        std::string("element strip 2"), "property list " + whole + " " + whole + " indices",
        std::string("element face 4"), "property " + coordinate + " quality",
        "property list " + whole + " " + whole + " vertex_index", std::string("end_header")}) {
    out += line + end_of_line;
  }
  const auto number = [&](const std::string &type, int value) { put_number(out, type, format, value); };
  for (const auto &vertex : vertices) {
    for (const int x : vertex) number(coordinate, x);
    number(whole, 2);
    number(coordinate, 9);
    number(coordinate, 9);
  }
  for (int length : {0, 3}) {
    number(whole, length);
    for (int k = 0; k < length; ++k) number(whole, 100 + k);
  }
  for (const auto &face : faces) {
    number(coordinate, 1);
    number(whole, 3);
    for (const int corner : face) number(whole, corner);
  }
  return out;
}

TEST(PlyFile, EveryTypeOfNumberIsRead) {
  for (const char *format : formats) {
    for (const char *whole : whole_types) {
      for (const char *coordinate : fraction_types) {
        const MeshData read = read_ply(tetrahedron(format, coordinate, whole), "a.ply");
        ASSERT_EQ(read.vertices.size(), 4u);
        EXPECT_NEAR(TriangleMesh(read, MeshUse::solid, "a").mass_properties().volume, 3 * 5 * 7 / 6.0, 1e-12)
            << format << ' ' << whole << ' ' << coordinate;
      }
      // Whole numbers are coordinates too.
      const MeshData read = read_ply(tetrahedron(format, whole, whole), "a.ply");
      EXPECT_NEAR(TriangleMesh(read, MeshUse::solid, "a").mass_properties().volume, 3 * 5 * 7 / 6.0, 1e-12);
    }
  }
}

TEST(PlyFile, EveryEndOfLineEndsTheHeader) {
  for (const char *format : formats) {
    for (const char *end : {"\n", "\r\n", "\r"}) {
      EXPECT_EQ(read_ply(tetrahedron(format, "float", "int", end), "a.ply").triangles.size(), 4u) << format;
    }
  }
}

TEST(PlyFile, NumbersThatAreNoneAreRefusedInBytesToo) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::string bytes = tetrahedron("binary_little_endian", "float", "uchar");
  const std::size_t body = bytes.find("end_header\n") + 11;
  std::memcpy(&bytes[body + 4], &nan, 4);
  expect_refusal(read_ply, bytes, "vertex 1: a coordinate that is not a finite number");
  bytes = tetrahedron("binary_little_endian", "double", "char");
  bytes.back() = '\x80';  // corner -128
  expect_refusal(read_ply, bytes, "face 4: a corner that is no vertex");
  bytes.pop_back();
  expect_refusal(read_ply, bytes, "cut short");
}

TEST(PlyFile, HeadersAreLimitedAndComplete) {
  const std::string start = "ply\nformat ascii 1.0\n";
  std::string elements = start, properties = start + "element vertex 1\n";
  for (int i = 0; i < 65; ++i) elements += "element e" + std::to_string(i) + " 0\n";
  for (int i = 0; i < 257; ++i) properties += "property int p" + std::to_string(i) + "\n";
  expect_refusal(read_ply, elements, "too many kinds of elements");
  expect_refusal(read_ply, properties, "too many properties");
  expect_refusal(read_ply, start + "property int x\n", "line 3: a property of no element");
  expect_refusal(read_ply, start + "element vertex 1\nproperty int\n", "a property without a name");
  expect_refusal(read_ply, start + "element vertex 1\nproperty list int\n", "unknown type");
  expect_refusal(read_ply, start + "element vertex\n", "a number is missing");
  expect_refusal(read_ply, start + "element vertex 1", "'end_header' is missing");
  expect_refusal(read_ply, start + "end_header", "no vertices");
  const std::string vertices = "element vertex 1\nproperty int x\nproperty int y\nproperty int z\n";
  expect_refusal(read_ply, start + vertices + "end_header\n0 0 0\n", "no faces with vertex_indices");
  expect_refusal(read_ply,
                 start + vertices + "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n",
                 "no faces");
  expect_refusal(read_ply,
                 start + vertices + "element empty 3\nelement face 0\n"
                                    "property list uchar int vertex_indices\nend_header\n0 0 0\n",
                 "'empty' without properties");
  expect_refusal(read_ply,
                 start + vertices + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n3 0 0",
                 "cut short");
}

TEST(TextFiles, SignsBlanksAndLongWordsAreReadAsWritten) {
  const MeshData read = read_obj("v\t+0\v-0\f0 0.5\nv 1 0 0\n\nv 0 +1e0 0\nvn 0 0 1\nf 1/2/3 +2 3//1\n", "a.obj");
  ASSERT_EQ(read.triangles.size(), 1u);
  EXPECT_EQ(read.vertices[2].y, 1.0);
  expect_refusal(read_obj, "v 0 0 +-1\n", "'+-1' is not a finite number");
  expect_refusal(read_obj, "v 0 0 +\n", "'+' is not a finite number");
  expect_refusal(read_obj, "v 0 0 " + std::string(60, 'x') + "\n", std::string(40, 'x') + "...'");
  expect_refusal(read_obj, "v 0 0 0\nf 1 1 +-1\n", "not a whole number");
}

TEST(StlFile, WordsOutOfPlaceAreNamed) {
  const std::string facet = "facet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n";
  EXPECT_EQ(read_stl(" \n\tsolid\n" + facet + "endsolid", "a.stl").triangles.size(), 1u);
  expect_refusal(read_stl, "solid\nfact normal 0 0 1\n", "'facet' or 'endsolid' is missing");
  expect_refusal(read_stl, "solid\n" + facet, "'endsolid' is missing");
  expect_refusal(read_stl, "solid\nfacet normal 0 0 1\nouter", "'loop' is missing");
  expect_refusal(read_stl, "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0", "a number is missing");
  // 84 bytes and more that begin with "solid", hold no zero and no fitting count: text.
  EXPECT_EQ(read_stl("solid " + std::string(90, 'n') + "\n" + facet + "endsolid\n", "a.stl").triangles.size(), 1u);
}

TEST(HeightField, SizesThatDoNotFitAreRefused) {
  using cmb::mesh::height_field;
  const std::size_t huge = std::numeric_limits<std::size_t>::max();
  const std::vector<double> four(4, 0.0);
  EXPECT_THROW(height_field(1, 2, 1, 1, {0, 0}, "h"), MeshError);
  EXPECT_THROW(height_field(2, 1, 1, 1, {0, 0}, "h"), MeshError);
  EXPECT_THROW(height_field(huge, 2, 1, 1, four, "h"), MeshError);
  EXPECT_THROW(height_field(2, huge, 1, 1, four, "h"), MeshError);
  EXPECT_THROW(height_field(4000, 4000, 1, 1, four, "h"), MeshError);
  EXPECT_THROW(height_field(2, 3, 1, 1, four, "h"), MeshError);
  for (const double bad : {0.0, -1.0, HUGE_VAL, std::nan("")}) {
    EXPECT_THROW(height_field(2, 2, bad, 1, four, "h"), MeshError);
    EXPECT_THROW(height_field(2, 2, 1, bad, four, "h"), MeshError);
    if (bad != 0.0 && bad != -1.0) {
      EXPECT_THROW(height_field(2, 2, 1, 1, {0, 0, bad, 0}, "h"), MeshError);
    }
  }
  EXPECT_EQ(height_field(2, 2, 1, 1, four, "h").triangles.size(), 2u);
}

TEST(MeshFile, FilesTooLargeAreRefusedUnread) {
  const auto path = std::filesystem::temp_directory_path() / ("cmb_too_large_" + std::to_string(::getpid()) + ".stl");
  { std::ofstream file(path); }
  std::filesystem::resize_file(path, (std::uintmax_t{1} << 30) + 1);  // sparse
  try {
    cmb::mesh::read_mesh_file(path.string());
    ADD_FAILURE() << "accepted";
  } catch (const MeshError &error) {
    EXPECT_NE(std::string(error.what()).find("larger than 1 GiB"), std::string::npos) << error.what();
  }
  std::filesystem::remove(path);
}

}  // namespace
}  // namespace test_mesh_file_kinds
