#include "manifold/depth_graph.hpp"

#include <algorithm>
#include <cmath>

namespace cmb {

namespace {

constexpr double inverse_hemisphere = 0.5 / 3.14159265358979323846;
// The shake, in rad and in sizes of the bodies: large beside rounding, small beside anything else.
constexpr double shake_size = 1e-11;
// Faces at right angles to the contact plane to this cosine are walls.
constexpr double wall_cosine = 1e-9;
// Edges that cross at a smaller angle (its sine) count as parallel.
constexpr double parallel_sine = 1e-9;
// Slopes that change a cone by rounding only.
constexpr double level_slope = 1e-15;
// Up to so many pairs of edges sorting takes longer than comparing all.
constexpr std::size_t few_pairs = 300;
// How far beyond the other body's extent, in sizes, edges and corners are still looked at: the shake moves the crossing of
// edges at the angle e by shake_size / e, and what is so nearly parallel that it moves farther weighs nothing.
constexpr double margin = 1e-3;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Of no special direction.
Shake shake_of(double size) {
  return {{0.53 * shake_size, -0.31 * shake_size, 0.79 * shake_size},
          {0.61 * shake_size * size, 0.37 * shake_size * size, -0.17 * shake_size * size}};
}

Extent common(const Extent &a, const Extent &b, double beyond) {
  return {std::max(a.low_x, b.low_x) - beyond, std::min(a.high_x, b.high_x) + beyond,
          std::max(a.low_y, b.low_y) - beyond, std::min(a.high_y, b.high_y) + beyond};
}

// Cuts the arc between two faces' directions at the hemisphere's border; false where nothing is left.
bool cut_arc(Vec3 &first, Vec3 &second) {
  if (first.z <= 0.0 && second.z <= 0.0) return false;
  if (first.z < 0.0) first = second.z * first - first.z * second, first.z = 0.0;
  if (second.z < 0.0) second = first.z * second - second.z * first, second.z = 0.0;
  return true;
}

// Interpolates (Shepard) between the ends of two edges that cross, at the parts t and s of their ways.
Stiffness between_ends(double t, const Stiffness &at_t0, const Stiffness &at_t1, double s, const Stiffness &at_s0,
                       const Stiffness &at_s1) {
  // Over one denominator: a division for all.
  constexpr double smallest = 1e-28;
  const double t0 = t * t + smallest, t1 = (1.0 - t) * (1.0 - t) + smallest;
  const double s0 = s * s + smallest, s1 = (1.0 - s) * (1.0 - s) + smallest;
  double a = t1 * s0 * s1, b = t0 * s0 * s1, c = t0 * t1 * s1, d = t0 * t1 * s0;
  const double part = 1.0 / (a + b + c + d);
  a *= part, b *= part, c *= part, d *= part;
  return {a * at_t0.value + b * at_t1.value + c * at_s0.value + d * at_s1.value,
          a * at_t0.slope + b * at_t1.slope + c * at_s0.slope + d * at_s1.slope};
}

}  // namespace

void DepthGraph::Faces::gather(PolytopeSide &side) {
  planes.clear();
  shaken.clear();
  walls.clear();
  const Pose &to_side = side.to_side();
  const Shake &shake = side.shake();
  for (const std::int32_t number : side.faces()) {
    const convex::Polytope::Face &face = side.body().geometry().faces()[index(number)];
    const Vec3 n = to_side.rotation * face.normal, m = shake.direction(n);
    const double offset = face.offset + dot(n, to_side.translation), shaken_offset = offset + dot(m, shake.shift);
    if (n.z > wall_cosine && m.z > 0.0) {
      const double part = 1.0 / m.z;
      planes.emplace_back();
      planes.back().set(n, offset);
      shaken.emplace_back();
      Plane &plane = shaken.back();
      plane.slope_x = m.x * part, plane.slope_y = m.y * part, plane.height = shaken_offset * part;
    } else {
      walls.emplace_back();
      walls.back().set(m, shaken_offset);
    }
  }
}

bool DepthGraph::Faces::over(const Vec3 &p, double height, double level, double size, Plane &plane) const {
  double least = HUGE_VAL;
  std::size_t best = shaken.size();
  for (std::size_t k = 0; k < shaken.size(); ++k) {
    const double here = shaken[k].over(p);
    if (here >= least) continue;
    // What is far from deep enough, however the shake is taken, need not be looked at further.
    const double slack = 1e3 * shake_size * size * (1.0 + std::fabs(shaken[k].slope_x) + std::fabs(shaken[k].slope_y));
    if (height + here <= level - slack) return false;
    least = here, best = k;
  }
  if (best == shaken.size()) return false;
  for (const FacePlane &wall : walls) {
    if (wall.normal.x * p.x + wall.normal.y * p.y + wall.normal.z * least > wall.offset) return false;
  }
  const FacePlane &face = planes[best];
  const double part = 1.0 / face.normal.z;
  plane = {face.normal.x * part, face.normal.y * part, face.offset * part};
  return true;
}

void DepthGraph::Lines::gather(const PolytopeSide &side, const Extent &region, double beyond) {
  found.clear();
  if (arcs.size() < side.edge_count()) arcs.resize(side.edge_count());
  for (std::size_t i = 0; i < side.edge_count(); ++i) {
    const PolytopeSide::Edge &edge = side.edge(i);
    if (!edge.extent.meets(region)) continue;
    const PolytopeSide::Vertex &first = side.vertex(index(edge.vertex[0])), &second = side.vertex(index(edge.vertex[1]));
    const Vec3 from = side.shaken(first), to = side.shaken(second);
    found.emplace_back();
    Line &line = found.back();
    line.from_x = from.x, line.from_y = from.y, line.to_x = to.x, line.to_y = to.y;
    // Of what is too high nothing crosses deep enough.
    line.low_x = std::max(std::min(from.x, to.x), edge.extent.low_x - beyond);
    line.high_x = std::min(std::max(from.x, to.x), edge.extent.high_x + beyond);
    line.low_y = std::max(std::min(from.y, to.y), edge.extent.low_y - beyond);
    line.high_y = std::min(std::max(from.y, to.y), edge.extent.high_y + beyond);
    line.highest = std::max(first.at.z, second.at.z);
    line.edge = static_cast<std::int32_t>(i);
    arcs[i].known = false;
  }
}

const DirectionArc *DepthGraph::Lines::arc(const PolytopeSide &side, std::int32_t edge) {
  Arc &arc = arcs[index(edge)];
  if (!arc.known) {
    const convex::Polytope &geometry = side.body().geometry();
    const convex::Polytope::Edge &whole = geometry.edges()[index(side.edge(index(edge)).number)];
    const convex::Mat3 &rotation = side.to_side().rotation;
    Vec3 first = rotation * geometry.faces()[index(whole.face[0])].normal;
    Vec3 second = rotation * geometry.faces()[index(whole.face[1])].normal;
    arc.known = true;
    arc.visible = std::max(first.z, second.z) > wall_cosine && cut_arc(first, second);
    if (arc.visible) arc.directions = {first, second};
  }
  return arc.visible ? &arc.directions : nullptr;
}

void DepthGraph::Lines::sort() {
  order.clear();
  for (const Line &line : found) order.emplace_back(line.low_x, static_cast<std::int32_t>(order.size()));
  std::sort(order.begin(), order.end());
  ordered.clear();
  for (const auto &[low, k] : order) ordered.push_back(found[index(k)]);
}

void DepthGraph::place(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
                       const Pose &b_in_axes) {
  size_ = a.geometry().radius() + b.geometry().radius();
  // A lies above: it is mirrored, so that the depth is the sum of both heights.
  Pose mirrored = a_in_axes;
  mirrored.rotation.row[2] = -mirrored.rotation.row[2];
  mirrored.translation.z = -mirrored.translation.z;
  side_a_.place(a, mirrored, {});
  side_b_.place(b, b_in_axes, shake_of(size_));
  turning_a_ = 0.5;
  if (!a.shares_are_constant() || !b.shares_are_constant()) {
    // The contact normal turns with the body that has a face in it.
    const double lean_a = side_a_.lean(), lean_b = side_b_.lean();
    if (lean_a + lean_b > 0.0) turning_a_ = lean_a / (lean_a + lean_b);
  }
}

void DepthGraph::find_corners(double level) {
  corners_.clear();
  level_ = level;
  side_a_.gather(level - side_b_.reach());
  side_b_.gather(level - side_a_.reach());
  region_ = common(side_a_.extent(), side_b_.extent(), margin * size_);
  if (!(region_.low_x <= region_.high_x && region_.low_y <= region_.high_y)) return;
  stiffness_a_.start(side_a_, turning_a_);
  stiffness_b_.start(side_b_, 1.0 - turning_a_);
  add_vertices(side_a_, stiffness_a_, side_b_, faces_b_, -1.0);
  add_vertices(side_b_, stiffness_b_, side_a_, faces_a_, 1.0);
  add_crossings();
}

// Vertices of one side over faces of the other; `sense` is the contact normal along the side's z axis.
void DepthGraph::add_vertices(const PolytopeSide &side, VertexStiffness &stiffness, PolytopeSide &other_side,
                              Faces &others, double sense) {
  bool gathered = false;
  Plane plane;
  for (std::size_t i = 0; i < side.vertex_count(); ++i) {
    const PolytopeSide::Vertex &v = side.vertex(i);
    if (!v.inside || !region_.holds(v.at)) continue;
    if (!gathered) others.gather(other_side), gathered = true;
    if (!others.over(side.shaken(v), v.at.z, level_, size_, plane)) continue;
    const double other = plane.over(v.at), depth = v.at.z + other;
    if (!(depth > level_)) continue;
    const double visible = visible_cone(side, v.number, cone_);
    if (cone_.empty()) continue;
    const Stiffness &scale = stiffness.of(static_cast<std::int32_t>(i), visible);
    double part = visible;
    if (std::fabs(plane.slope_x) + std::fabs(plane.slope_y) > level_slope) {
      sheared_cone_.clear();
      for (std::size_t k = 0; k < cone_.size(); ++k) {
        const Vec3 &ray = cone_[k];
        sheared_cone_.add({ray.x + ray.z * plane.slope_x, ray.y + ray.z * plane.slope_y, ray.z});
      }
      part = sheared_cone_.solid_angle();
    }
    part *= inverse_hemisphere;
    // The surfaces are at sense * own height and -sense * the other's.
    add_corner(v.at.x, v.at.y, 0.5 * sense * (v.at.z - other), depth, part, scale);
  }
}

// Written member by member: objects put together on the stack and copied as a whole would wait for the store.
void DepthGraph::add_corner(double x, double y, double z, double depth, double part, const Stiffness &scale) {
  corners_.emplace_back();
  Corner &corner = corners_.back();
  corner.middle.x = x, corner.middle.y = y, corner.middle.z = z;
  corner.depth = depth;
  corner.weight = part * scale.value;
  corner.slope.x = part * scale.slope.x, corner.slope.y = part * scale.slope.y, corner.slope.z = part * scale.slope.z;
}

// The crossing of two edges, one of each side, that cross as seen along the contact normal.
void DepthGraph::add_crossing(std::int32_t edge_a, std::int32_t edge_b) {
  const PolytopeSide::Edge &e = side_a_.edge(index(edge_a)), &f = side_b_.edge(index(edge_b));
  const Vec3 &from_e = side_a_.vertex(index(e.vertex[0])).at, &from_f = side_b_.vertex(index(f.vertex[0])).at;
  const Vec3 de = side_a_.vertex(index(e.vertex[1])).at - from_e, df = side_b_.vertex(index(f.vertex[1])).at - from_f;
  const Vec3 between = from_f - from_e;
  const double product = de.x * df.y - de.y * df.x;
  if (!(product * product > parallel_sine * parallel_sine * norm2(de) * norm2(df))) return;
  const double inverse = 1.0 / product;
  const double t = std::clamp((between.x * df.y - between.y * df.x) * inverse, 0.0, 1.0);
  const double s = std::clamp((between.x * de.y - between.y * de.x) * inverse, 0.0, 1.0);
  const Vec3 on_e = from_e + t * de, on_f = from_f + s * df;
  const double depth = on_e.z + on_f.z;
  if (!(depth > level_)) return;
  const DirectionArc *of_e = lines_a_.arc(side_a_, edge_a);
  if (of_e == nullptr) return;
  const DirectionArc *of_f = lines_b_.arc(side_b_, edge_b);
  if (of_f == nullptr) return;
  // Slopes add up.
  const double part = parallelogram_solid_angle(*of_e, *of_f) * inverse_hemisphere;
  const Stiffness scale = between_ends(t, stiffness_a_.of(e.vertex[0]), stiffness_a_.of(e.vertex[1]), s,
                                       stiffness_b_.of(f.vertex[0]), stiffness_b_.of(f.vertex[1]));
  add_corner(0.5 * (on_e.x + on_f.x), 0.5 * (on_e.y + on_f.y), 0.5 * (on_f.z - on_e.z), depth, part, scale);
}

// Edges whose extents along x overlap are found by a sweep; of a few edges all pairs are compared.
void DepthGraph::add_crossings() {
  const double beyond = margin * size_;
  lines_a_.gather(side_a_, region_, beyond);
  if (lines_a_.found.empty()) return;
  lines_b_.gather(side_b_, region_, beyond);
  const double level = level_;
  const auto crosses = [](const Line &e, const Line &f) { return f.parts(e) && e.parts(f); };
  if (lines_a_.found.size() * lines_b_.found.size() <= few_pairs) {
    for (const Line &e : lines_a_.found) {
      for (const Line &f : lines_b_.found) {
        // No branch but one: what it decides cannot be foretold.
        const bool near = (e.highest + f.highest > level) & (f.low_x <= e.high_x) & (f.high_x >= e.low_x) &
                          (f.low_y <= e.high_y) & (f.high_y >= e.low_y);
        if (near && crosses(e, f)) add_crossing(e.edge, f.edge);
      }
    }
    return;
  }
  lines_a_.sort();
  lines_b_.sort();
  const auto near = [level](const Line &e, const Line &f) {
    return (e.highest + f.highest > level) & (f.low_y <= e.high_y) & (f.high_y >= e.low_y);
  };
  const Line *a = lines_a_.ordered.data(), *b = lines_b_.ordered.data();
  const Line *const end_a = a + lines_a_.ordered.size(), *const end_b = b + lines_b_.ordered.size();
  while (a != end_a && b != end_b) {
    if (a->low_x <= b->low_x) {
      for (const Line *f = b; f != end_b && f->low_x <= a->high_x; ++f) {
        if (near(*a, *f) && crosses(*a, *f)) add_crossing(a->edge, f->edge);
      }
      ++a;
    } else {
      for (const Line *e = a; e != end_a && e->low_x <= b->high_x; ++e) {
        if (near(*e, *b) && crosses(*e, *b)) add_crossing(e->edge, b->edge);
      }
      ++b;
    }
  }
}

}  // namespace cmb
