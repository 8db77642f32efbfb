// What limits the load of a contact with many corners.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace cmb {

// Finely tessellated bodies push with ever more corners the deeper they go; their smooth bodies would push with one
// point at the deepest place, whatever the tessellation. A contact's load, the sum of weight * depth, is therefore at
// most its greatest depth D. Where there is more, the deepest corners carry: a corner keeps the part
// (depth - level) / width of its weight, within 0 and 1, and the level is where the load is D.
//
// Parts, and with them the loads of all corners, change continuously with depths and weights: the load falls with the
// level, and where it does not, because there is no corner between level and level + width, the parts do not either.
struct LoadLimit {
  double level, width;

  double part(double depth) const { return std::min(1.0, std::max(0.0, (depth - level) / width)); }
};

// The width for corners of which about `fineness` are met for each metre of depth. Few corners, or shallow ones, share
// over all of the depth; of many, about as many carry as meet in two of the tessellation's steps, however deep the contact:
// such a body rolls from facet to facet as smoothly as these are fine.
inline double load_width(double greatest_depth, double fineness) {
  constexpr double steps = 2.0;
  return std::min(greatest_depth, steps / fineness);
}

template <typename Corner>
double greatest_depth(const std::vector<Corner> &corners, std::size_t begin) {
  double greatest = 0.0;
  for (std::size_t k = begin; k < corners.size(); ++k) greatest = std::max(greatest, corners[k].depth);
  return greatest;
}

// The load that the corners [begin..) keep.
template <typename Corner>
double load_kept(const std::vector<Corner> &corners, std::size_t begin, const LoadLimit &limit) {
  double load = 0.0;
  for (std::size_t k = begin; k < corners.size(); ++k) {
    load += corners[k].weight * corners[k].depth * limit.part(corners[k].depth);
  }
  return load;
}

// The limit of the corners [begin..), whose greatest depth is `greatest` (> 0) and whose load is `load_of_all`. Its level is
// -width, so that all keep their weight, where the load is no more than that depth. Corners may be missing that are not
// deeper than a level at which the load is that depth or more.
template <typename Corner>
LoadLimit load_limit(const std::vector<Corner> &corners, std::size_t begin, double greatest, double load_of_all,
                     double width) {
  if (!(load_of_all > greatest)) return {-width, width};
  const double rate = 1.0 / width;
  // Newton's method, exact once on the right piece of the load, which is linear between corners; else halving.
  double low = -width, high = greatest;
  LoadLimit limit{greatest - 0.5 * width, width};
  for (int step = 0; step < 100; ++step) {
    double load = 0.0, in_part = 0.0;
    for (std::size_t k = begin; k < corners.size(); ++k) {
      // Which corners carry wholly, in part or not at all cannot be foretold: sums of products with 0 or 1, without a branch.
      const double part = (corners[k].depth - limit.level) * rate, full = corners[k].weight * corners[k].depth;
      const double full_in_part = full * static_cast<double>((part > 0.0) & (part < 1.0));
      load += full * static_cast<double>(part >= 1.0) + full_in_part * part;
      in_part += full_in_part;
    }
    if (load == greatest) break;
    (load > greatest ? low : high) = limit.level;
    double next = limit.level + width * (load - greatest) / in_part;
    if (std::fabs(next - limit.level) <= 4e-16 * greatest) break;  // no more than rounding
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    limit.level = next;
  }
  return limit;
}

}  // namespace cmb
