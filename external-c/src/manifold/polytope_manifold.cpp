#include "manifold/polytope_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "manifold/solid_angle.hpp"
#include "scene/pose_algebra.hpp"

namespace cmb {

namespace {

using Scratch = PolytopeManifoldScratch;

constexpr double pi = 3.14159265358979323846;
// Corners nearer than this, relative to the bodies' size, are one.
constexpr double corner_tolerance = 1e-12;
// Faces at right angles to the contact plane to this cosine are walls.
constexpr double wall_cosine = 1e-9;
// Edges that cross at a smaller angle (its sine) count as parallel: their ends stand for them.
constexpr double parallel_sine = 1e-9;
// Edges count as longer by this fraction of theirs at both ends: where walls stand upright to rounding, upper and
// lower borders cross in their ends.
constexpr double end_fraction = 1e-9;
// The hemisphere of directions is taken as the cone |x| <= s z, |y| <= s z.
constexpr double hemisphere_slope = 1e6;
// Vertices up to this many overlap depths away from the contact plane have a say in the stiffness.
constexpr double anchor_reach = 3.0;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Smaller angles between the mean normal of the overlap's sides and that of the shortest way out come from walls
// that are as low as the overlap is deep, and are suppressed.
constexpr double wall_angle = 15.0 * pi / 180.0;

// The contact plane's axes.
struct PlaneAxes {
  Vec3 up, first, second;
  explicit PlaneAxes(const Vec3 &normal)
      : up(normal), first(convex::any_perpendicular(normal)), second(cross(normal, first)) {}
};

// The mean normal of the overlap's two sides, from B to A, not unit.
Vec3 mean_normal(const convex::OverlapScratch &overlap) {
  Vec3 mean;
  for (const convex::OverlapScratch::Face &face : overlap.faces()) {
    const auto corner = [&](std::int32_t k) {
      return overlap.vertices()[index(overlap.corners()[index(face.first + k)])];
    };
    double area = 0.0;
    for (std::int32_t k = 1; k + 1 < face.count; ++k) {
      area += 0.5 * dot(face.normal, cross(corner(k) - corner(0), corner(k + 1) - corner(0)));
    }
    mean = mean + (face.from_b ? area : -area) * face.normal;
  }
  return mean;
}

// The contact plane's normal: that of the shortest way out, `shortest` (unit), which is a face's where a face rests.
// Where a body slips off the other's border the shortest way turns at once from one face's normal to the next one's;
// the mean normal of the overlap's sides, which turns steadily, leads over.
Vec3 contact_normal(const Vec3 &shortest, const Vec3 &mean) {
  const Vec3 across = mean - dot(mean, shortest) * shortest;
  const double angle = std::atan2(norm(across), dot(mean, shortest));
  if (angle >= wall_angle) return normalized(mean);
  const double ratio = angle / wall_angle, turned = wall_angle * ratio * ratio * ratio;
  return normalized(std::cos(turned) * shortest + std::sin(turned) * normalized(across, {}));
}

void collect_edges(const convex::OverlapScratch &overlap, const Vec3 &up, std::vector<Scratch::Edge> &edges) {
  edges.clear();
  for (const convex::OverlapScratch::Face &face : overlap.faces()) {
    const double cosine = dot(face.normal, up);
    for (std::int32_t k = 0; k < face.count; ++k) {
      const std::int32_t from = overlap.corners()[index(face.first + k)];
      const std::int32_t to = overlap.corners()[index(face.first + (k + 1) % face.count)];
      if (from == to) continue;
      edges.push_back({std::min(from, to), std::max(from, to), cosine < wall_cosine, cosine > -wall_cosine});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Scratch::Edge &a, const Scratch::Edge &b) {
    return a.from != b.from ? a.from < b.from : a.to < b.to;
  });
  std::size_t count = 0;
  for (const Scratch::Edge &edge : edges) {
    if (count > 0 && edges[count - 1].from == edge.from && edges[count - 1].to == edge.to) {
      edges[count - 1].lower = edges[count - 1].lower || edge.lower;
      edges[count - 1].upper = edges[count - 1].upper || edge.upper;
    } else {
      edges[count++] = edge;
    }
  }
  edges.resize(count);
}

// How far a ray from the overlap's point p along the unit vector d runs inside the overlap.
double exit_length(const Vec3 &p, const Vec3 &d, const convex::OverlapScratch &overlap) {
  double length = HUGE_VAL;
  for (const convex::OverlapScratch::Face &face : overlap.faces()) {
    const double rate = dot(face.normal, d);
    if (rate > 1e-14) length = std::min(length, (face.offset - dot(face.normal, p)) / rate);
  }
  return std::isfinite(length) ? std::max(length, 0.0) : 0.0;
}

void collect_corners(const PlaneAxes &axes, double size, Scratch &scratch) {
  const convex::OverlapScratch &overlap = scratch.overlap;
  std::vector<Scratch::Corner> &corners = scratch.corners;
  corners.clear();
  const double near = corner_tolerance * size;
  const auto add = [&](const Vec3 &middle, double depth) {
    const Vec3 lifted{dot(axes.first, middle), dot(axes.second, middle), depth};
    for (const Scratch::Corner &known : corners) {
      const Vec3 off = known.lifted - lifted;
      if (std::fabs(off.x) <= near && std::fabs(off.y) <= near && std::fabs(off.z) <= near) return;
    }
    corners.push_back({lifted, middle});
  };
  for (const Vec3 &p : overlap.vertices()) {
    const double above = exit_length(p, axes.up, overlap), below = exit_length(p, -axes.up, overlap);
    add(p + 0.5 * (above - below) * axes.up, above + below);
  }
  for (const Scratch::Edge &e : scratch.edges) {
    if (!e.lower) continue;
    const Vec3 &e0 = overlap.vertices()[index(e.from)], de = overlap.vertices()[index(e.to)] - e0;
    const double e_length = norm(de);
    for (const Scratch::Edge &f : scratch.edges) {
      if (!f.upper || (e.from == f.from && e.to == f.to)) continue;
      const Vec3 &f0 = overlap.vertices()[index(f.from)], df = overlap.vertices()[index(f.to)] - f0;
      const double area = dot(axes.up, cross(de, df));
      if (std::fabs(area) <= parallel_sine * e_length * norm(df)) continue;
      const Vec3 between = f0 - e0;
      const double t = dot(axes.up, cross(between, df)) / area;
      if (t < -end_fraction || t > 1.0 + end_fraction) continue;
      const double s = dot(axes.up, cross(between, de)) / area;
      if (s < -end_fraction || s > 1.0 + end_fraction) continue;
      const Vec3 on_e = e0 + t * de, on_f = f0 + s * df;
      const double depth = dot(axes.up, on_f - on_e);
      if (depth > 0.0) add(0.5 * (on_e + on_f), depth);
    }
  }
}

// `down` points from the body to the other one, in the body's frame; `to_a` maps its frame to A's.
void collect_anchors(const ContactPolytope &body, const Pose &to_a, const Vec3 &down, const PlaneAxes &axes,
                     double depth, std::vector<Scratch::Anchor> &anchors) {
  const std::vector<Vec3> &vertices = body.geometry().vertices();
  double lowest = -HUGE_VAL;
  for (const Vec3 &v : vertices) lowest = std::max(lowest, dot(down, v));
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const double nearness = 1.0 - (lowest - dot(down, vertices[v])) / (anchor_reach * depth);
    if (!(nearness > 0.0)) continue;
    const auto number = static_cast<std::int32_t>(v);
    const Vec3 p = to_a(vertices[v]);
    anchors.push_back({dot(axes.first, p), dot(axes.second, p), nearness * nearness,
                       2.0 * pi * body.share(number, down) / body.visible_normal_cone(number, down)});
  }
}

// What a corner at (x, y) would carry if its normal cone filled the hemisphere: that of a vertex at the vertex,
// interpolated between them (Shepard).
double stiffness_at(double x, double y, const std::vector<Scratch::Anchor> &anchors, double size) {
  const double smallest = 1e-28 * size * size;
  double sum = 0.0, weighted = 0.0;
  for (const Scratch::Anchor &anchor : anchors) {
    const double dx = x - anchor.x, dy = y - anchor.y;
    const double influence = anchor.influence / (dx * dx + dy * dy + smallest);
    sum += influence;
    weighted += influence * anchor.stiffness;
  }
  return sum > 0.0 ? weighted / sum : 1.0;
}

// The part of the hemisphere of directions in which corner k is the farthest of all.
double hemisphere_part(const std::vector<Scratch::Corner> &corners, std::size_t k, DirectionCone &cone) {
  constexpr double s = hemisphere_slope;
  cone.clear();
  cone.add(normalized(Vec3{s, s, 1.0}));
  cone.add(normalized(Vec3{-s, s, 1.0}));
  cone.add(normalized(Vec3{-s, -s, 1.0}));
  cone.add(normalized(Vec3{s, -s, 1.0}));
  const double whole = cone.solid_angle();
  for (std::size_t j = 0; j < corners.size() && !cone.empty(); ++j) {
    if (j != k) cone.clip(corners[k].lifted - corners[j].lifted);
  }
  return cone.solid_angle() / whole;
}

}  // namespace

