#include "broadphase/hierarchical_grid.hpp"

namespace cmb {

void HierarchicalGrid::prepare(const std::vector<Bounds> &boxes) {
  const std::size_t count = boxes.size();
  levels_.clear();
  sorted_.resize(count);
  entries_.resize(count);
  hits_.resize(count + 1);
  if (count == 0) return;

  // By level: counting sort.
  exponents_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec3 extent = boxes[i].high - boxes[i].low;
    std::frexp(std::fmax(extent.x, std::fmax(extent.y, extent.z)), &exponents_[i]);  // extent < 2^exponent
  }
  const auto [smallest, largest] = std::minmax_element(exponents_.begin(), exponents_.end());
  const int top = *largest;
  const std::size_t level_count = static_cast<std::size_t>(top - *smallest) + 1;
  level_begin_.assign(level_count + 1, 0);
  for (const int exponent : exponents_) ++level_begin_[static_cast<std::size_t>(top - exponent) + 1];
  std::size_t table = 0;
  for (std::size_t k = 0; k < level_count; ++k) {
    const std::size_t size = level_begin_[k + 1];
    level_begin_[k + 1] += level_begin_[k];
    if (size == 0) continue;
    std::size_t cells = 4;
    while (cells < 2 * size) cells *= 2;
    const int exponent = top - static_cast<int>(k);
    levels_.push_back(
        {exponent, std::ldexp(1.0, exponent), std::ldexp(1.0, std::min(-exponent, 1000)), level_begin_[k], level_begin_[k + 1], table, cells - 1});
    table += cells + 1;
  }
  by_level_.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    by_level_[level_begin_[static_cast<std::size_t>(top - exponents_[i])]++] = static_cast<std::uint32_t>(i);
  }

  // Each level by cell: counting sort.
  starts_.assign(table, 0);
  cells_.resize(count);
  for (const Level &level : levels_) {
    std::uint32_t *starts = starts_.data() + level.table;
    const auto cell_coordinate = [&](double low, double high) { return cell_of(0.5 * (low + high), level); };
    for (std::size_t k = level.begin; k < level.end; ++k) {
      const Bounds &box = boxes[by_level_[k]];
      const std::uint64_t row =
          row_of(cell_coordinate(box.low.y, box.high.y), cell_coordinate(box.low.z, box.high.z));
      const auto x = static_cast<std::uint64_t>(cell_coordinate(box.low.x, box.high.x));
      cells_[k] = static_cast<std::uint32_t>((row + x) & level.mask);
      ++starts[cells_[k]];
    }
    std::uint32_t next = static_cast<std::uint32_t>(level.begin);
    for (std::size_t cell = 0; cell <= level.mask; ++cell) next = starts[cell] += next;
    starts[level.mask + 1] = next;
    for (std::size_t k = level.end; k-- > level.begin;) {  // from behind, so that each start ends where it belongs
      const Bounds &box = boxes[by_level_[k]];
      const std::size_t target = --starts[cells_[k]];
      sorted_[target] = box;
      entries_[target] = {by_level_[k], cell_coordinate(box.low.y, box.high.y), cell_coordinate(box.low.z, box.high.z)};
    }
  }
}

}  // namespace cmb
