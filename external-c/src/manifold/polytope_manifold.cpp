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

// Half the square of the angle between the contact plane and the face that is most level.
double lean(const PolytopeSide &side) {
  double highest = 0.0;
  for (const PolytopeSide::Face &face : side.faces()) highest = std::max(highest, side.sense() * face.normal.z);
  return std::max(0.0, 1.0 - highest);
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

void find_borders(const PolytopeSide &side, std::vector<Scratch::Border> &borders) {
  borders.clear();
  for (const PolytopeSide::Edge &edge : side.edges()) {
    const PolytopeSide::Vertex &from = side.vertices()[index(edge.vertex[0])], &to = side.vertices()[index(edge.vertex[1])];
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
    for (int k = 0; k < 2; ++k) border.vertex[k] = edge.vertex[k];
    borders.push_back(border);
  }
}

// The directions of the hemisphere in a vertex' normal cone, its z axis pointing to the other body.
void visible_cone(const PolytopeSide &side, std::int32_t vertex, DirectionCone &cone) {
  cone.clear();
  const ContactPolytope &body = side.body();
  // An apex with very many faces is taken with every second, third, ... of them.
  const std::size_t count = body.faces_at(vertex), step = 1 + count / (DirectionCone::capacity / 2);
  const auto direction = [&](std::size_t i) {
    return mirrored(side.to_contact().rotation * body.face_normal_at(vertex, i), side.sense());
  };
  const Vec3 first = direction(0);
  Vec3 from = first;
  for (std::size_t i = 0; i < count; i += step) {
    const Vec3 to = i + step < count ? direction(i + step) : first;
    if (from.z >= 0.0) cone.add(from);
    if ((from.z < 0.0) != (to.z < 0.0)) {
      Vec3 border = std::fabs(to.z) * from + std::fabs(from.z) * to;
      border.z = 0.0;
      if (norm2(border) > 0.0) cone.add(border);
    }
    from = to;
  }
}

// The stiffness of a side's vertices, found where it is asked for.
class VertexStiffness {
 public:
  // The direction towards the other body turns with that one as far as `turning`. `cone` is room to work in.
  VertexStiffness(const PolytopeSide &side, double turning, std::vector<Scratch::Stiffness> &known, DirectionCone &cone)
      : side_(side),
        towards_(side.sense() * side.to_contact().rotation.row[2]),
        turning_(turning),
        known_(known),
        cone_(cone) {
    known_.assign(side.vertices().size(), {});
  }

  // Of the side's vertex k, whose visible cone has the solid angle `visible`.
  const Scratch::Stiffness &of(std::int32_t k, double visible) {
    Scratch::Stiffness &stiffness = known_[index(k)];
    if (stiffness.value >= 0.0) return stiffness;
    const ContactPolytope &body = side_.body();
    const std::int32_t v = side_.vertices()[index(k)].number;
    const double scale = 2.0 * pi / std::fmax(visible, 0.25 * body.normal_cone(v));
    Vec3 gradient;
    stiffness.value = scale * body.share(v, towards_, &gradient);
    if (!body.share_is_constant(v)) stiffness.slope = (scale * turning_) * (side_.to_contact().rotation * gradient);
    return stiffness;
  }
  const Scratch::Stiffness &of(std::int32_t k) {
    if (known_[index(k)].value >= 0.0) return known_[index(k)];
    visible_cone(side_, side_.vertices()[index(k)].number, cone_);
    return of(k, cone_.solid_angle());
  }

 private:
  const PolytopeSide &side_;
  Vec3 towards_;
  double turning_;
  std::vector<Scratch::Stiffness> &known_;
  DirectionCone &cone_;
};

// Vertices of one side over faces of the other.
void add_vertices(const PolytopeSide &side, VertexStiffness &stiffness,
                  const std::vector<Scratch::Patch> &others, DirectionCone &cone, DirectionCone &sheared,
                  std::vector<Scratch::Corner> &corners) {
  for (std::size_t i = 0; i < side.vertices().size(); ++i) {
    const PolytopeSide::Vertex &v = side.vertices()[i];
    const double own = side.sense() * v.at.z;
    if (!v.inside) continue;
    const Scratch::Patch *patch = patch_over(v.shaken.x, v.shaken.y, others);
    if (patch == nullptr) continue;
    const double other = patch->height - patch->slope_x * v.at.x - patch->slope_y * v.at.y;
    if (!(own + other > 0.0)) continue;
    visible_cone(side, v.number, cone);
    if (cone.empty()) continue;
    const double visible = cone.solid_angle();
    const Scratch::Stiffness &scale = stiffness.of(static_cast<std::int32_t>(i), visible);
    double part = visible;
    if (patch->slope_x != 0.0 || patch->slope_y != 0.0) {
      sheared.clear();
      for (std::size_t k = 0; k < cone.size(); ++k) {
        const Vec3 &ray = cone[k];
        sheared.add({ray.x + ray.z * patch->slope_x, ray.y + ray.z * patch->slope_y, ray.z});
      }
      part = sheared.solid_angle();
    }
    // The surfaces are at z = sense * own and -sense * other.
    part /= 2.0 * pi;
    corners.push_back({{v.at.x, v.at.y, 0.5 * side.sense() * (own - other)}, own + other, part * scale.value,
                       part * scale.slope});
  }
}

double area(const Vec3 &from, const Vec3 &to, const Vec3 &p) {
  return (to.x - from.x) * (p.y - from.y) - (to.y - from.y) * (p.x - from.x);
}

// Interpolates (Shepard) between the ends of two edges that cross, at the parts t and s of their ways.
Scratch::Stiffness between_ends(double t, const Scratch::Stiffness &at_t0, const Scratch::Stiffness &at_t1, double s,
                                const Scratch::Stiffness &at_s0, const Scratch::Stiffness &at_s1) {
  constexpr double smallest = 1e-28;
  const double a = 1.0 / (t * t + smallest), b = 1.0 / ((1.0 - t) * (1.0 - t) + smallest);
  const double c = 1.0 / (s * s + smallest), d = 1.0 / ((1.0 - s) * (1.0 - s) + smallest), sum = a + b + c + d;
  return {(a * at_t0.value + b * at_t1.value + c * at_s0.value + d * at_s1.value) / sum,
          (1.0 / sum) * (a * at_t0.slope + b * at_t1.slope + c * at_s0.slope + d * at_s1.slope)};
}

// The crossing of two edges, seen along the contact normal, if there is one.
void add_crossing(const Scratch::Border &e, const Scratch::Border &f, VertexStiffness &stiffness_a, VertexStiffness &stiffness_b,
                  DirectionCone &cone, std::vector<Scratch::Corner> &corners) {
  if (f.low_x > e.high_x || f.high_x < e.low_x || f.low_y > e.high_y || f.high_y < e.low_y) return;
  if ((area(f.shaken_from, f.shaken_to, e.shaken_from) > 0.0) ==
      (area(f.shaken_from, f.shaken_to, e.shaken_to) > 0.0)) {
    return;
  }
  if ((area(e.shaken_from, e.shaken_to, f.shaken_from) > 0.0) ==
      (area(e.shaken_from, e.shaken_to, f.shaken_to) > 0.0)) {
    return;
  }
  const Vec3 de = e.to - e.from, df = f.to - f.from, between = f.from - e.from;
  const double product = de.x * df.y - de.y * df.x;
  if (!(product * product > parallel_sine * parallel_sine * norm2(de) * norm2(df))) return;
  const double t = std::clamp((between.x * df.y - between.y * df.x) / product, 0.0, 1.0);
  const double s = std::clamp((between.x * de.y - between.y * de.x) / product, 0.0, 1.0);
  const Vec3 on_e = e.from + t * de, on_f = f.from + s * df;
  const double depth = on_e.z + on_f.z;
  if (!(depth > 0.0)) return;
  // Slopes add up: the cone's rays are the sums of both edges' directions, taken at the same z.
  cone.clear();
  for (const int corner : {0, 1, 3, 2}) {
    const Vec3 &p = e.ray[corner & 1], &q = f.ray[corner >> 1];
    const Vec3 ray{p.x * q.z + q.x * p.z, p.y * q.z + q.y * p.z, p.z * q.z};
    if (norm2(ray) > 0.0) cone.add(ray);
  }
  const double part = cone.solid_angle() / (2.0 * pi);
  const Vec3 middle{0.5 * (on_e.x + on_f.x), 0.5 * (on_e.y + on_f.y), 0.5 * (on_f.z - on_e.z)};
  const Scratch::Stiffness scale = between_ends(t, stiffness_a.of(e.vertex[0]), stiffness_a.of(e.vertex[1]), s,
                                                stiffness_b.of(f.vertex[0]), stiffness_b.of(f.vertex[1]));
  corners.push_back({middle, depth, part * scale.value, part * scale.slope});
}

// Edges whose extents along x overlap are found by a sweep.
void add_crossings(std::vector<Scratch::Border> &borders_a, std::vector<Scratch::Border> &borders_b,
                   VertexStiffness &stiffness_a, VertexStiffness &stiffness_b, DirectionCone &cone,
                   std::vector<Scratch::Corner> &corners) {
  const auto from_the_left = [](const Scratch::Border &x, const Scratch::Border &y) { return x.low_x < y.low_x; };
  std::sort(borders_a.begin(), borders_a.end(), from_the_left);
  std::sort(borders_b.begin(), borders_b.end(), from_the_left);
  std::size_t next_b = 0, next_a = 0;
  while (next_a < borders_a.size() && next_b < borders_b.size()) {
    if (borders_a[next_a].low_x <= borders_b[next_b].low_x) {
      const Scratch::Border &e = borders_a[next_a++];
      for (std::size_t k = next_b; k < borders_b.size() && borders_b[k].low_x <= e.high_x; ++k) {
        add_crossing(e, borders_b[k], stiffness_a, stiffness_b, cone, corners);
      }
    } else {
      const Scratch::Border &f = borders_b[next_b++];
      for (std::size_t k = next_a; k < borders_a.size() && borders_a[k].low_x <= f.high_x; ++k) {
        add_crossing(borders_a[k], f, stiffness_a, stiffness_b, cone, corners);
      }
    }
  }
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
  if (!(reach_a + reach_b > 0.0)) return;
  scratch.side_a.gather(a, a_in_axes, -1.0, -reach_b, {});
  scratch.side_b.gather(b, b_in_axes, 1.0, -reach_a, shake_of(size));
  find_patches(scratch.side_a, scratch.patches_a);
  find_patches(scratch.side_b, scratch.patches_b);
  find_borders(scratch.side_a, scratch.borders_a);
  find_borders(scratch.side_b, scratch.borders_b);
  // The contact normal turns with the body that has a face in it.
  const double lean_a = lean(scratch.side_a), lean_b = lean(scratch.side_b);
  const double part_of_a = lean_a + lean_b > 0.0 ? lean_b / (lean_a + lean_b) : 0.5;
  VertexStiffness stiffness_a(scratch.side_a, 1.0 - part_of_a, scratch.stiffness_a, scratch.cone),
      stiffness_b(scratch.side_b, part_of_a, scratch.stiffness_b, scratch.cone);
  scratch.corners.clear();
  add_vertices(scratch.side_a, stiffness_a, scratch.patches_b, scratch.cone, scratch.sheared_cone, scratch.corners);
  add_vertices(scratch.side_b, stiffness_b, scratch.patches_a, scratch.cone, scratch.sheared_cone, scratch.corners);
  add_crossings(scratch.borders_a, scratch.borders_b, stiffness_a, stiffness_b, scratch.cone, scratch.corners);

  double load = 0.0;
  Vec3 missing;
  for (const Scratch::Corner &corner : scratch.corners) {
    load += corner.weight * corner.depth;
    missing = missing + (0.5 * corner.depth * corner.depth) * corner.slope;
  }
  if (!(load > 0.0)) return;
  const Vec3 shift{missing.x / load, missing.y / load, 0.0};
  const std::size_t begin = points.size();
  for (const Scratch::Corner &corner : scratch.corners) {
    if (corner.weight > 0.0) points.push_back({corner.depth, corner.weight, normal, axes(corner.middle + shift)});
  }
  limit_load(points, begin);
}

}  // namespace cmb
