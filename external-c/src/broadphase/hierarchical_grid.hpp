// Overlapping pairs among many boxes of any sizes, in nearly linear time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "shape/bounds.hpp"

namespace cmb {

// A hierarchical hash grid (Mirtich 1996; Ericson, Real-Time Collision Detection, 2005, section 7.2). A box lives in
// the one cell that holds its centre, on the level whose cells are at least as long as the box and less than twice.
// Each box looks at its own and all coarser levels: those it overlaps on a level with cells of length s have their
// centres within s/2 of it. Only the place (y, z) of a row of cells is hashed: cells that follow each other along x do
// so in the table too, and boxes are sorted by cell, so that a row is one stretch of memory. Nothing but the boxes
// decides the result; memory is kept for the next use.
class HierarchicalGrid {
 public:
  // Calls visit(i, j) once for each pair of overlapping boxes, in an order that depends on the boxes alone. Lengths
  // and coordinates are finite.
  template <typename Visit>
  void visit_overlaps(const std::vector<Bounds> &boxes, Visit &&visit) {
    prepare(boxes);
    for (std::size_t own = 0; own < levels_.size(); ++own) {
      for (std::size_t k = levels_[own].begin; k < levels_[own].end; ++k) {
        for (std::size_t other = 0; other <= own; ++other) {
          const Level &level = levels_[other];
          // On its own level a box meets those behind it only.
          const std::size_t from = other == own ? k + 1 : level.begin;
          if (level.end - level.begin <= few_boxes) {
            visit_stretch(k, from, level.end, [](const Entry &) { return true; }, visit);
          } else {
            visit_cells(k, from, level, visit);
          }
        }
      }
    }
  }

 private:
  // Comparing with so few boxes is cheaper than looking into cells.
  static constexpr std::size_t few_boxes = 16;

  // The boxes at begin ... end - 1 of sorted_ have cells of length `size`, a power of two, `cells` to the metre. Cell t of its
  // table holds those from starts_[table + t] on; the table has mask + 1 cells.
  struct Level {
    int exponent = 0;
    double size = 0.0, cells = 0.0;
    std::size_t begin = 0, end = 0, table = 0, mask = 0;
  };
  // Where a box is sorted to.
  struct Entry {
    std::uint32_t box = 0;
    std::int64_t y = 0, z = 0;  // of its cell
  };

  // Monotone, so that a range of coordinates stays a range of cells where it is cut off.
  static std::int64_t cell_of(double coordinate, const Level &level) {
    constexpr double farthest = 4.5e15;  // cells; doubles count to twice that
    const double at = std::clamp(coordinate * level.cells, -farthest, farthest);
    const auto towards_zero = static_cast<std::int64_t>(at);  // quicker than std::floor, which is a call on some processors
    return towards_zero - static_cast<std::int64_t>(at < static_cast<double>(towards_zero));
  }
  static std::uint64_t row_of(std::int64_t y, std::int64_t z) {
    std::uint64_t h = static_cast<std::uint64_t>(y) * 0x9e3779b97f4a7c15u;
    h ^= static_cast<std::uint64_t>(z) * 0xc2b2ae3d27d4eb4fu;
    h ^= h >> 29;
    return (h * 0x165667b19e3779f9u) >> 20;
  }

  // Sorts the boxes by level and cell.
  void prepare(const std::vector<Bounds> &boxes);

  // Meets box k of sorted_ with those at from ... to - 1 whose entry is `wanted`.
  template <typename Wanted, typename Visit>
  void visit_stretch(std::size_t k, std::size_t from, std::size_t to, Wanted &&wanted, Visit &&visit) {
    const Bounds box = sorted_[k];
    std::size_t hits = 0;
    for (std::size_t other = from; other < to; ++other) {  // without branches: their outcome cannot be foreseen
      hits_[hits] = static_cast<std::uint32_t>(other);
      hits += overlap(box, sorted_[other]) ? 1 : 0;
    }
    for (std::size_t hit = 0; hit < hits; ++hit) {
      const Entry &entry = entries_[hits_[hit]];
      if (wanted(entry)) visit(entries_[k].box, entry.box);
    }
  }

  template <typename Visit>
  void visit_cells(std::size_t k, std::size_t from, const Level &level, Visit &&visit) {
    const Bounds &box = sorted_[k];
    const double reach = 0.5 * level.size;
    const std::int64_t x_low = cell_of(box.low.x - reach, level), x_high = cell_of(box.high.x + reach, level);
    const std::int64_t y_low = cell_of(box.low.y - reach, level), y_high = cell_of(box.high.y + reach, level);
    const std::int64_t z_low = cell_of(box.low.z - reach, level), z_high = cell_of(box.high.z + reach, level);
    for (std::int64_t z = z_low; z <= z_high; ++z) {
      for (std::int64_t y = y_low; y <= y_high; ++y) {
        // Rows that share cells are told apart, else a pair could be found twice.
        const auto in_row = [&](const Entry &entry) { return entry.y == y && entry.z == z; };
        const std::uint64_t row = row_of(y, z);
        const std::size_t first = (row + static_cast<std::uint64_t>(x_low)) & level.mask;
        const std::size_t last = (row + static_cast<std::uint64_t>(x_high)) & level.mask;
        const std::uint32_t *starts = starts_.data() + level.table;
        if (first <= last) {
          visit_stretch(k, std::max<std::size_t>(from, starts[first]), starts[last + 1], in_row, visit);
        } else {  // the row goes on at the table's beginning
          visit_stretch(k, std::max<std::size_t>(from, starts[first]), starts[level.mask + 1], in_row, visit);
          visit_stretch(k, std::max<std::size_t>(from, starts[0]), starts[last + 1], in_row, visit);
        }
      }
    }
  }

  std::vector<Level> levels_;              // largest cells first
  std::vector<Bounds> sorted_;             // boxes by level and cell
  std::vector<Entry> entries_;             // of each of them
  std::vector<std::uint32_t> starts_;      // tables of all levels
  std::vector<std::uint32_t> hits_;
  std::vector<int> exponents_;             // of each box as given
  std::vector<std::size_t> level_begin_;
  std::vector<std::uint32_t> by_level_, cells_;
};

}  // namespace cmb
