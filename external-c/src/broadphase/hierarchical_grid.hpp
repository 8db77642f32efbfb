// Overlapping pairs among many boxes of any sizes, in nearly linear time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "broadphase/bounds.hpp"

namespace cmb {

// A hierarchical hash grid (Mirtich 1996; Ericson, Real-Time Collision Detection, 2005, section 7.2). A box lives in
// the one cell that holds its centre, on the level whose cells are at least as long as the box and less than twice.
// Boxes enter from the largest level down; each looks for those that are there already: on a level with cells of
// length s they have their centres within s/2 of the box. Every pair is found once. Nothing but the boxes decides
// the result; memory is kept for the next use.
class HierarchicalGrid {
 public:
  // Calls visit(i, j) once for each pair of overlapping boxes, in an order that depends on the boxes alone. Lengths
  // and coordinates are finite.
  template <typename Visit>
  void visit_overlaps(const std::vector<Bounds> &boxes, Visit &&visit) {
    prepare(boxes);
    for (std::size_t rank = 0; rank < order_.size(); ++rank) {
      const std::uint32_t i = order_[rank];
      for (const Level &level : levels_) {
        if (level.begin > rank) break;
        if (std::min(level.end, rank) - level.begin <= few_boxes) {
          for (std::size_t other = level.begin; other < std::min(level.end, rank); ++other) {
            if (overlap(boxes[i], boxes[order_[other]])) visit(i, order_[other]);
          }
        } else {
          visit_cells(boxes, i, level, visit);
        }
      }
      insert(i);
    }
  }

 private:
  // Comparing with so few boxes is cheaper than looking into cells.
  static constexpr std::size_t few_boxes = 16;
  static constexpr std::uint32_t none = ~0u;

  // The boxes order_[begin .. end) have cells of length `size`.
  struct Level {
    int exponent = 0;
    double size = 0.0;
    std::size_t begin = 0, end = 0;
  };
  struct Cell {
    std::int64_t x = 0, y = 0, z = 0;
  };
  struct Entry {
    Cell cell;
    int exponent = 0;
    std::uint32_t next = none;  // in the same bucket
  };

  // Monotone, so that a range of coordinates stays a range of cells where it is cut off.
  static std::int64_t cell_of(double coordinate, double size) {
    constexpr double farthest = 4.5e15;  // cells; doubles count to twice that
    return static_cast<std::int64_t>(std::floor(std::clamp(coordinate / size, -farthest, farthest)));
  }
  std::size_t bucket(std::int64_t x, std::int64_t y, std::int64_t z, int exponent) const {
    std::uint64_t h = static_cast<std::uint64_t>(x) * 0x9e3779b97f4a7c15u;
    h ^= static_cast<std::uint64_t>(y) * 0xc2b2ae3d27d4eb4fu;
    h ^= static_cast<std::uint64_t>(z) * 0x165667b19e3779f9u;
    h += static_cast<std::uint64_t>(exponent) * 0xd6e8feb86659fd93u;
    h ^= h >> 32;
    return static_cast<std::size_t>((h * 0x9e3779b97f4a7c15u) >> bucket_shift_);
  }

  // Sorts the boxes by level and empties the table.
  void prepare(const std::vector<Bounds> &boxes);

  void insert(std::uint32_t box) {
    Entry &entry = entries_[box];
    std::uint32_t &head = buckets_[bucket(entry.cell.x, entry.cell.y, entry.cell.z, entry.exponent)];
    entry.next = head;
    head = box;
  }

  template <typename Visit>
  void visit_cells(const std::vector<Bounds> &boxes, std::uint32_t i, const Level &level, Visit &&visit) const {
    const Bounds &box = boxes[i];
    const double reach = 0.5 * level.size;
    const Cell low{cell_of(box.low.x - reach, level.size), cell_of(box.low.y - reach, level.size),
                   cell_of(box.low.z - reach, level.size)};
    const Cell high{cell_of(box.high.x + reach, level.size), cell_of(box.high.y + reach, level.size),
                    cell_of(box.high.z + reach, level.size)};
    for (std::int64_t z = low.z; z <= high.z; ++z) {
      for (std::int64_t y = low.y; y <= high.y; ++y) {
        for (std::int64_t x = low.x; x <= high.x; ++x) {
          for (std::uint32_t j = buckets_[bucket(x, y, z, level.exponent)]; j != none; j = entries_[j].next) {
            const Entry &entry = entries_[j];
            // Cells that share a bucket are told apart, else a pair could be found twice.
            if (entry.cell.x == x && entry.cell.y == y && entry.cell.z == z && entry.exponent == level.exponent &&
                overlap(box, boxes[j])) {
              visit(i, j);
            }
          }
        }
      }
    }
  }

  std::vector<Entry> entries_;           // of each box
  std::vector<Level> levels_;            // largest cells first
  std::vector<std::uint32_t> order_;     // boxes by level, then by number
  std::vector<std::size_t> level_begin_;
  std::vector<std::uint32_t> buckets_;   // first box of each
  int bucket_shift_ = 64;
};

}  // namespace cmb
