#include "manifold/axis_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/axis_share.hpp"

namespace cmb {

namespace {

using Station = AxisManifoldScratch::Station;

// Stations nearer than this, relative to the axis' length, count as one.
constexpr double station_spacing = 1e-7;
// Faces put stations where the axis passes their borders: fully where their normal's cosine with the contact normal
// is at least the second of these, not at all below the first.
constexpr double faded_cosine = 0.5, supporting_cosine = 0.8;
// Nor where the axis passes over less of the face than this part of its own length.
constexpr double passed_part = 0.01;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Sine of the inclination at which a cylinder or cone no longer lies on its side.
constexpr double lying_sine = 0.25;

// The axis in world axes, and the radii of spheres about its ends that reach as far along the contact normal as the body.
struct Axis {
  Vec3 middle, direction;
  double half = 0.0;
  double lower_radius, upper_radius;
  Vec3 aside;  // from such a sphere's contact to the body's line below it, in its radii

  Axis(const Shape &shape, const Pose &pose, const Vec3 &normal)
      : middle(pose.translation), direction(pose.rotation.column(2)), half(shape.body.half.z) {
    const Vec3 outward = normal - dot(normal, direction) * direction;
    const double across = norm(outward);
    if (shape.kind != ShapeKind::capsule && across > 0.0) {
      aside = (-1.0 / (across * across)) * outward + normal;
    }
    lower_radius = shape.kind == ShapeKind::capsule ? shape.body.radius : shape.body.half.x * across;
    upper_radius = shape.kind == ShapeKind::cone ? 0.0 : lower_radius;
  }
  double radius(double along) const {
    return lower_radius + (0.5 + 0.5 * along / half) * (upper_radius - lower_radius);
  }
  double place(const Vec3 &p) const { return std::clamp(dot(p - middle, direction), -half, half); }
  Vec3 operator()(double along) const { return middle + along * direction; }
};

void add_station(double along, std::vector<Station> &stations) {
  Station station;
  station.along = along;
  stations.push_back(station);
}

// Stations where the axis, seen along `normal`, passes the borders of the faces it lies above. Where a face is about to
// lose its say its stations drift to the axis' ends, so that none appears or vanishes elsewhere.
void add_face_borders(const Axis &axis, const ContactPolytope &body, const Pose &pose, const Vec3 &normal,
                      std::vector<Station> &stations) {
  const convex::Polytope &geometry = body.geometry();
  const Vec3 local_normal = transposed_times(pose.rotation, normal);
  const Vec3 middle = transposed_times(pose.rotation, axis.middle - pose.translation);
  const Vec3 direction = transposed_times(pose.rotation, axis.direction);
  for (const convex::Polytope::Face &face : geometry.faces()) {
    const double cosine = dot(face.normal, local_normal);
    if (cosine <= faded_cosine) continue;
    double begin = -axis.half, end = axis.half;
    for (std::int32_t k = 0; k < face.count && begin < end; ++k) {
      const Vec3 &from = geometry.vertices()[index(geometry.face_vertices()[index(face.first + k)])];
      const Vec3 &to = geometry.vertices()[index(geometry.face_vertices()[index(face.first + (k + 1) % face.count)])];
      const Vec3 outward = cross(to - from, face.normal);
      const double rate = dot(outward, direction), height = dot(outward, middle - from);
      if (rate > 0.0) end = std::min(end, -height / rate);
      if (rate < 0.0) begin = std::max(begin, -height / rate);
      if (rate == 0.0 && height > 0.0) end = begin;
    }
    if (begin < end) {
      // A narrow stretch may vanish, unless it does so into an end of the axis, where there is a station anyway.
      const double narrow = axis.half * passed_part, width = std::min(1.0, 0.5 * (end - begin) / narrow);
      const double within = std::min(1.0, std::min(begin + axis.half, axis.half - end) / narrow);
      const double say = std::min(1.0, (cosine - faded_cosine) / (supporting_cosine - faded_cosine)) *
                         (1.0 - within * (1.0 - width));
      add_station(-axis.half + say * (begin + axis.half), stations);
      add_station(axis.half - say * (axis.half - end), stations);
    }
  }
}

// Stations next to the body's vertices, for axes along edges: beside vertices that lie up to half the capsule's radius
// below the body's top, and drifting to both of the axis' ends up to the whole radius.
void add_vertices(const Axis &axis, double radius, const ContactPolytope &body, const Pose &pose, const Vec3 &normal,
                  std::vector<Station> &stations) {
  const std::vector<Vec3> &vertices = body.geometry().vertices();
  const Vec3 up = transposed_times(pose.rotation, normal);
  const double top = dot(up, vertices[index(body.geometry().support_vertex(up))]);
  for (const Vec3 &vertex : vertices) {
    const double say = std::min(1.0, 2.0 * (1.0 - (top - dot(up, vertex)) / radius));
    if (!(say > 0.0)) continue;
    const double place = axis.place(pose(vertex));
    add_station(-axis.half + say * (place + axis.half), stations);
    if (say < 1.0) add_station(axis.half - say * (axis.half - place), stations);
  }
}

}  // namespace

double line_part(const Shape &shape, const Vec3 &towards, Vec3 &gradient) {
  gradient = {};
  if (shape.kind == ShapeKind::capsule) return 1.0;
  double sine = towards.z;  // of the side's inclination
  Vec3 sine_gradient{0, 0, 1};
  if (shape.kind == ShapeKind::cone) {
    const double height = 2.0 * shape.body.half.z, radius = shape.body.half.x, slant = std::hypot(height, radius);
    const double across = std::hypot(towards.x, towards.y);
    sine = (height * towards.z - radius * across) / slant;
    if (across > 0.0) {
      sine_gradient = (1.0 / slant) * Vec3{-radius * towards.x / across, -radius * towards.y / across, height};
    }
  } else if (shape.kind != ShapeKind::cylinder) {
    return 0.0;
  }
  const double inclination = std::fabs(sine) / lying_sine;
  gradient = (std::copysign(1.0, sine) * faded_slope(inclination) / lying_sine) * sine_gradient;
  return faded(inclination);
}

void line_contact(const Shape &shape, const Pose &pose, const Shape &other, const Pose &other_pose, const Vec3 &deepest,
                  const Vec3 &normal, double sense, AxisManifoldScratch &scratch, std::vector<ContactPoint> &points) {
  const Axis axis(shape, pose, normal);
  std::vector<Station> &stations = scratch.stations;
  stations.clear();
  add_station(-axis.half, stations);
  add_station(axis.half, stations);
  add_station(axis.place(deepest), stations);
  const ContactPolytope *bounded = other.polytope ? other.polytope.get() : other.rim.get();
  if (other.kind == ShapeKind::capsule) {
    const Axis other_axis(other, other_pose, normal);
    add_station(axis.place(other_axis(-other_axis.half)), stations);
    add_station(axis.place(other_axis(other_axis.half)), stations);
  } else if (bounded != nullptr) {
    add_face_borders(axis, *bounded, other_pose, normal, stations);
    add_vertices(axis, std::max(axis.lower_radius, axis.upper_radius), *bounded, other_pose, normal, stations);
  }
  std::sort(stations.begin(), stations.end(), [](const Station &x, const Station &y) { return x.along < y.along; });
  const double spacing = station_spacing * axis.half;
  stations.erase(std::unique(stations.begin(), stations.end(),
                             [&](const Station &x, const Station &y) { return y.along - x.along <= spacing; }),
                 stations.end());

  Shape sphere;
  sphere.kind = ShapeKind::sphere;
  for (Station &station : stations) {
    sphere.body = convex::make_sphere(axis.radius(station.along));
    sphere.bound_radius = sphere.body.radius;
    const ConvexAnswer answer =
        *exact_distance(sphere, {{}, axis(station.along)}, other, other_pose, scratch.backend);
    station.depth = -answer.distance;
    station.normal = sense * answer.normal;
    station.position = 0.5 * (answer.point_a + answer.point_b) + axis.radius(station.along) * axis.aside;
  }
  // Between two stations the depth rises with the sine of the inclination at which both would be equally deep.
  double shallower = 1.0;  // share of the inclinations under which a station further on is the deepest
  double load = 0.0, missing = 0.0;
  const std::size_t first_point = points.size();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    double further = 0.0;
    if (i + 1 < stations.size()) {
      const double sine = std::clamp((stations[i + 1].depth - stations[i].depth) /
                                         (stations[i + 1].along - stations[i].along),
                                     -1.0, 1.0);
      further = std::min(shallower, 0.5 * (1.0 + end_share_difference(sine)));
      const double here = std::fmax(stations[i].depth, 0.0), next = std::fmax(stations[i + 1].depth, 0.0);
      missing += 0.25 * end_share_slope(sine) * (next * next - here * here);
    }
    const double weight = shallower - further;
    shallower = further;
    if (stations[i].depth > 0.0 && weight > 0.0) {
      points.push_back({stations[i].depth, weight, stations[i].normal, stations[i].position});
      load += weight * stations[i].depth;
    }
  }
  if (!(load > 0.0)) return;
  // Shares that change with the inclination alone ask for a torque; a shift along the axis supplies it.
  for (std::size_t i = first_point; i < points.size(); ++i) {
    const Vec3 tangential = axis.direction - dot(axis.direction, points[i].normal) * points[i].normal;
    points[i].position = points[i].position + (missing / load) * tangential;
  }
}

}  // namespace cmb
