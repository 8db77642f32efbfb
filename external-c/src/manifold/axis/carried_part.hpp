// How much of a contact the energy of a capsule's axis carries.
#pragma once

namespace cmb {

// Of the radius: how near an edge of the obstacle is near.
constexpr double near_edge_part = 0.15;
// Of the radius: from where on it matters how the axis lies.
constexpr double deep_axis_part = 0.8;

// 1 but where the capsule is nearly as deep as its radius or deeper, and
// - much of its axis is near an edge, or near the place between two sides inside: the direction would change at once;
// - the axis pierces the obstacle: the minimum translation is longer than the axis is deep, and leads out on one side.
// `near_edges`: the part of the stretch that is near edges; `deepest` (m): how deep the capsule is by its axis, `depth` the
// length of the minimum translation.
double carried_part(double near_edges, double deepest, double depth, double radius);

}  // namespace cmb
