#include "narrowphase/polytope/difference_facets.hpp"

#include <algorithm>
#include <utility>

#include "math/branchless.hpp"
#include "math/index.hpp"

namespace cmb::convex {

namespace {

// Edges at a smaller angle (its sine) count as parallel.
constexpr double parallel_sine = 1e-5;

const Polytope &unit_box() {
  static const Polytope box = Polytope::box({2, 2, 2});
  return box;
}

Vec3 scaled(const Vec3 &scale, const Vec3 &v) { return {scale.x * v.x, scale.y * v.y, scale.z * v.z}; }

}  // namespace

DifferenceFacets::DifferenceFacets() : corners_(most_corners) {
  unit_box();  // not in a query
}

DifferenceFacets::Corner *DifferenceFacets::add_corners(std::int32_t count) {
  if (corner_count_ + count > most_corners) return nullptr;
  Corner *const first = corners_.data() + corner_count_;
  corner_count_ += count;
  return first;
}

void DifferenceFacets::place(const MinkowskiDifference &difference) {
  const auto polytope = [](const ConvexBody &body) { return body.core == CoreShape::box ? &unit_box() : body.polytope; };
  const auto scale = [](const ConvexBody &body) { return body.core == CoreShape::box ? body.half : Vec3{1, 1, 1}; };
  const Pose &pose = difference.b_in_a;
  const Mat3 turned{{-pose.rotation.row[0], -pose.rotation.row[1], -pose.rotation.row[2]}};
  body_[0] = {polytope(difference.body_a), scale(difference.body_a), Mat3{}, {}, false};
  body_[1] = {polytope(difference.body_b), scale(difference.body_b), turned, -pose.translation, true};
  forget();
}

Vec3 DifferenceFacets::Body::vertex(std::int32_t v) const {
  return rotation * scaled(scale, polytope->vertices()[index(v)]) + shift;
}

Vec3 DifferenceFacets::Body::normal(std::int32_t face) const { return rotation * polytope->faces()[index(face)].normal; }

Vec3 DifferenceFacets::Body::local(const Vec3 &d) const { return scaled(scale, transposed_times(rotation, d)); }

Vec3 DifferenceFacets::Body::way(std::int32_t from, std::int32_t to) const {
  return turned(polytope->vertices()[index(to)] - polytope->vertices()[index(from)]);
}

Vec3 DifferenceFacets::Body::turned(const Vec3 &way) const { return rotation * scaled(scale, way); }

// The facet of a face of one body at the vertex of the other where side q begins. The first side is q turned back.
bool DifferenceFacets::facet_of_face(const Corner &q, const Vec3 &q_end, std::int32_t face, Facet &facet) {
  const std::int32_t body = q.body;
  const Body &owner = body_[body];
  const Polytope &polytope = *owner.polytope;
  const Polytope::Face &whole = polytope.faces()[index(face)];
  facet.first = corner_count_;
  Corner *corner = add_corners(whole.count);
  if (corner == nullptr) return false;
  facet.normal = owner.normal(face);
  facet.count = whole.count;
  // Where the face's own turn has the side's edge; a mirrored body's corners come in the opposite turn.
  const std::int32_t *const edges = polytope.face_edges().data() + whole.first;
  const std::int32_t *const vertices = polytope.face_vertices().data() + whole.first;
  // Which one it is, is unpredictable: no branch.
  std::int32_t begin = 0;
  for (std::int32_t k = 1; k < whole.count; ++k) begin = edges[k] == q.edge ? k : begin;
  const std::int32_t begin_vertex = polytope.edges()[index(q.edge)].vertex[q.forward ? 1 : 0];
  const std::int32_t after = next_in_turn(begin, whole.count);
  std::int32_t at = vertices[begin] == begin_vertex ? begin : after;
  for (std::int32_t k = 0; k < whole.count; ++k, ++corner) {
    const std::int32_t vertex = vertices[at];
    const std::int32_t next = owner.mirrored ? (at == 0 ? whole.count : at) - 1 : next_in_turn(at, whole.count);
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

// The facet that side q's edge spans with an edge of the other body, which leads from q's vertex of that to a neighbour.
bool DifferenceFacets::facet_of_edges(const Corner &q, const Vec3 &q_end, std::int32_t q_end_vertex, std::size_t slot,
                                      Facet &facet) {
  const std::int32_t body = q.body, other = 1 - body, near_vertex = q.vertex[other];
  const Polytope &polytope = *body_[other].polytope;
  const std::int32_t other_edge = polytope.neighbour_edges()[slot], far_vertex = polytope.neighbours()[slot];
  const Vec3 back = q.at - q_end, way = body_[other].turned(polytope.neighbour_ways()[slot]), across = cross(back, way);
  const double length2 = norm2(across);
  if (!(length2 > parallel_sine * parallel_sine * norm2(back) * norm2(way))) return false;
  facet.normal = (1.0 / std::sqrt(length2)) * across;
  facet.height = dot(facet.normal, q.at);
  facet.first = corner_count_;
  facet.count = 4;
  Corner *const corner = add_corners(4);
  if (corner == nullptr) return false;
  const bool way_forward = polytope.edges()[index(other_edge)].vertex[0] == near_vertex;
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

bool DifferenceFacets::cross_side(const Corner &q, const Vec3 &q_end, const Vec3 &from, Facet &facet) {
  // Seen from outside, beyond the side is the edge's face to the right.
  const Polytope::Edge &edge = body_[q.body].polytope->edges()[index(q.edge)];
  const std::int32_t face = edge.face[q.forward != body_[q.body].mirrored ? 1 : 0];
  const Body &other = body_[1 - q.body];
  const Polytope &polytope = *other.polytope;
  const std::int32_t other_vertex = q.vertex[1 - q.body];
  const Vec3 local_from = other.local(from), local_to = other.local(body_[q.body].normal(face));
  const std::int32_t end = polytope.neighbour_begin(other_vertex + 1);
  // Where a way does not come to lead upwards its part is 1, or not a number: neither is less. Which one is met first is
  // unpredictable: no branch.
  double first = 1.0;
  std::int32_t leaving = -1;
  for (std::int32_t slot = polytope.neighbour_begin(other_vertex); slot < end; ++slot) {
    const Vec3 &way = polytope.neighbour_ways()[index(slot)];
    const double before = dot(local_from, way), after = dot(local_to, way);
    const double part = before / (before - 0.5 * twice_positive_part(after));
    leaving = part < first ? slot : leaving;
    first = part < first ? part : first;
  }
  if (leaving < 0) return facet_of_face(q, q_end, face, facet);
  return facet_of_edges(q, q_end, edge.vertex[q.forward ? 1 : 0], index(leaving), facet);
}

bool DifferenceFacets::start(const Vec3 &first, const DifferencePoint &farthest, Facet &facet, Vec3 &apart) {
  const std::int32_t vertex[2] = {farthest.vertex_a, farthest.vertex_b};
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
    std::int32_t best = -1;
    for (std::int32_t slot = polytope.neighbour_begin(vertex[k]); slot < end; ++slot) {
      const Vec3 &way = polytope.neighbour_ways()[index(slot)];
      const double rate = dot(local_turn, way), fall = -dot(local_first, way);
      const double at = twice_positive_part(fall) / twice_positive_part(rate);
      best = at < soonest ? slot : best;
      soonest = at < soonest ? at : soonest;
    }
    body = best < 0 ? body : k, leaving = best < 0 ? leaving : best;
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

// That a face's vertices are the farthest of their own body needs no proof.
bool DifferenceFacets::is_outermost(const Facet &facet, double slack) const {
  const Corner *const corner = corners_of(facet);
  const bool of_face = corner[0].body == corner[1].body;
  for (std::int32_t body = 0; body < 2; ++body) {
    if (of_face && body == corner[0].body) continue;
    const Polytope &polytope = *body_[body].polytope;
    const Vec3 local = body_[body].local(facet.normal);
    const std::int32_t vertex = corner[0].vertex[body], end = polytope.neighbour_begin(vertex + 1);
    double farthest = 0.0;
    for (std::int32_t slot = polytope.neighbour_begin(vertex); slot < end; ++slot) {
      const double rise = dot(local, polytope.neighbour_ways()[index(slot)]);
      farthest = rise > farthest ? rise : farthest;
    }
    if (!(farthest <= slack)) return false;
  }
  return true;
}

void DifferenceFacets::find_witness(const Facet &facet, Vec3 &a, Vec3 &b) const {
  const Corner *const corner = corners_of(facet);
  const Vec3 gap = facet.height * facet.normal;
  if (corner[0].body == corner[1].body) {
    const std::int32_t owner = corner[0].body;
    const Vec3 at = body_[1 - owner].vertex(corner[0].vertex[1 - owner]);
    b = owner == 0 ? -at : at - gap;
    a = b + gap;
    return;
  }
  // Where the edges come nearest to each other.
  const std::int32_t edge_a = corner[corner[0].body == 0 ? 0 : 1].edge, edge_b = corner[corner[0].body == 0 ? 1 : 0].edge;
  const std::int32_t *const ends_a = body_[0].polytope->edges()[index(edge_a)].vertex;
  const std::int32_t *const ends_b = body_[1].polytope->edges()[index(edge_b)].vertex;
  const Vec3 a0 = body_[0].vertex(ends_a[0]), along_a = body_[0].vertex(ends_a[1]) - a0;
  const Vec3 b0 = -body_[1].vertex(ends_b[0]), along_b = -body_[1].vertex(ends_b[1]) - b0;
  const Vec3 side = cross(along_b, facet.normal);
  a = a0 + std::clamp(dot(b0 - a0, side) / dot(along_a, side), 0.0, 1.0) * along_a;
  b = a - gap;
}

}  // namespace cmb::convex
