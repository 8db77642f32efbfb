#include "overlap/sliced_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace cmb::overlap {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Gauss' rule of 7 and Kronrod's of 15 nodes on [-1, 1] (QUADPACK), from the outer nodes to the middle.
constexpr double kronrod_node[8] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                                    0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                                    0.586087235467691130294144691258381, 0.405845151377397166906606412076961,
                                    0.207784955007898467600689403773245, 0.0};
constexpr double kronrod_weight[8] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                      0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                      0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                      0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
constexpr double gauss_weight[4] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                                    0.381830050505118944950369775488975, 0.417959183673469387755102040816327};

constexpr int most_pieces = 600;

std::size_t index(std::int32_t i) { return static_cast<std::size_t>(i); }

void add(SlicedSums &sums, const SlicedSums &other, double factor) {
  sums.solid.add(other.solid, factor);
  sums.marked.add(other.marked, factor);
}

// |Kronrod - Gauss| overestimates: QUADPACK's correction by what the integral is.
double corrected(double difference, double integral) {
  difference = std::fabs(difference), integral = std::fabs(integral);
  if (!(integral > 0.0)) return difference;
  return integral * std::min(1.0, std::pow(200.0 * difference / integral, 1.5));
}

}  // namespace

// The polytope's section: one segment a face that the plane cuts.
bool SlicedOverlap::flat_section(double y) {
  segments_.clear();
  low_ = infinity, high_ = -infinity;
  const std::vector<Vec3> &vertices = flat_->vertices();
  for (std::size_t f = 0; f < flat_->faces().size(); ++f) {
    const auto &face = flat_->faces()[f];
    double x[2], z[2];
    int count = 0;
    const Vec3 *from = &vertices[index(flat_->corners()[index(face.first + face.count - 1)])];
    for (std::int32_t k = 0; k < face.count && count < 2; ++k) {
      const Vec3 *to = &vertices[index(flat_->corners()[index(face.first + k)])];
      if ((from->y < y) != (to->y < y)) {
        const double part = (y - from->y) / (to->y - from->y);
        x[count] = from->x + part * (to->x - from->x);
        z[count++] = from->z + part * (to->z - from->z);
      }
      from = to;
    }
    if (count < 2) continue;
    const int first = x[0] <= x[1] ? 0 : 1;
    low_ = std::min(low_, x[first]), high_ = std::max(high_, x[1 - first]);
    if (face.normal.z == 0.0) continue;
    segments_.push_back({x[first], z[first], x[1 - first], z[1 - first], face.normal.z > 0.0,
                         face.source_face == marked_face_, static_cast<int>(f)});
  }
  return low_ < high_;
}

// All places that may be corners of the section; too many do no harm.
void SlicedOverlap::find_corners(double y) {
  corners_.clear();
  corners_.push_back(low_), corners_.push_back(high_);
  const auto add_corner = [&](double x) {
    if (x > low_ && x < high_) corners_.push_back(x);
  };
  for (const Segment &segment : segments_) {
    add_corner(segment.x0), add_corner(segment.x1);
    const Vec3 origin{segment.x0, y, segment.z0}, along{segment.x1 - segment.x0, 0.0, segment.z1 - segment.z0};
    for (int k = 0; k < round_count_; ++k) {
      const Stretch inside = rounds_[k].stretch(origin, along);
      if (inside.empty()) continue;
      if (inside.begin > 0.0 && inside.begin < 1.0) add_corner(segment.x0 + inside.begin * along.x);
      if (inside.end > 0.0 && inside.end < 1.0) add_corner(segment.x0 + inside.end * along.x);
    }
  }
  for (int k = 0; k < round_count_; ++k) sections_[k].visit_joints(add_corner);
  if (round_count_ == 2) {
    double x[7];
    for (int i = 0; i < sections_[0].pieces(); ++i) {
      for (int j = 0; j < sections_[1].pieces(); ++j) {
        const int count = sections_[0].piece(i).crossings(sections_[1].piece(j), low_, high_, x);
        for (int k = 0; k < count; ++k) add_corner(x[k]);
      }
    }
  }
  std::sort(corners_.begin(), corners_.end());
}

bool SlicedOverlap::sides_at(double x, Side &lower, Side &upper) const {
  lower = {-infinity, -1, -1, 0}, upper = {infinity, -1, -1, 0};
  for (std::size_t k = 0; k < segments_.size(); ++k) {
    const Segment &segment = segments_[k];
    if (x < segment.x0 || x > segment.x1) continue;
    const double z = segment.at(x);
    if (segment.upper && z < upper.z) upper = {z, static_cast<int>(k), -1, 0};
    if (!segment.upper && z > lower.z) lower = {z, static_cast<int>(k), -1, 0};
  }
  // The polytope is bounded: what rounding leaves between its segments is outside.
  if (lower.segment < 0 || upper.segment < 0) return false;
  for (int k = 0; k < round_count_; ++k) {
    const RoundSection::Sides sides = sections_[k].at(x);
    if (sides.z.empty()) return false;
    if (sides.z.end < upper.z) upper = {sides.z.end, -1, k, sides.upper};
    if (sides.z.begin > lower.z) lower = {sides.z.begin, -1, k, sides.lower};
  }
  return lower.z < upper.z;
}

