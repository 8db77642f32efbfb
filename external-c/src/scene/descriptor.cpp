#include "scene/descriptor.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <optional>
#include <utility>

#include "convex/convex_hull.hpp"

namespace cmb {

namespace {

constexpr std::string_view format_tag = "cmb/1";
constexpr double orthonormal_tolerance = 1e-6;

// A piece of the descriptor and where it begins.
struct Token {
  std::string_view text;
  std::size_t column = 1;
};

std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  return "'" + std::string(text.substr(0, longest)) + (text.size() > longest ? "...'" : "'");
}

std::string shortest(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", value);
  return buffer.data();
}

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }

std::vector<Token> split_blanks(const Token &part) {
  std::vector<Token> tokens;
  std::size_t i = 0;
  while (i < part.text.size()) {
    if (is_blank(part.text[i])) {
      ++i;
      continue;
    }
    std::size_t end = i;
    while (end < part.text.size() && !is_blank(part.text[end])) ++end;
    tokens.push_back({part.text.substr(i, end - i), part.column + i});
    i = end;
  }
  return tokens;
}

struct Number {
  double value;
  std::size_t column;
};

std::vector<Number> parse_numbers(const Token &list) {
  std::vector<Number> numbers;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t comma = std::min(list.text.find(',', begin), list.text.size());
    const std::string_view text = list.text.substr(begin, comma - begin);
    const std::size_t column = list.column + begin;
    const char *first = text.data(), *last = text.data() + text.size();
    if (!text.empty() && *first == '+') ++first;
    double value = 0.0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (first == last) throw DescriptorError(column, "a number is missing; write numbers as 1,2.5,3e-2");
    if (error == std::errc::result_out_of_range) {
      throw DescriptorError(column, quoted(text) + " is out of range; use a value a double can hold");
    }
    if (error != std::errc() || end != last) {
      throw DescriptorError(column, quoted(text) + " is not a number; write numbers as 1,2.5,3e-2, without blanks");
    }
    if (!std::isfinite(value)) throw DescriptorError(column, quoted(text) + " is not finite; give a finite number");
    numbers.push_back({value, column});
    if (comma == list.text.size()) return numbers;
    begin = comma + 1;
  }
}

// The key=numbers part of one shape.
class Keys {
 public:
  Keys(const Token &kind, const std::vector<Token> &tokens) : kind_(kind) {
    for (const Token &token : tokens) {
      const std::size_t equals = token.text.find('=');
      if (equals == std::string_view::npos || equals == 0) {
        throw DescriptorError(token.column, quoted(token.text) + " is not key=numbers; write for example radius=0.1");
      }
      const std::string_view name = token.text.substr(0, equals);
      for (const Entry &entry : entries_) {
        if (entry.name.text == name) throw DescriptorError(token.column, quoted(name) + " is given twice; keep one");
      }
      entries_.push_back({{name, token.column},
                          {token.text.substr(equals + 1), token.column + equals + 1},
                          false});
    }
  }

  // The numbers of a key, or nothing where it is left out.
  std::optional<std::vector<Number>> take(std::string_view name) {
    for (Entry &entry : entries_) {
      if (entry.name.text != name) continue;
      entry.used = true;
      return parse_numbers(entry.numbers);
    }
    return std::nullopt;
  }

  std::vector<Number> require(std::string_view name) {
    auto numbers = take(name);
    if (!numbers) {
      throw DescriptorError(kind_.column, std::string(kind_.text) + " lacks the key " + quoted(name) + "; add " +
                                              std::string(name) + "=...");
    }
    return *numbers;
  }

  // `count` lengths, each positive and within the limits.
  std::vector<double> require_lengths(std::string_view name, std::size_t count) {
    const std::vector<Number> numbers = require(name);
    check_count(name, numbers, count);
    std::vector<double> values;
    for (const Number &number : numbers) {
      if (!(number.value > 0.0)) {
        throw DescriptorError(number.column, std::string(name) + " is " + shortest(number.value) +
                                                 "; it has to be greater than 0");
      }
      if (number.value < DescriptorLimits::smallest_length || number.value > DescriptorLimits::largest_length) {
        throw DescriptorError(number.column, std::string(name) + " is " + shortest(number.value) +
                                                 " m; lengths have to lie between 1e-9 m and 1e9 m");
      }
      values.push_back(number.value);
    }
    return values;
  }

