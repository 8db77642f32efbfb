// The level that limits a contact's load.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace cmb {

// The sum of weight * (depth - z) over the corners [begin..) deeper than z.
template <typename Corner>
double load_above(const std::vector<Corner> &corners, std::size_t begin, double z) {
  double load = 0.0;
  for (std::size_t k = begin; k < corners.size(); ++k) {
    if (corners[k].depth > z) load += corners[k].weight * (corners[k].depth - z);
  }
  return load;
}

template <typename Corner>
double greatest_depth(const std::vector<Corner> &corners, std::size_t begin) {
  double greatest = 0.0;
  for (std::size_t k = begin; k < corners.size(); ++k) greatest = std::max(greatest, corners[k].depth);
  return greatest;
}

// Finely tessellated bodies push with ever more corners the deeper they go; their smooth bodies would push with one
// point at the deepest place, whatever the tessellation. Corners of depth d and weight w therefore count by their depth
// below the level z, with w (d - z) for d > z, z being the level where that load is the greatest depth D: it is never
// more. z is 0 where the load at 0 is no more than D.
//
// z changes continuously with depths and weights, no faster than the load above z and D do: no corner being deeper than
// D, the weights of those above z sum to D / (D - z) >= 1 at least, and at that rate the load falls with z.
//
// Where z is not 0, corners [begin..) are sorted by depth; and those not deeper than a level at which the load is D or
// more may be missing.
template <typename Corner>
double load_level(std::vector<Corner> &corners, std::size_t begin) {
  const double greatest = greatest_depth(corners, begin);
  if (!(load_above(corners, begin, 0.0) > greatest)) return 0.0;
  std::sort(corners.begin() + static_cast<std::ptrdiff_t>(begin), corners.end(), [](const Corner &x, const Corner &y) {
    return x.depth != y.depth ? x.depth > y.depth : x.weight > y.weight;
  });
  // Between the depths of two corners the load is linear.
  double weight = 0.0, moment = 0.0;
  for (std::size_t k = begin; k < corners.size(); ++k) {
    if (moment - weight * corners[k].depth >= greatest) break;
    weight += corners[k].weight;
    moment += corners[k].weight * corners[k].depth;
  }
  return std::max(0.0, (moment - greatest) / weight);
}

}  // namespace cmb
