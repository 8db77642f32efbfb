#include "volume/slices/sliced_overlap.hpp"

#include <algorithm>

#include "math/kronrod_rule.hpp"

namespace cmb::overlap {

namespace {

constexpr int most_pieces = 600, max_planes_added = 40;  // in all, of one piece
constexpr double apart = 1e-9;                    // of the whole length: shorter pieces are not cut

}  // namespace

// The y between `low`, where the order is `at_low`, and `high` above it, where it is another one, at which it changes.
double SlicedOverlap::order_change(double low, std::uint64_t at_low, double high) {
  const double precision = 1e-10 * (range_.end - range_.begin);
  while (high - low > precision) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;  // far from the origin no number is left between them
    (slice_.order(middle) == at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

void SlicedOverlap::cut_at_kinks() {
  double begin = range_.begin;
  const double least = apart * (range_.end - range_.begin);
  for (const double y : crossings_.kinks()) {
    if (!(y > begin + least && y < range_.end - least)) continue;
    pending_.push_back({begin, y, 0});
    begin = y;
  }
  pending_.push_back({begin, range_.end, 0});
}

// Nodes crowd towards the ends, so that roots there do no harm.
void SlicedOverlap::integrate(Piece &piece) {
  SlicedSums gauss;
  const double length = piece.end - piece.begin;
  visit_kronrod_nodes([&](double s, double kronrod_weight, double gauss_weight) {
    SlicedSums here;
    slice_.add_to(here, piece.begin + length * s * s * (3.0 - 2.0 * s));
    const double weight = length * 3.0 * s * (1.0 - s);
    piece.sums.add(here, weight * kronrod_weight);
    if (gauss_weight > 0.0) gauss.add(here, weight * gauss_weight);
  });
  const SolidSums &fine = piece.sums.solid, &coarse = gauss.solid;
  piece.error_volume = kronrod_error(fine.volume, coarse.volume);
  piece.error_area =
      std::max(kronrod_error(fine.upper.area, coarse.upper.area), kronrod_error(fine.lower.area, coarse.lower.area));
}

// Cuts a piece where the order changes, else in the middle.
void SlicedOverlap::refine(const Piece &piece) {
  constexpr int samples = 12;
  const double least = 4e-10 * (range_.end - range_.begin);
  double begin = piece.begin, before = piece.begin;
  std::uint64_t order_before = 0;
  bool cut = false;
  for (int k = 0; k <= samples; ++k) {
    // The ends themselves may be kinks.
    const double s = k == 0 ? 1e-7 : k == samples ? 1.0 - 1e-7 : static_cast<double>(k) / samples;
    const double y = piece.begin + s * (piece.end - piece.begin);
    const std::uint64_t order = slice_.order(y);
    if (k > 0 && order != order_before) {
      const double place = order_change(before, order_before, y);
      if (place - begin > least && piece.end - place > least) {
        pending_.push_back({begin, place, piece.depth + 1});
        begin = place;
        cut = true;
      }
    }
    before = y, order_before = order;
  }
  if (!cut) {
    const double middle = 0.5 * (piece.begin + piece.end);
    pending_.push_back({begin, middle, piece.depth + 1});
    begin = middle;
  }
  pending_.push_back({begin, piece.end, piece.depth + 1});
}

SlicedSums SlicedOverlap::measure(const CommonSolid &solid, const double *guess, int guess_count, double relative_error) {
  range_ = find_slice_range(solid, guess, guess_count, slice_, crossings_);
  if (range_.empty()) return {};
  pieces_.clear(), pending_.clear();
  cut_at_kinks();
  double volume = 0.0, area = 0.0;
  const auto integrate_pending = [&] {
    for (Piece &piece : pending_) {
      integrate(piece);
      volume += piece.sums.solid.volume;
      area += piece.area();
      pieces_.push_back(piece);
    }
    pending_.clear();
  };
  integrate_pending();
  SlicedSums result;
  const double least = apart * (range_.end - range_.begin);
  int refined = 0;
  while (!pieces_.empty()) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    const bool fine = piece.error_volume <= relative_error * volume && piece.error_area <= relative_error * area;
    if (fine || piece.depth > max_planes_added || refined == most_pieces || piece.end - piece.begin <= least) {
      result.add(piece.sums, 1.0);
      continue;
    }
    volume -= piece.sums.solid.volume;
    area -= piece.area();
    ++refined;
    refine(piece);
    integrate_pending();
  }
  return result;
}

}  // namespace cmb::overlap