  static void check_count(std::string_view name, const std::vector<Number> &numbers, std::size_t count) {
    if (numbers.size() == count) return;
    throw DescriptorError(numbers.front().column, std::string(name) + " has " + std::to_string(numbers.size()) +
                                                      " numbers; give " + std::to_string(count));
  }

  // Complains of the first key nobody asked for.
  void check_all_used() const {
    for (const Entry &entry : entries_) {
      if (!entry.used) {
        throw DescriptorError(entry.name.column, std::string(kind_.text) + " has no key " + quoted(entry.name.text) +
                                                     "; remove it or correct its spelling");
      }
    }
  }

 private:
  struct Entry {
    Token name;
    Token numbers;
    bool used;
  };
  Token kind_;
  std::vector<Entry> entries_;
};

void check_coordinate(const Number &number, std::string_view name) {
  if (std::fabs(number.value) > DescriptorLimits::largest_length) {
    throw DescriptorError(number.column, std::string(name) + " has the coordinate " + shortest(number.value) +
                                             " m; coordinates have to lie within 1e9 m");
  }
}

Pose parse_pose(Keys &keys) {
  Pose pose;
  if (const auto position = keys.take("position")) {
    Keys::check_count("position", *position, 3);
    for (const Number &number : *position) check_coordinate(number, "position");
    pose.translation = {(*position)[0].value, (*position)[1].value, (*position)[2].value};
  }
  if (const auto rotation = keys.take("rotation")) {
    Keys::check_count("rotation", *rotation, 9);
    Mat3 to_shape;  // Modelica's T: v_shape = T v_body
    for (int i = 0; i < 9; ++i) to_shape.row[i / 3].set(i % 3, (*rotation)[static_cast<std::size_t>(i)].value);
    double deviation = 0.0;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        deviation = std::fmax(deviation, std::fabs(dot(to_shape.row[i], to_shape.row[j]) - (i == j ? 1.0 : 0.0)));
      }
    }
    if (!(deviation <= orthonormal_tolerance)) {
      throw DescriptorError(rotation->front().column,
                            "rotation is not orthonormal (deviation " + shortest(deviation) +
                                "); give a rotation matrix row by row, with 7 digits or more");
    }
    if (dot(cross(to_shape.row[0], to_shape.row[1]), to_shape.row[2]) < 0.0) {
      throw DescriptorError(rotation->front().column, "rotation is a reflection; its determinant has to be +1");
    }
    const Vec3 x = normalized(to_shape.row[0]);
    const Vec3 y = normalized(to_shape.row[1] - dot(to_shape.row[1], x) * x);
    pose.rotation = transposed(Mat3{{x, y, cross(x, y)}});
  }
  return pose;
}

void attach_polytope(Shape &shape, convex::Polytope polytope) {
  shape.polytope = std::make_shared<const ContactPolytope>(std::move(polytope));
}

Shape parse_hull(Shape shape, Keys &keys) {
  const std::vector<Number> numbers = keys.require("vertices");
  if (numbers.size() % 3 != 0) {
    throw DescriptorError(numbers.front().column, "vertices has " + std::to_string(numbers.size()) +
                                                      " numbers; give three a point: x,y,z,x,y,z,...");
  }
  if (numbers.size() / 3 < 4) {
    throw DescriptorError(numbers.front().column, "vertices has " + std::to_string(numbers.size() / 3) +
                                                      " points; a hull needs at least 4 that do not lie in a plane");
  }
  if (numbers.size() / 3 > DescriptorLimits::hull_points) {
    throw DescriptorError(numbers.front().column,
                          "vertices has " + std::to_string(numbers.size() / 3) + " points; at most " +
                              std::to_string(DescriptorLimits::hull_points) + " are accepted: simplify the mesh");
  }
  std::vector<Vec3> points;
  points.reserve(numbers.size() / 3);
  for (std::size_t i = 0; i < numbers.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) check_coordinate(numbers[i + k], "vertices");
    points.push_back({numbers[i].value, numbers[i + 1].value, numbers[i + 2].value});
  }
  convex::Polytope polytope;
  std::string problem;
  if (!convex::build_convex_hull(points, polytope, nullptr, &problem)) {
    throw DescriptorError(numbers.front().column, "vertices: " + problem +
                                                      "; give at least 4 points that do not lie in a plane");
  }
  attach_polytope(shape, std::move(polytope));
  shape.body = convex::make_polytope(shape.polytope->geometry());
  return shape;
}

