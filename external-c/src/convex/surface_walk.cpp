#include "surface_walk.hpp"

#include <algorithm>
#include <utility>

#include "nearby_surface.hpp"

namespace cmb::convex {

namespace {

constexpr std::size_t most_facets = 400, most_corners = 4000, mark_count = 8192;
constexpr std::size_t facets_before_girdle = 12;
// The girdle's slope towards the far side, and the facets' cosine to the lowest one from which on it is of no use.
constexpr double girdle_slope = 0.7, girdle_reach = 0.75;
constexpr int most_descents = 200;
// Edges at a smaller angle (its sine) count as parallel.
constexpr double parallel_sine = 1e-5;
// Bodies less deep in each other than this, times the scale, are left to others.
constexpr double touching = 1e-10;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

const Polytope &unit_box() {
  static const Polytope box = Polytope::box({2, 2, 2});
  return box;
}

Vec3 scaled(const Vec3 &scale, const Vec3 &v) { return {scale.x * v.x, scale.y * v.y, scale.z * v.z}; }

}  // namespace

SurfaceWalk::SurfaceWalk() : marks_(mark_count, Mark{0, 0, 0}) {
  corners_.reserve(most_corners);
  facets_.reserve(most_facets);
  sides_.reserve(most_corners);
  unit_box();  // not in a query
}

Vec3 SurfaceWalk::Body::vertex(std::int32_t v) const {
  return rotation * scaled(scale, polytope->vertices()[index(v)]) + shift;
}

Vec3 SurfaceWalk::Body::normal(std::int32_t face) const { return rotation * polytope->faces()[index(face)].normal; }

Vec3 SurfaceWalk::Body::local(const Vec3 &d) const { return scaled(scale, transposed_times(rotation, d)); }

Vec3 SurfaceWalk::Body::way(std::int32_t from, std::int32_t to) const {
  return rotation * scaled(scale, polytope->vertices()[index(to)] - polytope->vertices()[index(from)]);
}

// The facet of a face of one body at the vertex of the other where side q begins. The first side is q turned back.
bool SurfaceWalk::facet_of_face(const Corner &q, const Vec3 &q_end, std::int32_t face, Facet &facet) {
  const std::int32_t body = q.body;
  const Body &owner = body_[body];
  const Polytope &polytope = *owner.polytope;
  const Polytope::Face &whole = polytope.faces()[index(face)];
  if (corners_.size() + index(whole.count) > most_corners) return false;
  facet.normal = owner.normal(face);
  facet.first = static_cast<std::int32_t>(corners_.size());
  facet.count = whole.count;
  // Where the face's own turn has the side's edge; a mirrored body's corners come in the opposite turn.
  const std::int32_t *const edges = polytope.face_edges().data() + whole.first;
  const std::int32_t *const vertices = polytope.face_vertices().data() + whole.first;
  std::int32_t begin = 0;
  while (edges[begin] != q.edge) ++begin;
  const std::int32_t turn = owner.mirrored ? -1 : 1;
  const std::int32_t begin_vertex = polytope.edges()[index(q.edge)].vertex[q.forward ? 1 : 0];
  std::int32_t at = vertices[begin] == begin_vertex ? begin : begin + 1 == whole.count ? 0 : begin + 1;
  corners_.resize(corners_.size() + index(whole.count));
  Corner *corner = corners_.data() + facet.first;
  for (std::int32_t k = 0; k < whole.count; ++k, ++corner) {
    const std::int32_t vertex = vertices[at];
    std::int32_t next = at + turn;
    next = next < 0 ? whole.count - 1 : next == whole.count ? 0 : next;
    const std::int32_t edge = edges[owner.mirrored ? next : at];
    corner->at = k == 0 ? q_end : k == 1 ? q.at : q_end + owner.way(begin_vertex, vertex);
    corner->vertex[body] = vertex, corner->vertex[1 - body] = q.vertex[1 - body];
    corner->body = body, corner->edge = edge;
    corner->forward = polytope.edges()[index(edge)].vertex[0] == vertex;
    at = next;
  }
  facet.height = dot(facet.normal, q.at);
  return true;
}

// The facet that side q's edge spans with an edge of the other body, which leads from q's vertex of that to `far_vertex`.
bool SurfaceWalk::facet_of_edges(const Corner &q, const Vec3 &q_end, std::int32_t q_end_vertex, std::int32_t other_edge,
                                 std::int32_t far_vertex, Facet &facet) {
  if (corners_.size() + 4 > most_corners) return false;
  const std::int32_t body = q.body, other = 1 - body, near_vertex = q.vertex[other];
  const Vec3 back = q.at - q_end, way = body_[other].way(near_vertex, far_vertex), across = cross(back, way);
  const double length2 = norm2(across);
  if (!(length2 > parallel_sine * parallel_sine * norm2(back) * norm2(way))) return false;
  facet.normal = (1.0 / std::sqrt(length2)) * across;
  facet.height = dot(facet.normal, q.at);
  facet.first = static_cast<std::int32_t>(corners_.size());
  facet.count = 4;
  corners_.resize(corners_.size() + 4);
  Corner *const corner = corners_.data() + facet.first;
  const bool way_forward = body_[other].polytope->edges()[index(other_edge)].vertex[0] == near_vertex;
  const auto set = [&](int k, const Vec3 &at, std::int32_t own, std::int32_t others, bool along, bool forward) {
    corner[k].at = at;
    corner[k].vertex[body] = own, corner[k].vertex[other] = others;
    corner[k].body = along ? body : other, corner[k].edge = along ? q.edge : other_edge, corner[k].forward = forward;
  };
  set(0, q_end, q_end_vertex, near_vertex, true, !q.forward);
  set(1, q.at, q.vertex[body], near_vertex, false, way_forward);
  set(2, q.at + way, q.vertex[body], far_vertex, true, q.forward);
  set(3, q_end + way, q_end_vertex, far_vertex, false, !way_forward);
  return true;
}

// The facet across side q, which ends at `q_end`: the one that is met first on the arc of its edge's directions from
// `from`, one of the other body's vertex, to that of the edge's face beyond. The facet's first side is q turned back.
bool SurfaceWalk::cross_side(const Corner &q, const Vec3 &q_end, const Vec3 &from, Facet &facet) {
  // Seen from outside, beyond the side is the edge's face to the right.
  const Polytope::Edge &edge = body_[q.body].polytope->edges()[index(q.edge)];
  const std::int32_t face = edge.face[q.forward != body_[q.body].mirrored ? 1 : 0];
  const Body &other = body_[1 - q.body];
  const Polytope &polytope = *other.polytope;
  const std::int32_t other_vertex = q.vertex[1 - q.body];
  const Vec3 local_from = other.local(from), local_to = other.local(body_[q.body].normal(face));
  const std::int32_t end = polytope.neighbour_begin(other_vertex + 1);
  double first = 2.0;
  std::int32_t leaving = -1;
  for (std::int32_t slot = polytope.neighbour_begin(other_vertex); slot < end; ++slot) {
    const Vec3 &way = polytope.neighbour_ways()[index(slot)];
    const double before = dot(local_from, way), after = dot(local_to, way);
    const double part = before / (before - after);
    const bool sooner = (after > 0.0) & (part < first);
    first = sooner ? part : first;
    leaving = sooner ? slot : leaving;
  }
  if (leaving < 0) return facet_of_face(q, q_end, face, facet);
  return facet_of_edges(q, q_end, edge.vertex[q.forward ? 1 : 0], polytope.neighbour_edges()[index(leaving)],
                        polytope.neighbours()[index(leaving)], facet);
}

// A facet at the vertex of C that is farthest along `first`, in the direction in which the support function falls. False
// where there is none, or the bodies are apart along `first`, which `apart` tells then.
bool SurfaceWalk::start(const Vec3 &first, Facet &facet, Vec3 &apart) {
  std::int32_t vertex[2];
  for (int k = 0; k < 2; ++k) vertex[k] = body_[k].polytope->support_vertex(body_[k].local(first));
  const Vec3 top = body_[0].vertex(vertex[0]) + body_[1].vertex(vertex[1]);
  const double height = dot(first, top), length2 = norm2(first);
  if (!(height > 0.0)) {
    apart = first;
    return false;
  }
  Vec3 turn = (height / length2) * first - top;
  if (!(norm2(turn) > 1e-12 * norm2(top))) turn = norm(top) * any_perpendicular((1.0 / std::sqrt(length2)) * first);
  double soonest = HUGE_VAL;
  std::int32_t body = 0, leaving = -1;
  for (int k = 0; k < 2; ++k) {
    const Polytope &polytope = *body_[k].polytope;
    const Vec3 local_first = body_[k].local(first), local_turn = body_[k].local(turn);
    const std::int32_t end = polytope.neighbour_begin(vertex[k] + 1);
    for (std::int32_t slot = polytope.neighbour_begin(vertex[k]); slot < end; ++slot) {
      const Vec3 &way = polytope.neighbour_ways()[index(slot)];
      const double rate = dot(local_turn, way), at = -dot(local_first, way) / rate;
      const bool sooner = (rate > 0.0) & (at < soonest);
      soonest = sooner ? at : soonest;
      body = sooner ? k : body, leaving = sooner ? slot : leaving;
    }
  }
  if (leaving < 0) return false;
  const Polytope &owner = *body_[body].polytope;
  Corner side;
  side.at = top;
  side.vertex[0] = vertex[0], side.vertex[1] = vertex[1];
  side.body = body, side.edge = owner.neighbour_edges()[index(leaving)];
  const Polytope::Edge &edge = owner.edges()[index(side.edge)];
  side.forward = edge.vertex[0] == vertex[body];
  Vec3 side_end = top + body_[body].way(vertex[body], owner.neighbours()[index(leaving)]);
  // Of the edge's faces towards the nearer one: that beyond the side, or beyond the same side turned back.
  const std::int32_t beyond = side.forward != body_[body].mirrored ? 1 : 0;
  if (dot(body_[body].normal(edge.face[1 - beyond]), top) < dot(body_[body].normal(edge.face[beyond]), top)) {
    side.vertex[body] = owner.neighbours()[index(leaving)];
    side.forward = !side.forward;
    std::swap(side.at, side_end);
  }
  return cross_side(side, side_end, first + soonest * turn, facet);
}

// Goes on to nearer facets until one holds the origin's foot.
bool SurfaceWalk::descend(Facet &facet) {
  for (int step = 0; step < most_descents && facet.height > 0.0; ++step) {
    const Corner *const corner = corners_of(facet);
    double farthest = 0.0;
    std::int32_t beyond = -1;
    for (std::int32_t k = 0; k < facet.count; ++k) {
      const Vec3 &p = corner[k].at, &q = corner[k + 1 == facet.count ? 0 : k + 1].at;
      const double area = dot(facet.normal, cross(p, q));
      if (area < farthest) farthest = area, beyond = k;
    }
    if (beyond < 0) return true;
    Facet next;
    const Corner side = corner[beyond];
    const Vec3 side_end = corner[beyond + 1 == facet.count ? 0 : beyond + 1].at;
    corners_.clear();
    if (!cross_side(side, side_end, facet.normal, next) || !(next.height < facet.height)) return false;
    facet = next;
  }
  return false;
}

// Adds the sides of a facet from the one numbered `k` on. Each side belongs to two facets, which run along it in opposite
// directions.
bool SurfaceWalk::add_sides(const Facet &facet, std::int32_t number, std::int32_t k) {
  for (; k < facet.count; ++k) {
    const Corner &corner = corners_[index(facet.first + k)];
    const std::uint64_t key = static_cast<std::uint64_t>(corner.body) << 62 |
                              static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.edge)) << 31 |
                              static_cast<std::uint64_t>(static_cast<std::uint32_t>(corner.vertex[1 - corner.body]));
    std::size_t at = static_cast<std::size_t>((key * 0x9e3779b97f4a7c15u) >> 51);
    while (marks_[at].growth == growth_ && marks_[at].key != key) at = (at + 1) % mark_count;
    if (marks_[at].growth != growth_) {
      marks_[at] = {key, growth_, static_cast<std::int32_t>(sides_.size())};
      sides_.push_back({number, facet.first + k, false});
      continue;
    }
    Side &known = sides_[index(marks_[at].side)];
    if (known.inner || corners_[index(known.corner)].forward == corner.forward) return false;
    known.inner = true;
  }
  return true;
}