void SlicedOverlap::add_side(const Side &side, bool upper, double y, double from, double to, SlicedSums &sums) const {
  double area = 0.0, ax = 0.0, axx = 0.0, az = 0.0, azz = 0.0, axz = 0.0;
  const auto visit = [&](double x, double z, double weight) {
    area += weight;
    ax += weight * x;
    axx += weight * x * x;
    az += weight * z;
    azz += weight * z * z;
    axz += weight * x * z;
  };
  if (side.segment >= 0) {
    static const GaussRule<2> rule;
    const Segment &segment = segments_[static_cast<std::size_t>(side.segment)];
    for (std::size_t k = 0; k < rule.node.size(); ++k) {
      const double x = from + (to - from) * rule.node[k];
      visit(x, segment.at(x), (to - from) * rule.weight[k]);
    }
  } else {
    sections_[side.round].piece(side.piece).integrate(upper, from, to, visit);
  }
  const double sign = upper ? 1.0 : -1.0;
  SolidSums &solid = sums.solid;
  solid.volume += sign * az;
  solid.x += sign * axz;
  solid.y += sign * y * az;
  solid.z += sign * 0.5 * azz;
  const SideSums part{area, ax, y * area, axx, y * ax, y * y * area, az};
  (upper ? solid.upper : solid.lower).add(part, 1.0);
  if (side.segment >= 0 && segments_[static_cast<std::size_t>(side.segment)].marked) sums.marked.add(part, 1.0);
}

std::uint64_t SlicedOverlap::slice(double y, SlicedSums *sums) {
  if (!flat_section(y)) return 0;
  for (int k = 0; k < round_count_; ++k) sections_[k] = RoundSection(rounds_[k], y, low_, high_);
  find_corners(y);
  std::uint64_t order = 0;
  const double least = 1e-14 * (high_ - low_);
  Side lower, upper, next_lower, next_upper;
  double lower_from = 0.0, upper_from = 0.0, to = 0.0;
  bool inside = false;
  const auto close = [&](bool lower_ends, bool upper_ends) {
    if (sums == nullptr) return;
    if (lower_ends) add_side(lower, false, y, lower_from, to, *sums);
    if (upper_ends) add_side(upper, true, y, upper_from, to, *sums);
  };
  const auto note = [&](const Side &side) {
    const auto what = static_cast<std::uint64_t>(
        side.segment >= 0 ? segments_[static_cast<std::size_t>(side.segment)].face : -1 - 3 * side.round - side.piece);
    order = (order ^ what) * 0x9E3779B97F4A7C15u + 1;
    order ^= order >> 29;
  };
  for (std::size_t k = 1; k < corners_.size(); ++k) {
    const double from = corners_[k - 1];
    if (corners_[k] - from <= least) continue;
    if (!sides_at(0.5 * (from + corners_[k]), next_lower, next_upper)) {
      if (inside) close(true, true);
      inside = false;
      continue;
    }
    const bool lower_changes = !inside || !next_lower.same(lower), upper_changes = !inside || !next_upper.same(upper);
    if (inside) close(lower_changes, upper_changes);
    if (lower_changes) lower = next_lower, lower_from = from;
    if (upper_changes) upper = next_upper, upper_from = from;
    if (lower_changes || upper_changes) note(lower), note(upper);
    inside = true;
    to = corners_[k];
  }
  if (inside) close(true, true);
  return order;
}

