#include "manifold/line_manifold.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "manifold/rod_end_share.hpp"
#include "math/index.hpp"
#include "shape/plane_section.hpp"

namespace cmb {

namespace {

// Faces whose normals have no greater cosine to the contact normal than this are walls.
constexpr double wall_cosine = 1e-9;

using Station = LineManifoldScratch::Station;

constexpr double rounding = 1e-13;
// A polytope is thin at a line where it is thinner than this part of the depth.
constexpr double sharp_part = 0.1;
// Of so many faces all are looked at.
constexpr std::size_t few_faces = 48;

using Slope = LineManifoldScratch::Slope;

const Slope &lowest(const std::vector<Slope> &roofs, double along) {
  return *std::min_element(roofs.begin(), roofs.end(),
                           [along](const Slope &x, const Slope &y) { return x.at(along) < y.at(along); });
}

const Slope &highest(const std::vector<Slope> &floors, double along) {
  return *std::max_element(floors.begin(), floors.end(),
                           [along](const Slope &x, const Slope &y) { return x.at(along) < y.at(along); });
}

// From a place where no floor may be below the roofs, forward (sense +1) or backward (-1) to where one is, but not
// beyond `last`: Newton's method, for the room between is a concave function.
// Room to `slack` (m) counts.
double enter(double along, double sense, double last, double slack, const std::vector<Slope> &roofs,
             const std::vector<Slope> &floors) {
  if (roofs.empty() || floors.empty()) return along;
  for (std::size_t step = 0; step <= roofs.size() + floors.size() && sense * (last - along) > 0.0; ++step) {
    const Slope &roof = lowest(roofs, along), &floor = highest(floors, along);
    const double room = roof.at(along) - floor.at(along), growth = sense * (floor.rate - roof.rate);
    if (room >= -slack) return along;
    if (!(growth > 0.0)) return last;
    along -= sense * room / growth;
  }
  return sense * (last - along) > 0.0 ? along : last;
}

// `along` is counted from `origin`.
void add_station(double along, double depth, const Vec3 &origin, const Vec3 &step, const Vec3 &normal,
                 std::vector<Station> &stations) {
  stations.push_back({along, depth, normal, origin + along * step + (0.5 * depth) * normal});
}

// The corners of the lowest roof from `begin` to `end`.
void trace_roofs(const Vec3 &origin, const Vec3 &step, const Vec3 &normal, double begin, double end,
                 const std::vector<Slope> &roofs, std::vector<Station> &stations) {
  stations.clear();
  double along = begin;
  const Slope *roof = &lowest(roofs, along);
  add_station(along, roof->at(along), origin, step, normal, stations);
  while (along < end) {
    const Slope *next = nullptr;
    double meeting = end;
    for (const Slope &other : roofs) {
      if (!(other.rate > roof->rate)) continue;
      const double here = std::max(along, (other.height - roof->height) / (other.rate - roof->rate));
      if (here < meeting || (here == meeting && next != nullptr && other.rate > next->rate)) meeting = here, next = &other;
    }
    along = meeting;
    add_station(along, roof->at(along), origin, step, normal, stations);
    if (next == nullptr) return;
    roof = next;
  }
}

// The centre of the part of the depth's graph above `level`; `otherwise` where it has no area.
double center_above(double level, double otherwise, const std::vector<Station> &stations) {
  double area = 0.0, moment = 0.0;
  for (std::size_t i = 0; i + 1 < stations.size(); ++i) {
    double t0 = stations[i].along, t1 = stations[i + 1].along, d0 = stations[i].depth - level, d1 = stations[i + 1].depth - level;
    if (!(d0 > 0.0) && !(d1 > 0.0)) continue;
    if (d0 < 0.0) t0 = t1 - (t1 - t0) * d1 / (d1 - d0), d0 = 0.0;
    if (d1 < 0.0) t1 = t0 + (t1 - t0) * d0 / (d0 - d1), d1 = 0.0;
    const double length = t1 - t0;
    area += 0.5 * length * (d0 + d1);
    moment += length * (t0 * (2.0 * d0 + d1) + t1 * (d0 + 2.0 * d1)) / 6.0;
  }
  return area > 0.0 ? moment / area : otherwise;
}

// Weights of the stations, which are in order, and their points.
void add_points(const ContactLine &line, double sense, const std::vector<Station> &stations,
                std::vector<ContactPoint> &points) {
  double shallower = 1.0;  // share of the inclinations under which a station further on is the deepest
  double load = 0.0, missing = 0.0;
  const double length = norm(line.step()), spacing = station_spacing * line.half();
  const std::size_t first_point = points.size();
  for (std::size_t i = 0; i < stations.size(); ++i) {
    // Between two stations the depth rises with the sine of the inclination at which both would be equally deep.
    double further = 0.0;
    if (i + 1 < stations.size()) {
      const double apart = stations[i + 1].along - stations[i].along;
      const double rise = stations[i + 1].depth - stations[i].depth;
      // Neither carries, and the depth being concave, one further on that does has a lesser share beyond it.
      if (stations[i].depth <= 0.0 && stations[i + 1].depth <= 0.0) continue;
      if (apart <= spacing && std::fabs(rise) <= spacing) continue;  // the next one stands for both
      const double sine = apart > 0.0 ? std::clamp(rise / (length * apart), -1.0, 1.0) : std::copysign(1.0, rise);
      further = std::min(shallower, 0.5 * (1.0 + end_share_difference(sine)));
      const double here = std::max(stations[i].depth, 0.0), next = std::max(stations[i + 1].depth, 0.0);
      missing += 0.25 * end_share_slope(sine) * (next * next - here * here);
    }
    const double weight = shallower - further;
    shallower = further;
    if (stations[i].depth > 0.0 && weight > 0.0) {
      points.push_back({stations[i].depth, weight, sense * stations[i].normal, stations[i].position});
      load += weight * stations[i].depth;
    }
  }
  if (!(load > 0.0)) return;
  // Shares that change with the inclination alone ask for a torque; a shift along the line supplies it.
  const Vec3 direction = (1.0 / length) * line.step();
  for (std::size_t i = first_point; i < points.size(); ++i) {
    const Vec3 tangential = direction - dot(direction, points[i].normal) * points[i].normal;
    points[i].position = points[i].position + (missing / load) * tangential;
  }
}

}  // namespace

ContactLine::ContactLine(const Shape &shape, const Pose &pose, const Vec3 &towards) {
  const Vec3 axis = pose.rotation.column(2);
  half_ = shape.body.half.z;
  if (shape.kind == ShapeKind::capsule) {
    radius_ = shape.body.radius;
    middle_ = pose.translation + radius_ * towards;
    step_ = axis;
    per_step2_ = 1.0 / norm2(step_);
    return;
  }
  radius_ = shape.body.half.x;
  const Vec3 outward = normalized(towards - dot(towards, axis) * axis, pose.rotation.column(0));
  if (shape.kind == ShapeKind::cone) {
    middle_ = pose.translation + (0.5 * radius_) * outward;
    step_ = axis - (0.5 * radius_ / half_) * outward;
    radius_ *= 0.5;
  } else {
    middle_ = pose.translation + radius_ * outward;
    step_ = axis;
  }
  per_step2_ = 1.0 / norm2(step_);
}

double ContactLine::place(const Vec3 &p) const {
  return std::clamp(per_step2_ * dot(p - middle_, step_), -half_, half_);
}

double way_sine(const Shape &shape) {
  if (shape.kind != ShapeKind::cone) return flat_sine;
  return std::min(flat_sine, 2.0 * shape.body.half.z / convex::cone_slant(shape.body.half));
}

double line_part(const Shape &shape, const Vec3 &towards, Vec3 &gradient) {
  gradient = {};
  if (shape.kind == ShapeKind::capsule) return 1.0;
  double sine = towards.z;  // of the side's inclination
  Vec3 sine_gradient{0, 0, 1};
  if (shape.kind == ShapeKind::cone) {
    const double height = 2.0 * shape.body.half.z, radius = shape.body.half.x, slant = convex::cone_slant(shape.body.half);
    const double across = std::sqrt(towards.x * towards.x + towards.y * towards.y);
    sine = (height * towards.z - radius * across) / slant;
    if (across > 0.0) {
      sine_gradient = (1.0 / slant) * Vec3{-radius * towards.x / across, -radius * towards.y / across, height};
    }
  } else if (shape.kind != ShapeKind::cylinder) {
    return 0.0;
  }
  const double limit = way_sine(shape), inclination = std::fabs(sine) / limit;
  gradient = (std::copysign(1.0, sine) * falling_smoothstep_slope(inclination) / limit) * sine_gradient;
  return falling_smoothstep(inclination);
}

void line_on_polytope(const ContactLine &line, const convex::Polytope &other, const Pose &other_pose, const Vec3 &deepest,
                      double depth, const Vec3 &normal, double sense, LineManifoldScratch &scratch,
                      std::vector<ContactPoint> &points) {
  // All is counted from the deepest place, which is known to lie `depth` below the polytope's surface: there, the steepest
  // of faces make no error.
  const double place = line.place(deepest);
  const Vec3 origin = line(place), step = line.step();
  const Vec3 up = transposed_times(other_pose.rotation, normal);
  const Vec3 above = transposed_times(other_pose.rotation, origin + depth * normal - other_pose.translation);
  const Vec3 ahead = transposed_times(other_pose.rotation, step);
  std::vector<Slope> &roofs = scratch.roofs, &floors = scratch.floors;
  roofs.clear(), floors.clear();
  // The stretch over the polytope: what goes in through its lower side along the normal comes out through the upper.
  double begin = -line.half() - place, end = line.half() - place;
  const auto bound = [&](const convex::Polytope::Face &face) {
    const double cosine = dot(face.normal, up), rate = dot(face.normal, ahead);
    const double inside = std::max(0.0, face.offset - dot(face.normal, above));
    if (cosine > wall_cosine) {
      roofs.push_back({depth + inside / cosine, rate / cosine});
    } else if (cosine < -wall_cosine) {
      floors.push_back({depth + inside / cosine, rate / cosine});
    } else if (rate > 0.0) {
      end = std::min(end, inside / rate);
    } else if (rate < 0.0) {
      begin = std::max(begin, inside / rate);
    }
  };
  // Of many faces only those count that the plane of the line and the normal cuts.
  std::vector<std::int32_t> &cut = scratch.faces;
  cut.clear();
  const Vec3 across = cross(up, ahead);
  const double width = norm(across);
  if (other.faces().size() > few_faces && width > 1e-6 * norm(ahead) &&
      convex::append_section_faces(other, above, (1.0 / width) * across, up, cut)) {
    for (const std::int32_t face : cut) bound(other.faces()[index(face)]);
  } else {
    for (const convex::Polytope::Face &face : other.faces()) bound(face);
  }
  const double slack = rounding * (other.radius() + line.half());
  begin = enter(begin, 1.0, 0.0, slack, roofs, floors);
  end = enter(end, -1.0, 0.0, slack, roofs, floors);
  trace_roofs(origin, step, normal, begin, end, roofs, scratch.stations);
  // Where the line leaves the polytope's shadow along a sharp edge, the stretch shrinks about its deepest part before it
  // vanishes.
  double greatest = 0.0;
  for (const Station &station : scratch.stations) greatest = std::max(greatest, station.depth);
  const double along = center_above(0.0, 0.0, scratch.stations);
  if (!floors.empty() && greatest > 0.0) {
    const double room = lowest(roofs, along).at(along) - highest(floors, along).at(along);
    const double part = std::clamp(room / (sharp_part * greatest), 0.0, 1.0);
    if (part < 1.0) {
      // Of a stretch that is short beside its depth, where sides may be steep, no more than its length below the deepest.
      const double below = std::min(part * greatest, (end - begin) * norm(step));
      const double center = center_above(greatest - below, 0.0, scratch.stations);
      begin = center + part * (begin - center);
      end = center + part * (end - center);
      trace_roofs(origin, step, normal, begin, end, roofs, scratch.stations);
    }
  }
  add_points(line, sense, scratch.stations, points);
}

void line_on_disc(const ContactLine &line, const Vec3 &center, const Vec3 &axis, double radius, const Vec3 &deepest,
                  const Vec3 &normal, double sense, LineManifoldScratch &scratch, std::vector<ContactPoint> &points) {
  // Height of the disc's plane above the line, and the line's shadow on it from the disc's middle.
  const double cosine = dot(axis, normal);
  const Slope plane{dot(axis, center - line(0.0)) / cosine, dot(axis, line.step()) / cosine};
  const Vec3 from = line(0.0) + plane.height * normal - center, along = line.step() - plane.rate * normal;
  const double aa = norm2(along), ab = dot(along, from), bb = norm2(from) - radius * radius;
  const double place = line.place(deepest), middle = -ab / aa, chord = std::sqrt(std::max(0.0, ab * ab - aa * bb)) / aa;
  const double begin = std::min(place, std::max(-line.half(), middle - chord));
  const double end = std::max(place, std::min(line.half(), middle + chord));
  scratch.stations.clear();
  add_station(begin, plane.at(begin), line(0.0), line.step(), normal, scratch.stations);
  add_station(end, plane.at(end), line(0.0), line.step(), normal, scratch.stations);
  add_points(line, sense, scratch.stations, points);
}

void line_on_line(const ContactLine &line, const ContactLine &other, const Vec3 &deepest, const Vec3 &normal, double sense,
                  LineManifoldScratch &scratch, std::vector<ContactPoint> &points) {
  const Vec3 inward = line.radius() * normal, other_inward = -other.radius() * normal;
  const double reach = line.radius() + other.radius();
  // Feet are those of the middles of the spheres.
  const Vec3 between = other_inward - inward;
  double places[5] = {-line.half(), line.place(deepest), line.place(other(-other.half()) + between),
                      line.place(other(other.half()) + between), line.half()};
  // In order: those between the ends.
  if (places[2] < places[1]) std::swap(places[1], places[2]);
  if (places[3] < places[2]) std::swap(places[2], places[3]);
  if (places[2] < places[1]) std::swap(places[1], places[2]);
  scratch.stations.clear();
  for (int k = 0; k < 5; ++k) {
    const double along = places[k];
    if (k > 0 && along == places[k - 1]) continue;  // many feet are at the ends
    const Vec3 center = line(along) + inward;
    const Vec3 apart = center - (other(other.place(center - other_inward)) + other_inward);
    const double distance = norm(apart), depth = reach - distance;
    Station &station = scratch.stations.emplace_back();
    station.along = along;
    station.depth = depth;
    if (!(depth > 0.0)) continue;  // has a say in the others' shares alone
    station.normal = distance > 0.0 ? (1.0 / distance) * apart : normal;
    station.position = center - (line.radius() - 0.5 * depth) * station.normal;
  }
  add_points(line, sense, scratch.stations, points);
}

}  // namespace cmb