void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, Scratch &scratch, std::vector<ContactPoint> &points) {
  const Pose b_in_a = relative_pose(pose_a, pose_b);
  const Vec3 shortest = transposed_times(pose_a.rotation, normal);
  const convex::Overlap overlap =
      convex::convex_overlap(a.geometry(), b.geometry(), b_in_a, shortest, scratch.overlap);
  if (!(overlap.volume > 0.0)) return;
  const Vec3 mean = mean_normal(scratch.overlap);
  if (!(norm(mean) > 0.0)) return;
  const PlaneAxes axes(contact_normal(shortest, mean));
  const double size = a.geometry().radius() + b.geometry().radius();
  collect_edges(scratch.overlap, axes.up, scratch.edges);
  collect_corners(axes, size, scratch);

  double deepest = 0.0;
  for (const Scratch::Corner &corner : scratch.corners) deepest = std::max(deepest, corner.lifted.z);
  scratch.anchors.clear();
  collect_anchors(a, {}, -axes.up, axes, deepest, scratch.anchors);
  collect_anchors(b, b_in_a, transposed_times(b_in_a.rotation, axes.up), axes, deepest, scratch.anchors);

  const std::size_t begin = points.size();
  const Vec3 world_normal = pose_a.rotation * axes.up;
  DirectionCone cone;
  for (std::size_t k = 0; k < scratch.corners.size(); ++k) {
    const Scratch::Corner &corner = scratch.corners[k];
    if (!(corner.lifted.z > 0.0)) continue;
    const double part = hemisphere_part(scratch.corners, k, cone);
    if (!(part > 0.0)) continue;
    const double weight = part * stiffness_at(corner.lifted.x, corner.lifted.y, scratch.anchors, size);
    points.push_back({corner.lifted.z, weight, world_normal, pose_a(corner.position)});
  }
  limit_load(points, begin);
}

}  // namespace cmb