// The y between `low`, where the order is `at_low`, and `high`, where it is another one, at which it first differs.
double SlicedOverlap::order_change(double low, std::uint64_t at_low, double high) {
  const double precision = 1e-10 * (top_ - bottom_);
  while (high - low > precision || low - high > precision) {
    const double middle = 0.5 * (low + high);
    (slice(middle, nullptr) == at_low ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

// Where the order is known to change: corners of the polytope inside all round solids, edges that enter one, apices.
void SlicedOverlap::find_kinks() {
  kinks_.clear(), touched_.clear();
  const auto inside_rounds = [&](const Vec3 &p, int but) {
    for (int k = 0; k < round_count_; ++k) {
      const Stretch along = rounds_[k].stretch(p, {0.0, 0.0, 1.0});
      if (k != but && (along.empty() || along.begin > 0.0 || along.end < 0.0)) return false;
    }
    return true;
  };
  for (const auto &face : flat_->faces()) {
    for (std::int32_t i = 0; i < face.count; ++i) {
      const std::int32_t from = flat_->corners()[index(face.first + i)];
      const std::int32_t to = flat_->corners()[index(face.first + (i + 1) % face.count)];
      if (from >= to) continue;  // each edge once
      const Vec3 &p = flat_->vertices()[index(from)], along = flat_->vertices()[index(to)] - p;
      for (const double end : {0.0, 1.0}) {
        if (inside_rounds(p + end * along, -1)) kinks_.push_back(p.y + end * along.y);
      }
      Stretch common{0.0, 1.0};
      for (int k = 0; k < round_count_; ++k) {
        const Stretch inside = rounds_[k].stretch(p, along);
        common = inside.empty() ? inside : Stretch{std::max(common.begin, inside.begin), std::min(common.end, inside.end)};
        if (common.empty()) break;
        for (const double s : {inside.begin, inside.end}) {
          if (s > 0.0 && s < 1.0 && inside_rounds(p + s * along, k)) kinks_.push_back(p.y + s * along.y);
        }
      }
      if (!common.empty()) touched_.push_back(p + (0.5 * (common.begin + common.end)) * along);
    }
  }
  for (int k = 0; k < round_count_; ++k) {
    if (const Vec3 *apex = rounds_[k].apex()) {
      if (inside_rounds(*apex, k)) kinks_.push_back(apex->y);
    }
  }
  std::sort(kinks_.begin(), kinks_.end());
}

// Nodes crowd towards the ends, so that roots there do no harm.
void SlicedOverlap::integrate(Piece &piece) {
  piece.sums = {};
  SlicedSums gauss;
  const double length = piece.end - piece.begin;
  for (int k = 0; k < 8; ++k) {
    for (const double sign : {-1.0, 1.0}) {
      if (k == 7 && sign > 0.0) continue;
      const double s = 0.5 + 0.5 * sign * kronrod_node[k];
      SlicedSums here;
      slice(piece.begin + length * s * s * (3.0 - 2.0 * s), &here);
      const double weight = length * 3.0 * s * (1.0 - s);
      add(piece.sums, here, weight * kronrod_weight[k]);
      if (k % 2 == 1) add(gauss, here, weight * gauss_weight[k / 2]);
    }
  }
  const SolidSums &fine = piece.sums.solid, &coarse = gauss.solid;
  piece.error_volume = corrected(fine.volume - coarse.volume, fine.volume);
  piece.error_area = std::max(corrected(fine.upper.area - coarse.upper.area, fine.upper.area),
                              corrected(fine.lower.area - coarse.lower.area, fine.lower.area));
}

// Cuts a piece where the order changes, else in the middle.
void SlicedOverlap::refine(const Piece &piece) {
  constexpr int samples = 12;
  const double least = 4e-10 * (top_ - bottom_);
  double begin = piece.begin, before = piece.begin;
  std::uint64_t order_before = 0;
  bool cut = false;
  for (int k = 0; k <= samples; ++k) {
    // The ends themselves may be kinks.
    const double s = k == 0 ? 1e-7 : k == samples ? 1.0 - 1e-7 : static_cast<double>(k) / samples;
    const double y = piece.begin + s * (piece.end - piece.begin);
    const std::uint64_t order = slice(y, nullptr);
    if (k > 0 && order != order_before) {
      const double place = order_change(before, order_before, y);
      if (place - begin > least && piece.end - place > least) {
        pending_.push_back({begin, place, {}, 0.0, 0.0, piece.depth + 1});
        begin = place;
        cut = true;
      }
    }
    before = y, order_before = order;
  }
  if (!cut) {
    const double middle = 0.5 * (piece.begin + piece.end);
    pending_.push_back({begin, middle, {}, 0.0, 0.0, piece.depth + 1});
    begin = middle;
  }
  pending_.push_back({begin, piece.end, {}, 0.0, 0.0, piece.depth + 1});
}

// A y whose slice is not empty: they are all between the two next to it that are.
bool SlicedOverlap::find_inner(const double *guess, int guess_count, double &inner) {
  const auto holds = [&](double y) {
    inner = y;
    return y > bottom_ && y < top_ && slice(y, nullptr) != 0;
  };
  Vec3 middle;
  const double part = 1.0 / static_cast<double>(flat_->vertices().size());
  for (const Vec3 &p : flat_->vertices()) middle = middle + part * p;
  // From a place of the polytope's surface inside the round solids towards its middle.
  const auto holds_behind = [&](const Vec3 &p) {
    double reach = 1.0;
    for (int k = 0; k < round_count_; ++k) reach = std::min(reach, rounds_[k].stretch(p, middle - p).end);
    return holds(p.y + 0.5 * reach * (middle.y - p.y));
  };
  for (int k = 0; k < guess_count; ++k) {
    if (holds(guess[k])) return true;
  }
  for (const Vec3 &p : touched_) {
    if (holds_behind(p)) return true;
  }
  if (round_count_ == 1) {
    // No edge of the polytope enters the round solid: it lies inside, or some face cuts it within its border.
    if (holds(rounds_[0].inner_point().y)) return true;
    for (const auto &face : flat_->faces()) {
      Vec3 p;
      if (rounds_[0].point_in_plane(face.normal, face.offset, p) && holds_behind(p)) return true;
    }
    return false;
  }
  // Within what each round solid alone has in common with the polytope.
  const RoundSolid *both = rounds_;
  double low = bottom_, high = top_;
  round_count_ = 1;
  for (int k = 0; k < 2; ++k, ++rounds_) {
    double inside = 0.0;
    find_kinks();
    if (!find_inner(nullptr, 0, inside)) low = high;
    low = std::max(low, find_end(inside, bottom_)), high = std::min(high, find_end(inside, top_));
  }
  rounds_ = both, round_count_ = 2;
  find_kinks();
  constexpr int samples = 128;
  for (int k = 0; k < samples && low < high; ++k) {
    if (holds(low + (high - low) * (k + 0.5) / samples)) return true;
  }
  return false;
}

// The y next to `end` of what is not empty, `inner` being inside.
double SlicedOverlap::find_end(double inner, double end) {
  const double whole = top_ - bottom_, outward = inner < end ? 1.0 : -1.0;
  if (!kinks_.empty()) {
    const double last = outward > 0.0 ? kinks_.back() : kinks_.front();
    const double beyond = last + 1e-9 * outward * whole;
    if ((last - inner) * outward > 0.0 && ((end - beyond) * outward <= 0.0 || slice(beyond, nullptr) == 0)) return last;
  }
  const double just_inside = end - 1e-12 * outward * whole;
  if (slice(just_inside, nullptr) != 0) return end;
  double in = inner, out = just_inside;
  // Relative to what is found, which may be far less than the whole.
  for (int step = 0; step < 100 && std::fabs(out - in) > 1e-11 * std::fabs(in - inner) + 1e-15 * whole; ++step) {
    const double middle = 0.5 * (in + out);
    (slice(middle, nullptr) != 0 ? in : out) = middle;
  }
  return in;
}

SlicedSums SlicedOverlap::measure(const convex::OverlapScratch &flat, const RoundSolid *rounds, int round_count,
                                  const double *guess, int guess_count, double relative_error, std::int32_t marked_face) {
  flat_ = &flat, rounds_ = rounds, round_count_ = round_count, marked_face_ = marked_face;
  if (flat.faces().empty()) return {};
  bottom_ = infinity, top_ = -infinity;
  for (const Vec3 &p : flat.vertices()) bottom_ = std::min(bottom_, p.y), top_ = std::max(top_, p.y);
  if (!(bottom_ < top_)) return {};
  find_kinks();
  double inner = 0.0;
  if (!find_inner(guess, guess_count, inner)) return {};
  const double first = find_end(inner, bottom_), last = find_end(inner, top_);
  bottom_ = first, top_ = last;
  if (!(bottom_ < top_)) return {};

  pieces_.clear(), pending_.clear();
  double begin = bottom_;
  const double apart = 1e-9 * (top_ - bottom_);
  for (const double y : kinks_) {
    if (!(y > begin + apart && y < top_ - apart)) continue;
    pending_.push_back({begin, y, {}, 0.0, 0.0, 0});
    begin = y;
  }
  pending_.push_back({begin, top_, {}, 0.0, 0.0, 0});

  double volume = 0.0, area = 0.0;
  const auto integrate_pending = [&] {
    for (Piece &piece : pending_) {
      integrate(piece);
      volume += piece.sums.solid.volume;
      area += 0.5 * (piece.sums.solid.upper.area + piece.sums.solid.lower.area);
      pieces_.push_back(piece);
    }
    pending_.clear();
  };
  integrate_pending();
  SlicedSums result;
  int refined = 0;
  while (!pieces_.empty()) {
    const Piece piece = pieces_.back();
    pieces_.pop_back();
    const bool fine = piece.error_volume <= relative_error * volume && piece.error_area <= relative_error * area;
    if (fine || piece.depth > 40 || refined == most_pieces || piece.end - piece.begin <= apart) {
      add(result, piece.sums, 1.0);
      continue;
    }
    volume -= piece.sums.solid.volume;
    area -= 0.5 * (piece.sums.solid.upper.area + piece.sums.solid.lower.area);
    ++refined;
    refine(piece);
    integrate_pending();
  }
  return result;
}

}  // namespace cmb::overlap