// The points of C that close the surface: one on the far side, or a girdle half way to that as well.
SurfaceWalk::Closure::Closure(const MinkowskiDifference &difference, const Facet &lowest, double radius)
    : difference_(difference), radius2_(radius * radius), normal_(lowest.normal),
      far_(difference.support(-lowest.normal).w) {}

// Seen from outside p, q and r are in counter-clockwise turn: whether the origin is below their plane by the radius.
bool SurfaceWalk::Closure::is_beyond(const Vec3 &p, const Vec3 &q, const Vec3 &r) const {
  const Vec3 across = cross(q - p, r - p);
  const double offset = dot(across, p);
  return offset > 0.0 && offset * offset >= radius2_ * norm2(across);
}

// False where the girdle itself is not beyond the ball.
bool SurfaceWalk::Closure::put_girdle() {
  constexpr double cosine[girdle_points] = {1.0, 0.5, -0.5, -1.0, -0.5, 0.5}, half_root3 = 0.86602540378443865;
  constexpr double sine[girdle_points] = {0.0, half_root3, half_root3, 0.0, -half_root3, -half_root3};
  across_[0] = any_perpendicular(normal_);
  across_[1] = cross(normal_, across_[0]);
  for (int k = 0; k < girdle_points; ++k) {
    girdle_[k] = difference_.support(girdle_slope * normal_ + cosine[k] * across_[0] + sine[k] * across_[1]).w;
  }
  for (int k = 0; k < girdle_points; ++k) {
    if (!is_beyond(girdle_[k], far_, girdle_[k + 1 == girdle_points ? 0 : k + 1])) return false;
  }
  with_girdle_ = true;
  return true;
}

