#include "manifold/polytope_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "geometry/solid_angle.hpp"

namespace cmb {

namespace {

using Scratch = PolytopeManifoldScratch;

constexpr double pi = 3.14159265358979323846;
// What counts as on the overlap's surface, relative to the bodies' size.
constexpr double surface_tolerance = 1e-11;
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

// Directions along which the bodies are this many times as deep in each other as along the shortest way out have no
// say in the contact normal.
constexpr double depth_ratio = 2.0;

// The contact plane's axes.
struct PlaneAxes {
  Vec3 up, first, second;
  explicit PlaneAxes(const Vec3 &normal)
      : up(normal), first(convex::any_perpendicular(normal)), second(cross(normal, first)) {}
};

const Vec3 &corner(const convex::OverlapScratch &overlap, const convex::OverlapScratch::Face &face, std::int32_t k) {
  return overlap.vertices()[index(overlap.corners()[index(face.first + k)])];
}

double area(const convex::OverlapScratch &overlap, const convex::OverlapScratch::Face &face) {
  const Vec3 &origin = corner(overlap, face, 0);
  double sum = 0.0;
  for (std::int32_t k = 1; k + 1 < face.count; ++k) {
    sum += dot(face.normal, cross(corner(overlap, face, k) - origin, corner(overlap, face, k + 1) - origin));
  }
  return 0.5 * sum;
}

// The parts in the overlap of the edges at those faces of a body that bound it. Edges on the overlap's surface count,
// whichever body the faces there belong to.
void collect_segments(const convex::OverlapScratch &overlap, const convex::Polytope &body, const Pose &to_a,
                      bool is_b, double slack, std::vector<std::uint8_t> &bounds,
                      std::vector<Scratch::Segment> &segments) {
  bounds.assign(body.faces().size(), 0);
  for (const convex::OverlapScratch::Face &face : overlap.faces()) {
    if (face.from_b == is_b) bounds[index(face.source_face)] = 1;
  }
  segments.clear();
  for (const convex::Polytope::Edge &edge : body.edges()) {
    if (bounds[index(edge.face[0])] == 0 && bounds[index(edge.face[1])] == 0) continue;
    const Vec3 from = to_a(body.vertices()[index(edge.vertex[0])]), to = to_a(body.vertices()[index(edge.vertex[1])]);
    double begin = 0.0, end = 1.0;
    for (const convex::OverlapScratch::Face &face : overlap.faces()) {
      const double at_from = dot(face.normal, from) - face.offset - slack;
      const double at_to = dot(face.normal, to) - face.offset - slack;
      if (at_from > 0.0 && at_to > 0.0) end = -1.0;
      if (at_from > 0.0 && at_to <= 0.0) begin = std::max(begin, at_from / (at_from - at_to));
      if (at_from <= 0.0 && at_to > 0.0) end = std::min(end, at_from / (at_from - at_to));
    }
    if (begin < end) segments.push_back({from + begin * (to - from), (end - begin) * (to - from)});
  }
}

// How deep A and B are in each other along unit directions of A's frame.
class DepthAlong {
 public:
  DepthAlong(const convex::Polytope &a, const convex::Polytope &b, const Pose &b_in_a) : a_(a), b_(b), b_in_a_(b_in_a) {}

  double operator()(const Vec3 &direction) const {
    const Vec3 in_b = transposed_times(b_in_a_.rotation, direction);
    return dot(in_b, b_.vertices()[index(b_.support_vertex(in_b))]) + dot(direction, b_in_a_.translation) -
           dot(direction, a_.vertices()[index(a_.support_vertex(-direction))]);
  }

