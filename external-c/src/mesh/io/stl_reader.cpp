// STL: triangles with their corners' coordinates, as text or as records of 50 bytes.
#include <cmath>

#include "mesh/io/byte_reader.hpp"
#include "mesh/io/mesh_file.hpp"
#include "mesh/io/text_scanner.hpp"

namespace cmb::mesh {

namespace {

constexpr std::size_t header_size = 80, record_size = 50;

void add_corner(MeshData &data, const Vec3 &p) {
  const auto number = static_cast<std::uint32_t>(data.vertices.size());
  if (number % 3 == 0) data.triangles.push_back({number, number + 1, number + 2});
  data.vertices.push_back(p);
}

MeshData read_binary(std::string_view contents, const std::string &source) {
  ByteReader bytes(contents, false);
  bytes.skip(header_size);
  const auto count = bytes.read<std::uint32_t>();
  if (bytes.left() < count * record_size) {
    throw MeshError(source, "cut short: room for " + std::to_string(bytes.left() / record_size) + " of " +
                                std::to_string(count) + " triangles",
                    "export or copy it again");
  }
  if (count > MeshLimits::triangles) {
    throw MeshError(source, std::to_string(count) + " triangles, more than the " +
                                std::to_string(MeshLimits::triangles) + " allowed",
                    "export with a coarser tolerance");
  }
  MeshData data;
  data.triangles.reserve(count);
  data.vertices.reserve(3 * std::size_t{count});
  for (std::uint32_t t = 0; t < count; ++t) {
    bytes.skip(12);  // the normal, which the corners tell better
    for (int k = 0; k < 3; ++k) {
      const double x = bytes.read<float>(), y = bytes.read<float>(), z = bytes.read<float>();
      if (!is_finite(Vec3{x, y, z})) {
        throw MeshError(source, "triangle " + std::to_string(t + 1) + " has a coordinate that is not a finite number",
                        "the file is damaged: export it again");
      }
      add_corner(data, {x, y, z});
    }
    bytes.skip(2);
  }
  return data;
}

MeshData read_ascii(std::string_view contents, const std::string &source) {
  TextScanner text(contents, source);
  constexpr const char *damaged = "the file is damaged: export it again";
  const auto expect = [&](std::string_view wanted) {
    const std::string_view found = text.word_of_any_line();
    if (found.empty()) text.fail("cut short: '" + std::string(wanted) + "' is missing", "export or copy it again");
    if (found != wanted) text.fail("'" + std::string(wanted) + "' is missing", damaged);
  };
  MeshData data;
  // Several solids in a file are one mesh; names may be of several words.
  while (text.word_of_any_line() == "solid") {
    text.next_line();
    for (;;) {
      const std::string_view word = text.word_of_any_line();
      if (word == "endsolid") break;
      if (word.empty()) text.fail("cut short: 'endsolid' is missing", "export or copy it again");
      if (word != "facet") text.fail("'facet' or 'endsolid' is missing", damaged);
      if (data.triangles.size() >= MeshLimits::triangles) {
        text.fail("more than " + std::to_string(MeshLimits::triangles) + " triangles", "export with a coarser tolerance");
      }
      // The normal, which the corners tell better, may be anything.
      text.next_line();
      expect("outer");
      expect("loop");
      for (int k = 0; k < 3; ++k) {
        expect("vertex");
        Vec3 p;
        for (int axis = 0; axis < 3; ++axis) p.set(axis, text.number(text.word_of_any_line()));
        add_corner(data, p);
      }
      expect("endloop");
      expect("endfacet");
    }
    text.next_line();
  }
  if (data.triangles.empty()) text.fail("no triangles", "export the body's surface as triangles");
  return data;
}

bool begins_as_text(std::string_view contents) {
  const std::size_t begin = contents.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && contents.substr(begin, 5) == "solid";
}

// Binary files may begin with "solid" too: the size tells.
bool is_binary(std::string_view contents) {
  if (contents.size() < header_size + 4) return false;
  ByteReader bytes(contents, false);
  bytes.skip(header_size);
  const auto count = bytes.read<std::uint32_t>();
  if (bytes.left() == count * record_size) return true;
  return !begins_as_text(contents) || contents.find('\0') != std::string_view::npos;
}

}  // namespace

MeshData read_stl(std::string_view contents, const std::string &source) {
  if (is_binary(contents)) return read_binary(contents, source);
  if (!begins_as_text(contents)) {
    throw MeshError(source, "neither binary nor ASCII STL", "check that the file is complete and of that format");
  }
  return read_ascii(contents, source);
}

}  // namespace cmb::mesh