Shape parse_shape(const Token &part) {
  const std::vector<Token> tokens = split_blanks(part);
  if (tokens.empty()) throw DescriptorError(part.column, "a shape is missing between ';'; remove the ';'");
  if (tokens[0].text != format_tag) {
    throw DescriptorError(tokens[0].column,
                          "a shape begins with " + quoted(tokens[0].text) + "; it has to begin with 'cmb/1'");
  }
  if (tokens.size() < 2) {
    throw DescriptorError(tokens[0].column + tokens[0].text.size(), "the kind of shape is missing after 'cmb/1'");
  }
  const Token kind = tokens[1];
  Keys keys(kind, {tokens.begin() + 2, tokens.end()});
  Shape shape;
  shape.in_body = parse_pose(keys);
  if (kind.text == "halfspace") {
    shape.kind = ShapeKind::halfspace;
  } else if (kind.text == "sphere") {
    shape.kind = ShapeKind::sphere;
    shape.body = convex::make_sphere(keys.require_lengths("radius", 1)[0]);
  } else if (kind.text == "capsule") {
    shape.kind = ShapeKind::capsule;
    shape.body = convex::make_capsule(keys.require_lengths("radius", 1)[0], keys.require_lengths("length", 1)[0]);
  } else if (kind.text == "box") {
    shape.kind = ShapeKind::box;
    const std::vector<double> size = keys.require_lengths("size", 3);
    shape.body = convex::make_box({size[0], size[1], size[2]});
    attach_polytope(shape, convex::Polytope::box({size[0], size[1], size[2]}));
  } else if (kind.text == "hull") {
    shape.kind = ShapeKind::hull;
    shape = parse_hull(shape, keys);
  } else if (kind.text == "ellipsoid") {
    shape.kind = ShapeKind::ellipsoid;
    const std::vector<double> axes = keys.require_lengths("size", 3);
    shape.body = convex::make_ellipsoid({0.5 * axes[0], 0.5 * axes[1], 0.5 * axes[2]});
  } else if (kind.text == "cylinder") {
    shape.kind = ShapeKind::cylinder;
    shape.body = convex::make_cylinder(keys.require_lengths("radius", 1)[0], keys.require_lengths("length", 1)[0]);
  } else if (kind.text == "cone") {
    shape.kind = ShapeKind::cone;
    shape.body = convex::make_cone(keys.require_lengths("radius", 1)[0], keys.require_lengths("length", 1)[0]);
  } else {
    throw DescriptorError(kind.column, "the kind of shape " + quoted(kind.text) +
                                           " is unknown; use halfspace, sphere, box, capsule, hull, ellipsoid, "
                                           "cylinder or cone");
  }
  keys.check_all_used();
  if (shape.kind == ShapeKind::hull) {
    shape.bound_center = shape.polytope->geometry().center();
    for (const Vec3 &vertex : shape.polytope->geometry().vertices()) {
      shape.bound_radius = std::fmax(shape.bound_radius, norm(vertex - shape.bound_center));
    }
  } else if (shape.kind != ShapeKind::halfspace) {
    shape.bound_radius = convex::core_radius(shape.body) + shape.body.radius;
  }
  return shape;
}

}  // namespace

BodyShapes parse_descriptor(std::string_view text) {
  if (text.size() > DescriptorLimits::characters) {
    throw DescriptorError(1, "the descriptor has " + std::to_string(text.size()) + " characters; at most " +
                                 std::to_string(DescriptorLimits::characters) + " are accepted: simplify the geometry");
  }
  BodyShapes shapes;
  if (std::all_of(text.begin(), text.end(), is_blank)) return shapes;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = std::min(text.find(';', begin), text.size());
    if (shapes.size() == DescriptorLimits::shapes) {
      throw DescriptorError(begin + 1, "the descriptor has more than " + std::to_string(DescriptorLimits::shapes) +
                                           " shapes; split it into several bodies");
    }
    shapes.push_back(parse_shape({text.substr(begin, end - begin), begin + 1}));
    if (end == text.size()) return shapes;
    begin = end + 1;
  }
}

}  // namespace cmb