// The girdle's point nearest to a direction, by the turn about the normal.
int SurfaceWalk::Closure::sector(const Vec3 &p) const {
  // Bounds of sectors are at odd twelfths of a turn: signs of three products.
  constexpr double root3 = 1.7320508075688773;
  const double x = dot(p, across_[0]), y = dot(p, across_[1]);
  const int bits = (x >= 0.0 ? 1 : 0) | (x + root3 * y >= 0.0 ? 2 : 0) | (x - root3 * y >= 0.0 ? 4 : 0);
  static constexpr int sectors[8] = {3, 0, 2, 1, 4, 5, 0, 0};
  return sectors[bits];
}

// The part of the closure at a side of the facets found, from p to q, is made of triangles from it to the far point or the
// girdle.
bool SurfaceWalk::Closure::holds(const Vec3 &p, const Vec3 &q) const {
  if (!with_girdle_) return is_beyond(q, p, far_);
  const int first = sector(p), last = sector(q);
  if (!is_beyond(q, p, girdle_[first])) return false;
  int at = first;
  for (int steps = 0; at != last; ++steps) {
    if (steps == girdle_points / 2) return false;  // it would lead backwards
    const int next = at + 1 == girdle_points ? 0 : at + 1;
    if (!is_beyond(q, girdle_[at], girdle_[next])) return false;
    at = next;
  }
  return true;
}

