#include "manifold/polytope_manifold.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/pose_algebra.hpp"
#include "geometry/solid_angle.hpp"

namespace cmb {

namespace {

using Scratch = PolytopeManifoldScratch;

constexpr double pi = 3.14159265358979323846;
// The shake, in rad and in sizes of the bodies: large beside rounding, small beside anything else.
constexpr double shake_size = 1e-11;
// Faces at right angles to the contact plane to this cosine are walls.
constexpr double wall_cosine = 1e-9;
// Edges that cross at a smaller angle (its sine) count as parallel.
constexpr double parallel_sine = 1e-9;
// Vertices up to this many depths away from the contact plane have a say in the stiffness.
constexpr double anchor_reach = 2.0;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

// Of no special direction.
Shake shake_of(double size) {
  return {{0.53 * shake_size, -0.31 * shake_size, 0.79 * shake_size},
          {0.61 * shake_size * size, 0.37 * shake_size * size, -0.17 * shake_size * size}};
}

// The z axis of both sides points to the other body: A's is turned over. That mirrors A, so that the depth is the sum
// of both heights.
Vec3 mirrored(const Vec3 &v, double sense) { return {v.x, v.y, sense * v.z}; }

void find_patches(const PolytopeSide &side, std::vector<Scratch::Patch> &patches) {
  patches.clear();
  for (const PolytopeSide::Face &face : side.faces()) {
    const Vec3 n = mirrored(face.normal, side.sense()), shaken = mirrored(face.shaken_normal, side.sense());
    Scratch::Patch patch{};
    patch.towards = n.z > wall_cosine && shaken.z > 0.0;
    if (patch.towards) {
      patch.slope_x = n.x / n.z, patch.slope_y = n.y / n.z, patch.height = face.offset / n.z;
      patch.shaken_x = shaken.x / shaken.z, patch.shaken_y = shaken.y / shaken.z;
      patch.shaken_height = face.shaken_offset / shaken.z;
    }
    patch.wall_x = shaken.x, patch.wall_y = shaken.y, patch.wall_z = shaken.z, patch.wall_offset = face.shaken_offset;
    patches.push_back(patch);
  }
}

// The patch above (x, y); null where the line through it misses the body, or meets it beyond the gathered part.
const Scratch::Patch *patch_over(double x, double y, const std::vector<Scratch::Patch> &patches) {
  const Scratch::Patch *best = nullptr;
  double height = HUGE_VAL;
  for (const Scratch::Patch &patch : patches) {
    if (!patch.towards) continue;
    const double here = patch.shaken_height - patch.shaken_x * x - patch.shaken_y * y;
    if (here < height) height = here, best = &patch;
  }
  if (best == nullptr) return nullptr;
  for (const Scratch::Patch &patch : patches) {
    if (!patch.towards && patch.wall_x * x + patch.wall_y * y + patch.wall_z * height > patch.wall_offset) return nullptr;
  }
  return best;
}

// Cuts the arc between two faces' directions at the hemisphere's border; false where nothing is left.
bool cut_arc(Vec3 &first, Vec3 &second) {
  if (first.z <= 0.0 && second.z <= 0.0) return false;
  if (first.z < 0.0) first = second.z * first - first.z * second, first.z = 0.0;
  if (second.z < 0.0) second = first.z * second - second.z * first, second.z = 0.0;
  return true;
}

// Those that come deep enough to touch a body that reaches `other_reach` towards this one.
void find_borders(const PolytopeSide &side, double other_reach, std::vector<Scratch::Border> &borders) {
  borders.clear();
  for (const PolytopeSide::Edge &edge : side.edges()) {
    const PolytopeSide::Vertex &from = side.vertices()[index(edge.vertex[0])], &to = side.vertices()[index(edge.vertex[1])];
    if (std::max(side.sense() * from.at.z, side.sense() * to.at.z) + other_reach <= 0.0) continue;
    Scratch::Border border;
    for (int k = 0; k < 2; ++k) {
      border.ray[k] = mirrored(side.faces()[index(edge.face[k])].normal, side.sense());
    }
    if (!(std::max(border.ray[0].z, border.ray[1].z) > wall_cosine)) continue;
    if (!cut_arc(border.ray[0], border.ray[1])) continue;
    border.from = mirrored(from.at, side.sense()), border.to = mirrored(to.at, side.sense());
    border.shaken_from = mirrored(from.shaken, side.sense()), border.shaken_to = mirrored(to.shaken, side.sense());
    border.low_x = std::min(border.shaken_from.x, border.shaken_to.x);
    border.high_x = std::max(border.shaken_from.x, border.shaken_to.x);
    border.low_y = std::min(border.shaken_from.y, border.shaken_to.y);
    border.high_y = std::max(border.shaken_from.y, border.shaken_to.y);
    borders.push_back(border);
  }
}

// The directions of the hemisphere in a vertex' normal cone, its z axis pointing to the other body.
void visible_cone(const PolytopeSide &side, std::int32_t vertex, DirectionCone &cone) {
  cone.clear();
  const ContactPolytope &body = side.body();
  const std::size_t count = body.faces_at(vertex), step = 1 + count / (DirectionCone::capacity - 8);
  bool cut = false;
  for (std::size_t i = 0; i < count; i += step) {
    const Vec3 ray = mirrored(side.to_contact().rotation * body.face_normal_at(vertex, i), side.sense());
    cut = cut || ray.z < 0.0;
    cone.add(ray);
  }
  if (cut) cone.clip({0, 0, 1});
}

// What a vertex would carry if its normal cone filled the hemisphere; `visible` is the solid angle of its visible cone.
double stiffness_of(const PolytopeSide &side, std::int32_t vertex, double visible) {
  const Vec3 towards = side.sense() * side.to_contact().rotation.row[2];
  return 2.0 * pi * side.body().share(vertex, towards) / std::fmax(visible, 0.25 * side.body().normal_cone(vertex));
}

// Vertices of one side over faces of the other. `sense` is that of `side`.
void add_vertices(const PolytopeSide &side, double other_reach, const std::vector<Scratch::Patch> &others,
                  std::vector<Scratch::Corner> &corners) {
  DirectionCone cone, sheared;
  for (const PolytopeSide::Vertex &v : side.vertices()) {
    const double own = side.sense() * v.at.z;
    if (!v.inside || !(own + other_reach > 0.0)) continue;
    const Scratch::Patch *patch = patch_over(v.shaken.x, v.shaken.y, others);
    if (patch == nullptr) continue;
    const double other = patch->height - patch->slope_x * v.at.x - patch->slope_y * v.at.y;
    if (!(own + other > 0.0)) continue;
    visible_cone(side, v.number, cone);
    if (cone.empty()) continue;
    sheared.clear();
    for (std::size_t k = 0; k < cone.size(); ++k) {
      const Vec3 &ray = cone[k];
      sheared.add({ray.x + ray.z * patch->slope_x, ray.y + ray.z * patch->slope_y, ray.z});
    }
    const double part = sheared.solid_angle() / (2.0 * pi);
    // The surfaces are at z = sense * own and -sense * other.
    corners.push_back({{v.at.x, v.at.y, 0.5 * side.sense() * (own - other)}, own + other, part});
  }
}

double area(const Vec3 &from, const Vec3 &to, const Vec3 &p) {
  return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
}

// Crossings of edges, seen along the contact normal.
void add_crossings(const std::vector<Scratch::Border> &borders_a, const std::vector<Scratch::Border> &borders_b,
                   std::vector<Scratch::Corner> &corners) {
  DirectionCone cone;
  for (const Scratch::Border &e : borders_a) {
    for (const Scratch::Border &f : borders_b) {
      if (f.low_x > e.high_x || f.high_x < e.low_x || f.low_y > e.high_y || f.high_y < e.low_y) continue;
      if ((area(f.shaken_from, f.shaken_to, e.shaken_from) > 0.0) ==
          (area(f.shaken_from, f.shaken_to, e.shaken_to) > 0.0)) {
        continue;
      }
      if ((area(e.shaken_from, e.shaken_to, f.shaken_from) > 0.0) ==
          (area(e.shaken_from, e.shaken_to, f.shaken_to) > 0.0)) {
        continue;
      }
      const Vec3 de = e.to - e.from, df = f.to - f.from, between = f.from - e.from;
      const double product = de.x * df.y - de.y * df.x;
      if (!(product * product > parallel_sine * parallel_sine * norm2(de) * norm2(df))) continue;
      const double t = std::clamp((between.x * df.y - between.y * df.x) / product, 0.0, 1.0);
      const double s = std::clamp((between.x * de.y - between.y * de.x) / product, 0.0, 1.0);
      const Vec3 on_e = e.from + t * de, on_f = f.from + s * df;
      const double depth = on_e.z + on_f.z;
      if (!(depth > 0.0)) continue;
      // Slopes add up: the cone's rays are the sums of both edges' directions, taken at the same z.
      cone.clear();
      for (const int corner : {0, 1, 3, 2}) {
        const Vec3 &p = e.ray[corner & 1], &q = f.ray[corner >> 1];
        const Vec3 ray{p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
        if (norm2(ray) > 0.0) cone.add(ray);
      }
      const double part = cone.solid_angle() / (2.0 * pi);
      const Vec3 middle{0.5 * (on_e.x + on_f.x), 0.5 * (on_e.y + on_f.y), 0.5 * (on_f.z - on_e.z)};
      corners.push_back({middle, depth, part});
    }
  }
}

void add_anchors(const PolytopeSide &side, double reach, double depth, std::vector<Scratch::Anchor> &anchors) {
  DirectionCone cone;
  for (const PolytopeSide::Vertex &v : side.vertices()) {
    const double nearness = 1.0 - (reach - side.sense() * v.at.z) / (anchor_reach * depth);
    if (!(nearness > 0.0)) continue;
    visible_cone(side, v.number, cone);
    anchors.push_back({v.at.x, v.at.y, nearness * nearness, stiffness_of(side, v.number, cone.solid_angle())});
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

// The contact's axes: z along `up` (unit, world axes), the origin near the contact.
Pose contact_axes(const Vec3 &up, const Vec3 &origin) {
  const Vec3 first = convex::any_perpendicular(up);
  return {transposed(convex::Mat3{{first, cross(up, first), up}}), origin};
}

}  // namespace

void polytope_contact(const ContactPolytope &a, const Pose &pose_a, const ContactPolytope &b, const Pose &pose_b,
                      const Vec3 &normal, const Vec3 &witness, Scratch &scratch, std::vector<ContactPoint> &points) {
  const double size = a.geometry().radius() + b.geometry().radius();
  const Pose axes = contact_axes(normal, witness);
  const Pose a_in_axes = relative_pose(axes, pose_a), b_in_axes = relative_pose(axes, pose_b);
  const double reach_a = PolytopeSide::reach(a, a_in_axes, -1.0), reach_b = PolytopeSide::reach(b, b_in_axes, 1.0);
  const double overlap = reach_a + reach_b;
  if (!(overlap > 0.0)) return;
  scratch.side_a.gather(a, a_in_axes, -1.0, reach_a - anchor_reach * overlap, {});
  scratch.side_b.gather(b, b_in_axes, 1.0, reach_b - anchor_reach * overlap, shake_of(size));
  find_patches(scratch.side_a, scratch.patches_a);
  find_patches(scratch.side_b, scratch.patches_b);
  find_borders(scratch.side_a, reach_b, scratch.borders_a);
  find_borders(scratch.side_b, reach_a, scratch.borders_b);
  scratch.corners.clear();
  add_vertices(scratch.side_a, reach_b, scratch.patches_b, scratch.corners);
  add_vertices(scratch.side_b, reach_a, scratch.patches_a, scratch.corners);
  add_crossings(scratch.borders_a, scratch.borders_b, scratch.corners);

  double deepest = 0.0;
  for (const Scratch::Corner &corner : scratch.corners) deepest = std::max(deepest, corner.depth);
  scratch.anchors.clear();
  add_anchors(scratch.side_a, reach_a, deepest, scratch.anchors);
  add_anchors(scratch.side_b, reach_b, deepest, scratch.anchors);

  const std::size_t begin = points.size();
  for (const Scratch::Corner &corner : scratch.corners) {
    const double weight = corner.part * stiffness_at(corner.middle.x, corner.middle.y, scratch.anchors, size);
    if (weight > 0.0) points.push_back({corner.depth, weight, normal, axes(corner.middle)});
  }
  limit_load(points, begin);
}

}  // namespace cmb