 private:
  const convex::Polytope &a_;
  const convex::Polytope &b_;
  const Pose &b_in_a_;
};

// The contact plane's normal: that of the shortest way out, `shortest` (unit), which is a face's where a face rests.
// Where two ways out are about as short, the shortest one jumps from one to the other; a mean leads over. The ways
// considered are the normals of the overlap's faces and of the crossings of its edges, each with a say that fades
// away with the depth along it and with the size of the face or edges in the overlap.
Vec3 contact_normal(const Vec3 &shortest, const DepthAlong &depth_along, const Scratch &scratch) {
  const convex::OverlapScratch &overlap = scratch.overlap;
  const double least = depth_along(shortest);
  if (!(least > 0.0)) return shortest;
  Vec3 sum;
  const auto consider = [&](const Vec3 &direction, double depth, double size) {
    const double nearness = (depth_ratio - std::max(depth, least) / least) / (depth_ratio - 1.0);
    if (nearness > 0.0) sum = sum + (nearness * nearness * nearness * size / (size + least * least)) * direction;
  };
  for (const convex::OverlapScratch::Face &face : overlap.faces()) {
    const Vec3 direction = face.from_b ? face.normal : -face.normal;
    consider(direction, depth_along(direction), std::max(area(overlap, face), 0.0));
  }
  for (const Scratch::Segment &e : scratch.segments_a) {
    for (const Scratch::Segment &f : scratch.segments_b) {
      const Vec3 across = cross(e.along, f.along);
      const double product = norm(e.along) * norm(f.along), sine = norm(across) / product;
      if (!(sine > parallel_sine)) continue;
      const Vec3 direction = normalized(across);
      // The gap of the edges' lines is a lower bound of the depth.
      if (std::fabs(dot(direction, f.from - e.from)) >= depth_ratio * least) continue;
      for (const double sense : {1.0, -1.0}) {
        consider(sense * direction, depth_along(sense * direction), sine * sine * product);
      }
    }
  }
  return normalized(sum, shortest);
}

// Where the line through p along `up` leaves a body, as the length from p; not finite where it misses the body.
// `to_a` maps the body's frame to that of p and `up`.
double exit_length(const Vec3 &p, const Vec3 &up, const convex::Polytope &body, const Pose &to_a, double slack) {
  const Vec3 local_p = transposed_times(to_a.rotation, p - to_a.translation);
  const Vec3 local_up = transposed_times(to_a.rotation, up);
  double enter = -HUGE_VAL, leave = HUGE_VAL;
  for (const convex::Polytope::Face &face : body.faces()) {
    const double rate = dot(face.normal, local_up), inside = face.offset - dot(face.normal, local_p);
    if (std::fabs(rate) <= wall_cosine) {
      if (inside < -slack) return HUGE_VAL;
    } else if (rate > 0.0) {
      leave = std::min(leave, inside / rate);
    } else {
      enter = std::max(enter, inside / rate);
    }
  }
  return enter <= leave + slack ? leave : HUGE_VAL;
}

// The edges of a body that belong to the side towards `side` (unit, in the body's frame) and reach farther along it
// than `least`.
void collect_side(const convex::Polytope &body, const Vec3 &side, double least, std::vector<std::int32_t> &edges) {
  edges.clear();
  for (std::size_t e = 0; e < body.edges().size(); ++e) {
    const convex::Polytope::Edge &edge = body.edges()[e];
    const bool faces_there = dot(body.faces()[index(edge.face[0])].normal, side) > wall_cosine ||
                             dot(body.faces()[index(edge.face[1])].normal, side) > wall_cosine;
    if (!faces_there) continue;
    if (dot(body.vertices()[index(edge.vertex[0])], side) > least ||
        dot(body.vertices()[index(edge.vertex[1])], side) > least) {
      edges.push_back(static_cast<std::int32_t>(e));
    }
  }
}

// The corners of the depth's graph: vertices of A above or below B's upper side, vertices of B, crossings of edges, and
// the border where the depth is zero. Places that are no corners may be among them, with a depth no greater than the
// true one: their normal cones turn out empty.
void collect_corners(const convex::Polytope &a, const convex::Polytope &b, const Pose &b_in_a, const PlaneAxes &axes,
                     double size, Scratch &scratch) {
  std::vector<Scratch::Corner> &corners = scratch.corners;
  corners.clear();
  const double near = corner_tolerance * size, slack = surface_tolerance * size;
  const auto add = [&](const Vec3 &middle, double depth) {
    const Vec3 lifted{dot(axes.first, middle), dot(axes.second, middle), depth};
    for (const Scratch::Corner &known : corners) {
      const Vec3 off = known.lifted - lifted;
      if (std::fabs(off.x) <= near && std::fabs(off.y) <= near && std::fabs(off.z) <= near) return;
    }
    corners.push_back({lifted, middle});
  };

  scratch.vertices_b.clear();
  double lowest_a = HUGE_VAL, highest_b = -HUGE_VAL;
  for (const Vec3 &v : a.vertices()) lowest_a = std::min(lowest_a, dot(axes.up, v));
  for (const Vec3 &v : b.vertices()) {
    scratch.vertices_b.push_back(b_in_a(v));
    highest_b = std::max(highest_b, dot(axes.up, scratch.vertices_b.back()));
  }
  for (const Vec3 &v : a.vertices()) {
    if (dot(axes.up, v) >= highest_b) continue;
    const double depth = exit_length(v, axes.up, b, b_in_a, slack);
    if (depth > 0.0 && std::isfinite(depth)) add(v + 0.5 * depth * axes.up, depth);
  }
  for (const Vec3 &v : scratch.vertices_b) {
    if (dot(axes.up, v) <= lowest_a) continue;
    const double depth = exit_length(v, -axes.up, a, {}, slack);
    if (depth > 0.0 && std::isfinite(depth)) add(v - 0.5 * depth * axes.up, depth);
  }

  const Vec3 up_in_b = transposed_times(b_in_a.rotation, axes.up);
  collect_side(a, -axes.up, -highest_b, scratch.lower_edges);
  collect_side(b, up_in_b, lowest_a - dot(axes.up, b_in_a.translation), scratch.upper_edges);
  for (const std::int32_t lower : scratch.lower_edges) {
    const convex::Polytope::Edge &e = a.edges()[index(lower)];
    const Vec3 &e0 = a.vertices()[index(e.vertex[0])], de = a.vertices()[index(e.vertex[1])] - e0;
    const double e_length = norm(de);
    for (const std::int32_t upper : scratch.upper_edges) {
      const convex::Polytope::Edge &f = b.edges()[index(upper)];
      const Vec3 &f0 = scratch.vertices_b[index(f.vertex[0])], df = scratch.vertices_b[index(f.vertex[1])] - f0;
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
  for (const std::vector<Scratch::Segment> *segments : {&scratch.segments_a, &scratch.segments_b}) {
    for (const Scratch::Segment &segment : *segments) {
      add(segment.from, 0.0);
      add(segment.from + segment.along, 0.0);
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
  const double size = a.geometry().radius() + b.geometry().radius();
  collect_segments(scratch.overlap, a.geometry(), {}, false, surface_tolerance * size, scratch.bounds,
                   scratch.segments_a);
  collect_segments(scratch.overlap, b.geometry(), b_in_a, true, surface_tolerance * size, scratch.bounds,
                   scratch.segments_b);
  const PlaneAxes axes(contact_normal(shortest, DepthAlong(a.geometry(), b.geometry(), b_in_a), scratch));
  collect_corners(a.geometry(), b.geometry(), b_in_a, axes, size, scratch);

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
