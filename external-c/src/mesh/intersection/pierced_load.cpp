#include "mesh/intersection/pierced_load.hpp"

#include <cmath>

#include "mesh/intersection/interior_points.hpp"

namespace cmb::mesh {

void PiercedLoad::add(const TriangleSection &section, const Vec3 &normal, double below, double area) {
  const double depth = section.depth, ratio = below > depth ? depth / below : 1.0;
  const double count = ratio * ratio * ratio * ratio * std::fmin(area, depth * depth);
  count_ += count;
  depths_ += depth;
  sums_.add(count * depth, count * depth * depth, (count * depth) * (section.place - depth * normal - center_), normal);
  if (!(depth > deepest_.depth)) return;
  deepest_ = section;
  deepest_normal_ = normal;
}

void PiercedLoad::finish(double part, const Pose &pose, ContactSet &result, double share) const {
  if (!(count_ > 0.0) || !(part > 0.0)) return;
  for (std::size_t direction = 0; direction < DirectionSums::directions; ++direction) {
    ContactPoint point;
    if (!sums_.point(direction, center_, share * part / count_, point)) continue;
    point.normal = pose.rotation * point.normal;
    point.position = pose(point.position);
    result.points.push_back(point);
  }
  const double depth = part * deepest_.depth;
  if (!(-depth < result.distance)) return;
  result.distance = -depth;
  result.normal = pose.rotation * deepest_normal_;
  result.witness = pose(deepest_.place - (0.5 * depth) * deepest_normal_);
}

double limit_load(double limit, std::size_t begin, ContactSet &result) {
  const double load = total_load(result.points, begin);
  if (load <= limit) return load;
  const double part = limit / load;
  result.distance *= part;
  for (std::size_t k = begin; k < result.points.size(); ++k) result.points[k].weight *= part;
  if (!(limit > 0.0)) result.points.resize(begin);
  return limit;
}

namespace {

// What a sheet carries of a body is at most this times the deepest section, of slender ones more.
constexpr double most_sections = 64.0;

// Calls act(corners, normal, how far the body reaches behind the plane, how far before it) for the triangles that may reach into
// the body, whose box is `box`, until `stop`.
template <typename Act>
void visit_sections(const SectionedBody &body, const Bounds &box, const TriangleMesh &mesh, const bool &stop, Act &&act) {
  const auto reach = [&](const Vec3 &d) { return body.reach(d); };
  mesh.visit_touched(box, [&] { return stop; }, reach, [&](std::uint32_t t) {
    const Vec3 corner[3] = {mesh.corner(t, 0), mesh.corner(t, 1), mesh.corner(t, 2)};
    if (stop || distance2(bounds_of(corner), box) > 0.0) return;
    const Vec3 &normal = mesh.face_normal(t);
    const double offset = dot(normal, corner[0]), below = body.reach(-normal) + offset;
    if (!(below > 0.0)) return;
    const double above = body.reach(normal) - offset;
    if (!(above > 0.0)) return;
    act(corner, normal, below, above);
  });
}

}  // namespace

double limit_by_sections(const SectionedBody &body, double radius, const TriangleMesh &mesh, std::size_t begin, ContactSet &result) {
  // The tip of a needle is this much deeper than its section, and a disc on its border.
  const double slender = std::sqrt(std::fmax(1.0, radius * radius * radius / body.volume()));
  const double most = slender * most_sections, enough = total_load(result.points, begin) / most;
  if (!(enough > 0.0)) return 0.0;
  double deepest = 0.0;
  bool found = false;
  visit_sections(body, body.bounds(), mesh, found, [&](const Vec3 (&corner)[3], const Vec3 &, double below, double above) {
    if (std::fmin(below, above) <= deepest) return;
    deepest = std::fmax(deepest, std::fmin(body.section(corner, deepest).depth, std::fmin(below, above)));
    found = deepest > enough;
  });
  return limit_load(most * deepest, begin, result);
}

bool complete_contact(const SectionedBody &body, const TriangleMesh &mesh, const Pose &pose, const CarriedLoad &carried,
                      ContactSet &result) {
  const double load = carried.load;
  if (!(load > 0.0)) result.distance = 0.0;
  const Vec3 center = body.center();
  const Bounds box = body.bounds();
  const double enough = carried.enough();
  const InteriorPoint middle(mesh, center);
  if (load > 0.0 && middle.depth() <= enough) {
    bool lacks = false;
    visit_sections(body, box, mesh, lacks, [&](const Vec3 (&corner)[3], const Vec3 &, double, double) {
      lacks = body.section(corner, enough).depth > 0.0;
    });
    if (!lacks) return true;
  }
  PiercedLoad pierced(center);
  bool never = false;
  visit_sections(body, box, mesh, never, [&](const Vec3 (&corner)[3], const Vec3 &normal, double below, double above) {
    TriangleSection section = body.section(corner);
    if (!(section.depth > 0.0)) return;
    // Of a body, no more is behind a triangle than behind its plane, nor is the translation back longer than what is before it.
    section.depth = std::fmin(section.depth, std::fmin(below, above));
    pierced.add(section, normal, below, 0.5 * norm(cross(corner[1] - corner[0], corner[2] - corner[0])));
  });
  const double deepest = std::fmax(pierced.deepest(), middle.depth());
  const double part = lacking_part(carried.counted(deepest), deepest);
  pierced.finish(part, pose, result);
  middle.push_out(pierced.deepest(), part, pose, result);
  return load > 0.0 || result.distance < 0.0;
}

}  // namespace cmb::mesh