// How often the triangles at a side lead from each point of the girdle to the next: once all round, the closure is closed.
void SurfaceWalk::Closure::count_steps(const Vec3 &p, const Vec3 &q, int steps[girdle_points]) const {
  for (int at = sector(p), last = sector(q); at != last; at = at + 1 == girdle_points ? 0 : at + 1) ++steps[at];
}

bool SurfaceWalk::is_closed(const Closure &closure) const {
  if (!closure.with_girdle()) return true;
  int steps[Closure::girdle_points] = {};
  bool open = false;
  for (const Side &side : sides_) {
    if (side.inner) continue;
    open = true;
    closure.count_steps(corners_[index(side.corner)].at, end_of(side), steps);
  }
  return !open || std::all_of(steps, steps + Closure::girdle_points, [](int count) { return count == 1; });
}

const Vec3 &SurfaceWalk::end_of(const Side &side) const {
  const Facet &facet = facets_[index(side.facet)];
  return corners_[index(side.corner + 1 == facet.first + facet.count ? facet.first : side.corner + 1)].at;
}

// Adds facets round the lowest one until no other can be within the ball. `lowest` is exchanged, and the growth to be done
// again, where the outcome is `apart`.
SurfaceWalk::Outcome SurfaceWalk::grow(const MinkowskiDifference &difference, double size, Facet &lowest) {
  const double radius = size > 0.0 ? surface_reach(lowest.height, size) : lowest.height;
  const double slack = 1e-15 * difference.scale;
  Closure closure(difference, lowest, radius);
  bool girdle_tried = false;
  if (++growth_ == 0) {
    std::fill(marks_.begin(), marks_.end(), Mark{0, 0, 0});
    growth_ = 1;
  }
  facets_.clear();
  sides_.clear();
  facets_.push_back(lowest);
  if (!add_sides(lowest, 0, 0)) return Outcome::undecided;
  for (std::size_t k = 0;; ++k) {
    if (k == sides_.size()) {
      if (is_closed(closure)) return Outcome::found;
      closure.leave_girdle();
      k = 0;
    }
    if (sides_[k].inner) continue;
    const Corner corner = corners_[index(sides_[k].corner)];
    const Vec3 end = end_of(sides_[k]);
    if (closure.holds(corner.at, end)) continue;
    if (facets_.size() == most_facets) return Outcome::undecided;
    // The girdle takes some facets' time.
    if (facets_.size() >= facets_before_girdle && !girdle_tried) {
      girdle_tried = true;
      if (closure.put_girdle()) {
        k = static_cast<std::size_t>(-1);
        continue;
      }
    }
    const Vec3 from = facets_[index(sides_[k].facet)].normal;
    Facet next;
    sides_[k].inner = true;
    if (!cross_side(corner, end, from, next) || !(next.height > 0.0)) return Outcome::undecided;
    if (next.height < lowest.height - slack) {
      lowest = next;
      return Outcome::apart;
    }
    facets_.push_back(next);
    if (closure.with_girdle() && dot(next.normal, lowest.normal) < girdle_reach) {
      closure.leave_girdle();
      k = static_cast<std::size_t>(-1);
    }
    if (!add_sides(next, static_cast<std::int32_t>(facets_.size()) - 1, 1)) return Outcome::undecided;
  }
}

