// PLY: a header that describes the elements, then the elements as text or bytes.
#include <array>
#include <cmath>
#include <optional>

#include "mesh/io/byte_reader.hpp"
#include "mesh/io/mesh_file.hpp"
#include "mesh/io/polygon_reader.hpp"
#include "mesh/io/text_scanner.hpp"

namespace cmb::mesh {

namespace {

constexpr std::size_t most_elements = 64, most_properties = 256;
constexpr const char *damaged = "the file is damaged or no PLY file: export it again";

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::optional<Type> type_of(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Type>, 16> names{{{"char", Type::int8},
                                                                     {"int8", Type::int8},
                                                                     {"uchar", Type::uint8},
                                                                     {"uint8", Type::uint8},
                                                                     {"short", Type::int16},
                                                                     {"int16", Type::int16},
                                                                     {"ushort", Type::uint16},
                                                                     {"uint16", Type::uint16},
                                                                     {"int", Type::int32},
                                                                     {"int32", Type::int32},
                                                                     {"uint", Type::uint32},
                                                                     {"uint32", Type::uint32},
                                                                     {"float", Type::float32},
                                                                     {"float32", Type::float32},
                                                                     {"double", Type::float64},
                                                                     {"float64", Type::float64}}};
  for (const auto &[known, type] : names) {
    if (known == name) return type;
  }
  return std::nullopt;
}

std::size_t size_of(Type type) {
  switch (type) {
    case Type::int8:
    case Type::uint8: return 1;
    case Type::int16:
    case Type::uint16: return 2;
    case Type::float64: return 8;
    default: return 4;
  }
}

enum class Role { other, x, y, z, corners };

struct Property {
  Type type = Type::float32;
  std::optional<Type> count_type;  // of lists
  Role role = Role::other;
};

struct Element {
  std::string name;
  std::size_t count = 0;
  std::vector<Property> properties;
};

enum class Encoding { ascii, little_endian, big_endian };

struct Header {
  Encoding encoding = Encoding::ascii;
  std::vector<Element> elements;
  std::size_t size = 0, lines = 0;
};

Property read_property(TextScanner &text, const Element &element) {
  Property property;
  std::string_view type = text.word();
  if (type == "list") {
    property.count_type = type_of(text.word());
    if (!property.count_type || *property.count_type >= Type::float32) text.fail("a list without a whole count", damaged);
    type = text.word();
  }
  const auto known = type_of(type);
  if (!known) text.fail("a property of unknown type", damaged);
  property.type = *known;
  const std::string_view name = text.word();
  if (name.empty()) text.fail("a property without a name", damaged);
  if (element.name == "vertex" && !property.count_type) {
    property.role = name == "x" ? Role::x : name == "y" ? Role::y : name == "z" ? Role::z : Role::other;
  }
  if (element.name == "face" && (name == "vertex_indices" || name == "vertex_index")) {
    if (!property.count_type || property.type >= Type::float32) text.fail("corners that are no list of whole numbers", damaged);
    property.role = Role::corners;
  }
  for (const Property &other : element.properties) {
    if (property.role != Role::other && other.role == property.role) text.fail("a property that comes twice", damaged);
  }
  return property;
}

Header read_header(std::string_view contents, const std::string &source) {
  TextScanner text(contents, source);
  Header header;
  if (text.word() != "ply") throw MeshError(source, "not a PLY file", "check that the file is complete and of that format");
  bool format_known = false;
  for (;;) {
    if (!text.next_line()) text.fail("cut short: 'end_header' is missing", "export or copy it again");
    const std::string_view word = text.word();
    if (word == "end_header") break;
    if (word == "format") {
      const std::string_view format = text.word();
      format_known = true;
      if (format == "ascii") {
        header.encoding = Encoding::ascii;
      } else if (format == "binary_little_endian") {
        header.encoding = Encoding::little_endian;
      } else if (format == "binary_big_endian") {
        header.encoding = Encoding::big_endian;
      } else {
        text.fail("an unknown format", "export as ascii, binary_little_endian or binary_big_endian");
      }
    } else if (word == "element") {
      if (header.elements.size() >= most_elements) text.fail("too many kinds of elements", damaged);
      Element element;
      element.name = std::string(text.word());
      const std::int64_t count = text.whole_number(text.word());
      if (count < 0) text.fail("a negative number of elements", damaged);
      element.count = static_cast<std::size_t>(count);
      for (const Element &other : header.elements) {
        if (other.name == element.name) text.fail("an element that comes twice", damaged);
      }
      header.elements.push_back(std::move(element));
    } else if (word == "property") {
      if (header.elements.empty()) text.fail("a property of no element", damaged);
      Element &element = header.elements.back();
      if (element.properties.size() >= most_properties) text.fail("too many properties", damaged);
      element.properties.push_back(read_property(text, element));
    } else if (!word.empty() && word != "comment" && word != "obj_info") {
      text.fail("an unknown entry of the header", damaged);
    }
  }
  if (!format_known) text.fail("'format' is missing", damaged);
  header.lines = text.line();
  // One end of line ends the header; what follows may be any bytes.
  text.word();
  const std::size_t end = text.position();
  std::size_t next = contents.find_first_of("\r\n", end);
  if (next == std::string_view::npos) next = contents.size();
  if (next < contents.size()) next += contents[next] == '\r' && next + 1 < contents.size() && contents[next + 1] == '\n' ? 2 : 1;
  header.size = next;
  return header;
}

// Values of the elements, one by one.
class Values {
 public:
  Values(std::string_view body, const Header &header, const std::string &source)
      : source_(source),
        ascii_(header.encoding == Encoding::ascii),
        text_(body, source, header.lines + 1),
        bytes_(body, header.encoding == Encoding::big_endian) {}

