#include "scene/descriptor.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "math/pose_algebra.hpp"
#include "scene/mesh_descriptor.hpp"
#include "shape/bounds.hpp"

namespace cmb {

namespace {

constexpr std::string_view format_tag = "cmb/1";
constexpr double orthonormal_tolerance = 1e-6;

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

Shape parse_shape(const Token &part, GeometryFiles &files) {
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
  shape.is_moved = !is_identity(shape.in_body);
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
    shape.polytope = std::make_shared<const ContactPolytope>(convex::Polytope::box({size[0], size[1], size[2]}));
  } else if (kind.text == "hull") {
    parse_hull(keys, files, shape);
  } else if (kind.text == "mesh") {
    parse_mesh(keys, files, shape);
  } else if (kind.text == "heightfield") {
    parse_height_field(keys, files, shape);
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
                                           "cylinder, cone, mesh or heightfield");
  }
  keys.check_all_used();
  if (shape.kind == ShapeKind::hull) {
    shape.bound_center = shape.polytope->geometry().center();
    for (const Vec3 &vertex : shape.polytope->geometry().vertices()) {
      shape.bound_radius = std::fmax(shape.bound_radius, norm(vertex - shape.bound_center));
    }
  } else if (shape.kind == ShapeKind::mesh) {
    shape.bound_center = shape.mesh->bound_center();
    shape.bound_radius = shape.mesh->bound_radius();
  } else if (shape.kind != ShapeKind::halfspace) {
    shape.bound_radius = convex::core_radius(shape.body) + shape.body.radius;
  }
  if (shape.kind != ShapeKind::halfspace) shape.bounds = local_bounds(shape);
  return shape;
}

}  // namespace

BodyShapes parse_descriptor(std::string_view text, GeometryFiles &files) {
  if (text.size() > DescriptorLimits::characters) {
    throw DescriptorError(1, "the descriptor has " + std::to_string(text.size()) + " characters; at most " +
                                 std::to_string(DescriptorLimits::characters) + " are accepted: simplify the geometry");
  }
  // It would cut messages and names of files short.
  const std::size_t zero = text.find('\0');
  if (zero != std::string_view::npos) {
    throw DescriptorError(zero + 1, "a character of code 0; descriptors are text: remove it");
  }
  BodyShapes shapes;
  if (std::all_of(text.begin(), text.end(), is_blank)) return shapes;
  std::size_t begin = 0;
  for (;;) {
    const std::size_t end = find_unquoted(text, ';', begin);
    if (shapes.size() == DescriptorLimits::shapes) {
      throw DescriptorError(begin + 1, "the descriptor has more than " + std::to_string(DescriptorLimits::shapes) +
                                           " shapes; split it into several bodies");
    }
    shapes.push_back(parse_shape({text.substr(begin, end - begin), begin + 1}, files));
    if (end == text.size()) return shapes;
    begin = end + 1;
  }
}

BodyShapes parse_descriptor(std::string_view text) {
  GeometryFiles none;
  return parse_descriptor(text, none);
}

}  // namespace cmb