void SurfaceWalk::find_witness(const Facet &facet, Result &result) const {
  const Corner *const corner = corners_of(facet);
  const Vec3 gap = facet.height * facet.normal;
  if (corner[0].body == corner[1].body) {
    const std::int32_t owner = corner[0].body;
    const Vec3 at = body_[1 - owner].vertex(corner[0].vertex[1 - owner]);
    result.b = owner == 0 ? -at : at - gap;
    result.a = result.b + gap;
    return;
  }
  // Where the edges come nearest to each other.
  const std::int32_t edge_a = corner[corner[0].body == 0 ? 0 : 1].edge, edge_b = corner[corner[0].body == 0 ? 1 : 0].edge;
  const std::int32_t *const a = body_[0].polytope->edges()[index(edge_a)].vertex;
  const std::int32_t *const b = body_[1].polytope->edges()[index(edge_b)].vertex;
  const Vec3 a0 = body_[0].vertex(a[0]), along_a = body_[0].vertex(a[1]) - a0;
  const Vec3 b0 = -body_[1].vertex(b[0]), along_b = -body_[1].vertex(b[1]) - b0;
  const Vec3 side = cross(along_b, facet.normal);
  result.a = a0 + std::clamp(dot(b0 - a0, side) / dot(along_a, side), 0.0, 1.0) * along_a;
  result.b = result.a - gap;
}

void SurfaceWalk::find_mean(const Facet &lowest, double radius, Result &result) const {
  std::int32_t count = 0;
  for (const Facet &facet : facets_) count += facet.height < radius && norm2(facet.normal - lowest.normal) > same_normal2;
  result.mean_outward = lowest.normal;
  if (count == 0) return;
  result.mean_outward = {};
  for (const Facet &facet : facets_) {
    if (!(facet.height < radius)) continue;
    FacetIntegral integral(facet.normal, facet.height, radius);
    const Corner *const corner = corners_of(facet);
    for (std::int32_t k = 0; k < facet.count; ++k) {
      integral.add_edge(corner[k].at, corner[k + 1 == facet.count ? 0 : k + 1].at);
    }
    result.mean_outward = result.mean_outward + integral.value() * facet.normal;
  }
}

SurfaceWalk::Outcome SurfaceWalk::way_out(const MinkowskiDifference &difference, const Vec3 &first, double size,
                                          Result &result) {
  const auto polytope = [](const ConvexBody &body) { return body.core == CoreShape::box ? &unit_box() : body.polytope; };
  const auto scale = [](const ConvexBody &body) { return body.core == CoreShape::box ? body.half : Vec3{1, 1, 1}; };
  const Pose &pose = difference.b_in_a;
  const Mat3 turned{{-pose.rotation.row[0], -pose.rotation.row[1], -pose.rotation.row[2]}};
  body_[0] = {polytope(difference.body_a), scale(difference.body_a), Mat3{}, {}, false};
  body_[1] = {polytope(difference.body_b), scale(difference.body_b), turned, -pose.translation, true};
  corners_.clear();
  Facet lowest;
  if (!start(first, lowest, result.direction)) {
    return norm2(result.direction) > 0.0 ? Outcome::apart : Outcome::undecided;
  }
  for (int growths = 0; growths < 20; ++growths) {
    if (!descend(lowest)) {
      if (lowest.height > 0.0) return Outcome::undecided;
      result.direction = lowest.normal;
      return Outcome::apart;
    }
    if (!(lowest.height > touching * difference.scale)) return Outcome::undecided;
    const Outcome outcome = grow(difference, size, lowest);
    if (outcome == Outcome::undecided) return outcome;
    if (outcome == Outcome::apart) continue;
    result.direction = lowest.normal;
    result.depth = dot(difference.support(lowest.normal).w, lowest.normal);
    if (!(result.depth <= lowest.height + 1e-14 * difference.scale)) return Outcome::undecided;
    find_witness(lowest, result);
    if (size > 0.0) find_mean(lowest, surface_reach(lowest.height, size), result);
    return outcome;
  }
  return Outcome::undecided;
}

}  // namespace cmb::convex