  // Throws where the body cannot hold so many elements: counts in the header need not be true.
  void expect(const Element &element) const {
    std::size_t least = 0;
    for (const Property &property : element.properties) {
      least += ascii_ ? 2 : size_of(property.count_type ? *property.count_type : property.type);
    }
    // The last number of a text needs no blank behind it.
    const std::size_t left = (ascii_ ? body_left() + 1 : bytes_.left());
    if (least > 0 && element.count > left / least) cut_short(element);
    if (least == 0 && element.count > 0) throw MeshError(source_, "elements '" + element.name + "' without properties", damaged);
  }

  double number(Type type) {
    if (ascii_) {
      const std::string_view word = text_.word_of_any_line();
      if (word.empty()) cut_short();
      return type >= Type::float32 ? text_.number(word) : static_cast<double>(text_.whole_number(word));
    }
    if (bytes_.left() < size_of(type)) cut_short();
    switch (type) {
      case Type::int8: return bytes_.read<std::int8_t>();
      case Type::uint8: return bytes_.read<std::uint8_t>();
      case Type::int16: return bytes_.read<std::int16_t>();
      case Type::uint16: return bytes_.read<std::uint16_t>();
      case Type::int32: return bytes_.read<std::int32_t>();
      case Type::uint32: return bytes_.read<std::uint32_t>();
      case Type::float32: return bytes_.read<float>();
      case Type::float64: return bytes_.read<double>();
    }
    return 0.0;
  }

 private:
  std::size_t body_left() const { return bytes_.left() - text_.position(); }
  [[noreturn]] void cut_short() const { throw MeshError(source_, "cut short: elements are missing", "export or copy it again"); }
  [[noreturn]] void cut_short(const Element &element) const {
    throw MeshError(source_, "cut short: no room for " + std::to_string(element.count) + " elements '" + element.name + "'",
                    "export or copy it again");
  }

  const std::string &source_;
  bool ascii_;
  TextScanner text_;
  ByteReader bytes_;
};

void read_element(const Element &element, Values &values, const std::string &source, MeshData &data,
                  PolygonReader &polygon) {
  for (std::size_t i = 0; i < element.count; ++i) {
    const auto fail = [&](const std::string &problem, const std::string &remedy) {
      throw MeshError(source, element.name + " " + std::to_string(i + 1) + ": " + problem, remedy);
    };
    Vec3 p;
    for (const Property &property : element.properties) {
      if (!property.count_type) {
        const double value = values.number(property.type);
        if (property.role >= Role::x && property.role <= Role::z) {
          if (!std::isfinite(value)) fail("a coordinate that is not a finite number", damaged);
          p.set(static_cast<int>(property.role) - static_cast<int>(Role::x), value);
        }
        continue;
      }
      const double count = values.number(*property.count_type);
      if (count < 0.0) fail("a list of negative length", damaged);
      const bool corners = property.role == Role::corners;
      if (corners && count < 3.0) fail("fewer than three corners", damaged);
      polygon.begin(i + 1);
      // A length that is not true ends where the file does.
      for (double k = 0.0; k < count; k += 1.0) {
        const double value = values.number(property.type);
        if (!corners) continue;
        if (!(value >= 0.0 && value < static_cast<double>(MeshLimits::vertices))) fail("a corner that is no vertex", damaged);
        if (!polygon.add(static_cast<std::uint32_t>(value))) {
          const auto [problem, remedy] = PolygonReader::limit_reached();
          fail(problem, remedy);
        }
      }
    }
    if (element.name == "vertex") data.vertices.push_back(p);
  }
}

void check_elements(const Header &header, const std::string &source) {
  bool vertices = false, faces = false;
  for (const Element &element : header.elements) {
    unsigned roles = 0;
    for (const Property &property : element.properties) roles |= 1u << static_cast<unsigned>(property.role);
    if (element.name == "vertex") {
      vertices = (roles & 0xeu) == 0xeu;
      if (element.count > MeshLimits::vertices) {
        throw MeshError(source, "more than " + std::to_string(MeshLimits::vertices) + " vertices",
                        "export with a coarser tolerance");
      }
    }
    if (element.name == "face") faces = (roles & 0x10u) != 0u;
  }
  if (!vertices) throw MeshError(source, "no vertices with x, y and z", "export the body's surface as triangles");
  if (!faces) throw MeshError(source, "no faces with vertex_indices", "export the body's surface as triangles");
}

}  // namespace

MeshData read_ply(std::string_view contents, const std::string &source) {
  const Header header = read_header(contents, source);
  check_elements(header, source);
  Values values(contents.substr(header.size), header, source);
  MeshData data;
  PolygonReader polygon(data.triangles);
  for (const Element &element : header.elements) {
    values.expect(element);
    if (element.name == "vertex") data.vertices.reserve(element.count);
    read_element(element, values, source, data, polygon);
  }
  // Faces may come before vertices.
  for (std::size_t t = 0; t < data.triangles.size(); ++t) {
    for (const std::uint32_t v : data.triangles[t]) {
      if (v >= data.vertices.size()) {
        throw MeshError(source, "triangle " + std::to_string(t + 1) + " names vertex " + std::to_string(v) + " of " +
                                    std::to_string(data.vertices.size()) + " (counted from 0)",
                        damaged);
      }
    }
  }
  if (data.triangles.empty()) throw MeshError(source, "no faces", "export the body's surface as triangles");
  polygon.unfold_all(data, [&](std::size_t face) {
    const auto [problem, remedy] = PolygonReader::not_a_polygon();
    throw MeshError(source, "face " + std::to_string(face) + ": " + problem, remedy);
  });
  return data;
}

}  // namespace cmb::mesh
