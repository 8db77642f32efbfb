#include "manifold/polytope/penetration_profile.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"
#include "math/index.hpp"

namespace cmb {

namespace {

constexpr double inverse_hemisphere = 0.5 / 3.14159265358979323846;
// Which corners lie where is decided as if one body had been perturbed: moved a little, so that no two edges are parallel and
// no corner is flush with an edge. Depths and positions are those of the true pose.
// The perturbation, in rad and in sizes of the bodies: large beside rounding, small beside anything else; of no special
// direction.
constexpr double perturbation_size = 1e-11;
// Edges that cross at a smaller angle (its sine) count as parallel.
constexpr double parallel_sine = 1e-9;
// Slopes that change a cone by rounding only.
constexpr double level_slope = 1e-15;
// Up to so many pairs of edges sorting takes longer than comparing all.
constexpr std::size_t few_pairs = 1000;
// How far beyond the other body's extent, in sizes, edges and corners are still looked at: the perturbation moves the
// crossing of edges at the angle e by perturbation_size / e, and what is so nearly parallel that it moves farther weighs
// nothing.
constexpr double margin = 1e-3;

Perturbation perturbation_of(double size) {
  return {{0.53 * perturbation_size, -0.31 * perturbation_size, 0.79 * perturbation_size},
          {0.61 * perturbation_size * size, 0.37 * perturbation_size * size, -0.17 * perturbation_size * size}};
}

Extent common(const Extent &a, const Extent &b, double beyond) {
  // By value: of references compilers make branches.
  const double low_x = a.low_x > b.low_x ? a.low_x : b.low_x, high_x = a.high_x < b.high_x ? a.high_x : b.high_x;
  const double low_y = a.low_y > b.low_y ? a.low_y : b.low_y, high_y = a.high_y < b.high_y ? a.high_y : b.high_y;
  return {low_x - beyond, high_x + beyond, low_y - beyond, high_y + beyond};
}

// Cuts the arc between two faces' directions at the hemisphere's border; false where nothing is left.
bool cut_arc(Vec3 &first, Vec3 &second) {
  if (first.z <= 0.0 && second.z <= 0.0) return false;
  if (first.z < 0.0) first = second.z * first - first.z * second, first.z = 0.0;
  if (second.z < 0.0) second = first.z * second - second.z * first, second.z = 0.0;
  return true;
}

// How much an edge's end at the part t of its length counts beside the edges; the farther end never does.
double end_influence(double t) {
  constexpr double reach = 0.25, smallest = 1e-14;
  if (!(t < reach)) return 0.0;
  const double ratio = (reach - t) / (t + smallest);
  return ratio * ratio;
}

// Between an edge's faces, which are at the angles with the contact plane whose cosines are the normals' z.
Stiffness edge_stiffness(const ContactPolytope::EdgeStiffness &faces, const Vec3 &first, const Vec3 &second,
                         double turning) {
  constexpr double smallest = 1e-28;
  if (faces.in_face[0] == faces.in_face[1]) return {faces.in_face[0], {}};
  const double u = 1.0 - first.z, v = 1.0 - second.z, part = 1.0 / (u * u + v * v + smallest);
  const double value = (faces.in_face[0] * (v * v) + faces.in_face[1] * (u * u)) * part;
  const double by_first = -2.0 * turning * part * u * (faces.in_face[1] - value);
  const double by_second = -2.0 * turning * part * v * (faces.in_face[0] - value);
  return {value, by_first * first + by_second * second};
}

}  // namespace

void PenetrationProfile::Lines::gather(const ContactSide &side, const Extent &region, double beyond) {
  const std::size_t edges = side.edge_count();
  if (found.size() < edges) found.resize(edges), ridges.resize(edges);
  // Which edges are within is unpredictable: they are sieved without a branch.
  if (within.size() <= edges) within.resize(edges + 1);
  count = 0;
  for (std::size_t i = 0; i < edges; ++i) {
    within[count] = static_cast<std::int32_t>(i);
    count += static_cast<std::size_t>(side.edge(i).extent.meets(region));
  }
  const double *const seen_x = side.seen_x(), *const seen_y = side.seen_y();
  for (std::size_t k = 0; k < count; ++k) {
    const ContactSide::Edge &edge = side.edge(index(within[k]));
    const std::size_t from = index(edge.vertex[0]), to = index(edge.vertex[1]);
    Line &line = found[k];
    line.extent.low_x = edge.extent.low_x - beyond, line.extent.high_x = edge.extent.high_x + beyond;
    line.extent.low_y = edge.extent.low_y - beyond, line.extent.high_y = edge.extent.high_y + beyond;
    line.from_x = seen_x[from], line.from_y = seen_y[from], line.to_x = seen_x[to], line.to_y = seen_y[to];
    // Of what is too high nothing crosses deep enough.
    const double from_z = side.height(from), to_z = side.height(to);
    line.highest = from_z > to_z ? from_z : to_z;
    line.edge = within[k];
    ridges[index(within[k])].known = false;
  }
}

const PenetrationProfile::Ridge *PenetrationProfile::Lines::ridge(const ContactSide &side, std::int32_t edge, double turning) {
  Ridge &ridge = ridges[index(edge)];
  if (!ridge.known) {
    const std::int32_t number = side.edge(index(edge)).number;
    const convex::Polytope &geometry = side.body().geometry();
    const std::int32_t *const face = geometry.edges()[index(number)].face;
    const convex::Mat3 &rotation = side.to_side().rotation;
    Vec3 first = rotation * geometry.faces()[index(face[0])].normal, second = rotation * geometry.faces()[index(face[1])].normal;
    ridge.known = true;
    ridge.visible = (first.z > wall_cosine) | (second.z > wall_cosine);
    if (ridge.visible) {
      ridge.stiffness = edge_stiffness(side.body().edge_stiffness(number), first, second, turning);
      ridge.visible = cut_arc(first, second);
      ridge.directions = {first, second};
    }
  }
  return ridge.visible ? &ridge : nullptr;
}

void PenetrationProfile::Lines::sort() {
  order.clear();
  for (std::size_t k = 0; k < count; ++k) order.emplace_back(found[k].extent.low_x, static_cast<std::int32_t>(k));
  std::sort(order.begin(), order.end());
  ordered.clear();
  for (const auto &[low, k] : order) ordered.push_back(found[index(k)]);
}

void PenetrationProfile::place(const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
                               const Pose &b_in_axes) {
  size_ = a.geometry().radius() + b.geometry().radius();
  // A lies above: it is mirrored, so that the depth is the sum of both heights.
  Pose mirrored = a_in_axes;
  mirrored.rotation.row[2] = -mirrored.rotation.row[2];
  mirrored.translation.z = -mirrored.translation.z;
  side_a_.place(a, mirrored, {});
  side_b_.place(b, b_in_axes, perturbation_of(size_));
  turning_a_ = 0.5;
  if (!a.shares_are_constant() || !b.shares_are_constant()) {
    // The contact normal turns with the body that has a face in it.
    const double lean_a = side_a_.lean(), lean_b = side_b_.lean();
    if (lean_a + lean_b > 0.0) turning_a_ = lean_a / (lean_a + lean_b);
  }
}

void PenetrationProfile::find_corners(double level) {
  corners_.clear();
  level_ = level;
  side_a_.gather(level - side_b_.reach());
  side_b_.gather(level - side_a_.reach());
  region_ = common(side_a_.extent(), side_b_.extent(), margin * size_);
  if (!(region_.low_x <= region_.high_x && region_.low_y <= region_.high_y)) return;
  stiffness_a_.start(side_a_, turning_a_);
  stiffness_b_.start(side_b_, 1.0 - turning_a_);
  add_vertices(side_a_, stiffness_a_, side_b_, -1.0);
  add_vertices(side_b_, stiffness_b_, side_a_, 1.0);
  add_crossings();
}

// Vertices of one side over faces of the other; `sense` is the contact normal along the side's z axis.
void PenetrationProfile::add_vertices(const ContactSide &side, VertexStiffness &stiffness, ContactSide &other_side,
                                      double sense) {
  const convex::Mat3 &rotation = side.to_side().rotation;
  const double slack = 3e3 * perturbation_size * size_;
  const double *const seen_x = side.seen_x(), *const seen_y = side.seen_y();
  ContactSide::Plane plane;
  for (std::size_t k = 0; k < side.inside_count(); ++k) {
    const std::int32_t i = side.inside(k);
    const Vec3 at = side.at(index(i));
    if (!region_.holds(at)) continue;
    if (!other_side.face_over(seen_x[i], seen_y[i], at.z, level_, slack, plane)) continue;
    const double other = plane.over(at), depth = at.z + other;
    if (!(depth > level_)) continue;
    // Slopes add up: the cone over the face is sheared.
    const std::int32_t v = side.number(index(i));
    const bool whole = visible_cone(side, v,
                                    {{rotation.row[0] + plane.slope_x * rotation.row[2],
                                      rotation.row[1] + plane.slope_y * rotation.row[2], rotation.row[2]}},
                                    cone_);
    if (cone_.empty()) continue;
    const bool level = std::fabs(plane.slope_x) + std::fabs(plane.slope_y) <= level_slope;
    const double part = level && whole ? side.body().normal_cone(v) : cone_.solid_angle();
    // The surfaces are at sense * own height and -sense * the other's.
    add_corner(at.x, at.y, 0.5 * sense * (at.z - other), depth, part * inverse_hemisphere,
               stiffness.of(i));
  }
}

// Written member by member: objects put together on the stack and copied as a whole would wait for the store.
void PenetrationProfile::add_corner(double x, double y, double z, double depth, double part, const Stiffness &scale) {
  corners_.emplace_back();
  Corner &corner = corners_.back();
  corner.middle.x = x, corner.middle.y = y, corner.middle.z = z;
  corner.depth = depth;
  corner.weight = part * scale.value;
  corner.slope.x = part * scale.slope.x, corner.slope.y = part * scale.slope.y, corner.slope.z = part * scale.slope.z;
}

// Of two edges, one of each side, that cross as seen along the contact normal. Returns whether they cross deep enough, which
// is unpredictable: no branch.
bool PenetrationProfile::find_crossing(std::int32_t edge_a, std::int32_t edge_b, Crossing &crossing) const {
  const ContactSide::Edge &e = side_a_.edge(index(edge_a)), &f = side_b_.edge(index(edge_b));
  const Vec3 from_e = side_a_.at(index(e.vertex[0])), from_f = side_b_.at(index(f.vertex[0]));
  const Vec3 de = side_a_.at(index(e.vertex[1])) - from_e, df = side_b_.at(index(f.vertex[1])) - from_f;
  const Vec3 between = from_f - from_e;
  const double product = de.x * df.y - de.y * df.x;
  const bool angled = product * product > parallel_sine * parallel_sine * norm2(de) * norm2(df);
  const double inverse = 1.0 / product;
  const double t = convex::within_unit((between.x * df.y - between.y * df.x) * inverse);
  const double s = convex::within_unit((between.x * de.y - between.y * de.x) * inverse);
  const Vec3 on_e = from_e + t * de, on_f = from_f + s * df;
  crossing.edge_a = edge_a, crossing.edge_b = edge_b;
  crossing.t = t, crossing.s = s;
  crossing.x = 0.5 * (on_e.x + on_f.x), crossing.y = 0.5 * (on_e.y + on_f.y), crossing.z = 0.5 * (on_f.z - on_e.z);
  crossing.depth = on_e.z + on_f.z;
  return angled & (crossing.depth > level_);
}

void PenetrationProfile::add_crossing(const Crossing &crossing) {
  const Ridge *const of_a = lines_a_.ridge(side_a_, crossing.edge_a, turning_a_);
  if (of_a == nullptr) return;
  const Ridge *const of_b = lines_b_.ridge(side_b_, crossing.edge_b, 1.0 - turning_a_);
  if (of_b == nullptr) return;
  Stiffness sum{of_a->stiffness.value + of_b->stiffness.value, of_a->stiffness.slope + of_b->stiffness.slope};
  double influences = 2.0;
  const auto add_nearer_end = [&](VertexStiffness &stiffness, const ContactSide::Edge &edge, double way) {
    const double influence = end_influence(std::min(way, 1.0 - way));
    if (!(influence > 0.0)) return;
    const Stiffness &end = stiffness.of(edge.vertex[way > 0.5 ? 1 : 0]);
    influences += influence;
    sum.value += influence * end.value;
    sum.slope = sum.slope + influence * end.slope;
  };
  add_nearer_end(stiffness_a_, side_a_.edge(index(crossing.edge_a)), crossing.t);
  add_nearer_end(stiffness_b_, side_b_.edge(index(crossing.edge_b)), crossing.s);
  const double part = parallelogram_solid_angle(of_a->directions, of_b->directions) * inverse_hemisphere;
  add_corner(crossing.x, crossing.y, crossing.z, crossing.depth, part / influences, sum);
}

void PenetrationProfile::add_crossings() {
  const double beyond = margin * size_;
  lines_a_.gather(side_a_, region_, beyond);
  if (lines_a_.count == 0) return;
  lines_b_.gather(side_b_, region_, beyond);
  if (lines_b_.count == 0) return;
  const std::size_t near = lines_a_.count * lines_b_.count <= few_pairs ? compare_all() : sweep();
  // Which of those that are near cross is unpredictable too.
  std::size_t crossing = 0;
  for (std::size_t k = 0; k < near; ++k) {
    const LinePair pair = near_[k];
    near_[crossing] = pair;
    crossing += static_cast<std::size_t>(pair.a->parts(*pair.b) & pair.b->parts(*pair.a));
  }
  if (crossings_.size() <= crossing) crossings_.resize(crossing + 1);
  std::size_t deep = 0;
  for (std::size_t k = 0; k < crossing; ++k) {
    deep += static_cast<std::size_t>(find_crossing(near_[k].a->edge, near_[k].b->edge, crossings_[deep]));
  }
  for (std::size_t k = 0; k < deep; ++k) add_crossing(crossings_[k]);
}

// Puts down which of the lines from `first` on may cross the `own` one deep enough. That is unpredictable: all are put
// down, and kept or overwritten. There has to be room for one more than all; the new count of pairs is returned.
template <bool own_is_of_a>
inline std::size_t PenetrationProfile::compare(const Line *own, const Line *first, const Line *last, std::size_t count) {
  LinePair *const near = near_.data();
  const Extent extent = own->extent;
  const double enough = level_ - own->highest;
  for (; first != last; ++first) {
    near[count].a = own_is_of_a ? own : first, near[count].b = own_is_of_a ? first : own;
    count += static_cast<std::size_t>((first->highest > enough) & extent.meets(first->extent));
  }
  return count;
}

std::size_t PenetrationProfile::compare_all() {
  const std::size_t most = lines_a_.count * lines_b_.count;
  if (near_.size() <= most) near_.resize(most + 1);
  const Line *const b = lines_b_.found.data(), *const end_b = b + lines_b_.count;
  std::size_t count = 0;
  for (std::size_t k = 0; k < lines_a_.count; ++k) count = compare<true>(&lines_a_.found[k], b, end_b, count);
  return count;
}

// Lines whose extents along x overlap are found by a sweep.
std::size_t PenetrationProfile::sweep() {
  lines_a_.sort();
  lines_b_.sort();
  const Line *a = lines_a_.ordered.data(), *b = lines_b_.ordered.data();
  const Line *const end_a = a + lines_a_.ordered.size(), *const end_b = b + lines_b_.ordered.size();
  const auto before = [](double x, const Line &line) { return x < line.extent.low_x; };
  std::size_t count = 0;
  while (a != end_a && b != end_b) {
    const std::size_t most = count + static_cast<std::size_t>(std::max(end_a - a, end_b - b));
    if (near_.size() <= most) near_.resize(2 * most);
    if (a->extent.low_x <= b->extent.low_x) {
      count = compare<true>(a, b, std::upper_bound(b, end_b, a->extent.high_x, before), count);
      ++a;
    } else {
      count = compare<false>(b, a, std::upper_bound(a, end_a, b->extent.high_x, before), count);
      ++b;
    }
  }
  return count;
}

}  // namespace cmb
