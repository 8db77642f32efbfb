// Who answers a pair of shapes: contacts, distances and overlaps all ask this table.
#pragma once

#include <cstdint>

#include "shape/shape.hpp"

namespace cmb {

// A method by its pair of kinds, the first shape first. "Round" is an ellipsoid, cylinder, cone or capsule; "polytope" a box or hull.
enum class PairMethod : std::uint8_t {
  none,  // two half-spaces never touch
  // with a half-space as the second shape
  sphere_halfspace,
  polytope_halfspace,
  round_halfspace,
  mesh_halfspace,
  // with a mesh as the second shape
  sphere_mesh,
  polytope_mesh,
  round_mesh,
  mesh_mesh,
  // bounded convex shapes, whose contact follows from their signed distance
  sphere_sphere,
  sphere_capsule,
  capsule_capsule,
  sphere_core,        // the second shape's core has a closed-form distance to a point
  polytope_polytope,
  general_convex
};

struct PairEntry {
  PairMethod method;
  bool exchanged;  // the method's first shape is the pair's second one
};

inline bool is_bounded_convex(PairMethod method) { return method >= PairMethod::sphere_sphere; }

namespace pair_table {

using M = PairMethod;
constexpr PairEntry in_order(M method) { return {method, false}; }
constexpr PairEntry exchanged(M method) { return {method, true}; }

constexpr PairEntry none = in_order(M::none), convex = in_order(M::general_convex);
constexpr PairEntry s_h = in_order(M::sphere_halfspace), h_s = exchanged(M::sphere_halfspace);
constexpr PairEntry p_h = in_order(M::polytope_halfspace), h_p = exchanged(M::polytope_halfspace);
constexpr PairEntry r_h = in_order(M::round_halfspace), h_r = exchanged(M::round_halfspace);
constexpr PairEntry m_h = in_order(M::mesh_halfspace), h_m = exchanged(M::mesh_halfspace);
constexpr PairEntry s_m = in_order(M::sphere_mesh), m_s = exchanged(M::sphere_mesh);
constexpr PairEntry p_m = in_order(M::polytope_mesh), m_p = exchanged(M::polytope_mesh);
constexpr PairEntry r_m = in_order(M::round_mesh), m_r = exchanged(M::round_mesh);
constexpr PairEntry m_m = in_order(M::mesh_mesh), s_s = in_order(M::sphere_sphere), c_c = in_order(M::capsule_capsule);
constexpr PairEntry s_c = in_order(M::sphere_capsule), c_s = exchanged(M::sphere_capsule);
constexpr PairEntry s_k = in_order(M::sphere_core), k_s = exchanged(M::sphere_core);
constexpr PairEntry p_p = in_order(M::polytope_polytope);

// By the first shape's kind, then the second one's, in the order of ShapeKind.
constexpr int kinds = 9;
constexpr PairEntry entries[kinds][kinds] = {
    //              halfspace sphere  box     capsule hull    ellipsoid cylinder cone    mesh
    /* halfspace */ {none,    h_s,    h_p,    h_r,    h_p,    h_r,      h_r,     h_r,    h_m},
    /* sphere    */ {s_h,     s_s,    s_k,    s_c,    convex, convex,   s_k,     s_k,    s_m},
    /* box       */ {p_h,     k_s,    p_p,    convex, p_p,    convex,   convex,  convex, p_m},
    /* capsule   */ {r_h,     c_s,    convex, c_c,    convex, convex,   convex,  convex, r_m},
    /* hull      */ {p_h,     convex, p_p,    convex, p_p,    convex,   convex,  convex, p_m},
    /* ellipsoid */ {r_h,     convex, convex, convex, convex, convex,   convex,  convex, r_m},
    /* cylinder  */ {r_h,     k_s,    convex, convex, convex, convex,   convex,  convex, r_m},
    /* cone      */ {r_h,     k_s,    convex, convex, convex, convex,   convex,  convex, r_m},
    /* mesh      */ {m_h,     m_s,    m_p,    m_r,    m_p,    m_r,      m_r,     m_r,    m_m},
};
static_assert(static_cast<int>(ShapeKind::mesh) == kinds - 1, "the table has a row and a column for each kind");

}  // namespace pair_table

inline PairEntry pair_entry(const Shape &a, const Shape &b) {
  return pair_table::entries[static_cast<int>(a.kind)][static_cast<int>(b.kind)];
}

}  // namespace cmb
