#include "manifold/revolved/mantle_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "math/gauss_rule.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

constexpr std::size_t node_count = 8;

// Between -pi and pi.
double wrapped(double angle) { return angle - 2.0 * pi * std::round(angle / (2.0 * pi)); }

double within(double height, const RevolvedBody &body) { return std::clamp(height, -body.half, body.half); }

// sin(x) / x
double sine_ratio(double x) { return std::fabs(x) < 1e-4 ? 1.0 - x * x / 6.0 : std::sin(x) / x; }


}  // namespace

MantleCrossing::MantleCrossing(Mantle &ruled, Mantle &other, const Pose &in_other, Cuts &cuts, EdgePlaces *fitted)
    : ruled_(ruled), other_(other), in_other_(in_other), rulings_(ruled.body(), other.body(), in_other),
      size_(ruled.body().radius + ruled.body().half + other.body().radius + other.body().half),
      fitted_(fitted) {
  for (int k = 0; k < 2; ++k) {
    cuts.on[k].clear();
    strand_[k].cuts = &cuts.on[k];
  }
  find_strands();
}

double MantleCrossing::Strand::steepness(double angle, double above, double below) const {
  const double rest = 0.5 * factor.at(std::cos(angle), std::sin(angle)) * sine_ratio(0.5 * above) * sine_ratio(0.5 * below);
  return std::sqrt(std::max(rest, 1e-300));
}

void MantleCrossing::find_strands() {
  constexpr double middle = 0.3;  // of a half circle, so that its ends are no roots of symmetric poses
  constexpr int most = 8;
  const TrigonometricPolynomial &discriminant = rulings_.discriminant();
  double root[most];
  int count = 0;
  for (const double ahead : {middle, middle + pi}) {
    const int more = discriminant.from(ahead).sign_changes_ahead(root + count);
    for (int k = count; k < count + more; ++k) root[k] += ahead;
    count += more;
  }
  // Between roots; in one place it may touch zero.
  const auto is_positive = [&](double from, double to) {
    double sum = 0.0;
    for (const double part : {0.3, 0.5, 0.7}) sum += rulings_.discriminant_on(rulings_.ruling(from + part * (to - from)));
    return sum > 0.0;
  };
  if (count == 0) {
    if (!is_positive(0.0, 2.0 * pi)) return;
    strand_[0].sense = 1.0, strand_[1].sense = -1.0, strands_ = 2;
    return;
  }
  // Between which of them it is positive; what rounding has change its sign for nothing is no end.
  bool positive[most];
  for (int k = 0; k < count; ++k) positive[k] = is_positive(root[k], k + 1 < count ? root[k + 1] : root[0] + 2.0 * pi);
  int first = 0;
  while (first < count && !(positive[first] && !positive[(first + count - 1) % count])) ++first;
  if (first == count) {
    if (!positive[0]) return;
    strand_[0].sense = 1.0, strand_[1].sense = -1.0, strands_ = 2;
    return;
  }
  for (int k = 0; k < count && strands_ < 2; ++k) {
    const int begin = (first + k) % count;
    if (!positive[begin] || positive[(begin + count - 1) % count]) continue;
    int end = begin;
    while (positive[end]) end = (end + 1) % count;
    const double from = root[begin], to = root[end] + (root[end] > from ? 0.0 : 2.0 * pi);
    Strand &strand = strand_[strands_++];
    strand.middle = 0.5 * (from + to), strand.half = 0.5 * (to - from);
    const TrigonometricPolynomial whole = discriminant.from(strand.middle);
    strand.factor.cosine = 2.0 * whole.cosine2, strand.factor.sine = 2.0 * whole.sine2;
    strand.factor.constant = whole.cosine + std::cos(strand.half) * strand.factor.cosine;
  }
}

bool MantleCrossing::find_place(const Strand &strand, double parameter, Place &place) const {
  double angle = strand.sense * parameter, s_on_oval = 0.0, c_on_oval = 0.0;
  place.turn = strand.sense;
  if (strand.is_oval()) {
    s_on_oval = std::sin(parameter), c_on_oval = std::cos(parameter);
    angle = strand.middle + strand.half * s_on_oval;
    place.turn = strand.half * c_on_oval;
  }
  const MantleRulings::Ruling ruling = rulings_.ruling(angle);
  // Where it is no small difference, the discriminant is known best as one.
  constexpr double clear = 1e4;
  const double discriminant = rulings_.discriminant_on(ruling), rounding = rulings_.rounding_on(ruling);
  double growth = 0.0, speed = 0.0;  // the turn by the growth
  if (!strand.is_oval() || discriminant > clear * rounding) {
    const double root = std::sqrt(std::max({discriminant, rounding, 1e-300}));
    growth = place.turn > 0.0 ? root : -root, speed = place.turn / growth;
  } else {
    const double s = s_on_oval, c = c_on_oval;
    const double above = s > 0.0 ? 1.0 + s : c * c / (1.0 - s), below = s > 0.0 ? c * c / (1.0 + s) : 1.0 - s;
    const double steepness = strand.steepness(strand.half * s, strand.half * above, strand.half * below);
    growth = strand.half * c * steepness, speed = 1.0 / steepness;
  }
  const RevolvedBody &body = ruled_.body();
  const double on_ruling = rulings_.place_on(ruling, growth), height = rulings_.height_at(on_ruling);
  if (!std::isfinite(height) || !rulings_.is_on_this_side(on_ruling)) return false;
  double rise = -0.5 * speed * rulings_.change(ruling, on_ruling) * rulings_.rise(on_ruling);
  double c = ruling.cosine, s = ruling.sine;
  place.height = height;
  // Of flat cones terms are great that cancel: so onto the curve the shortest way, by what is known there.
  const auto look = [&] {
    const double radius = body.radius_at(place.height);
    place.at = {radius * c, radius * s, place.height};
    place.in_other = in_other_(place.at);
  };
  look();
  const Vec3 &p = place.in_other;
  const RevolvedBody &other = other_.body();
  const double beyond = other.beyond_mantle(p);
  const Vec3 slant = transposed_times(in_other_.rotation, Vec3{2.0 * p.x, 2.0 * p.y, -2.0 * other.slope * other.radius_at(p.z)});
  const double by_turn = c * slant.y - s * slant.x, by_ruling = body.across * (body.slope * (c * slant.x + s * slant.y) + slant.z);
  const double back = -beyond / (by_turn * by_turn + by_ruling * by_ruling);
  const double turn = back * by_turn / body.radius_at(height), up = back * by_ruling * body.across;
  if (std::fabs(turn) + std::fabs(up) / body.half < 1e-7) {
    const double c_before = c;
    c -= turn * s, s += turn * c_before, place.height += up;
    look();
  }
  // So is the curve's direction, but where it is as good as along the ruling.
  constexpr double along = 0.01;
  const double around = body.radius_at(place.height) * place.turn;
  if (std::fabs(by_ruling) > along * std::fabs(by_turn)) rise = -by_turn / by_ruling * around * body.across;
  const double wider = body.slope * rise;
  place.angle_cosine = c, place.angle_sine = s;
  const Vec3 way{wider * c - around * s, wider * s + around * c, rise}, step = in_other_.rotation * way;
  place.turn_in_other = (p.x * step.y - p.y * step.x) / (p.x * p.x + p.y * p.y);
  if (fitted_ != nullptr) {
    const Pose &in_common = ruled_.in_common();
    place.fitted = EdgePlaces::on_both(ruled_, other_, in_common(place.at), in_common.rotation * way, EdgePlaces::most_off * size_);
  }
  return true;
}

// Of an arc that passes no end; in one place it may touch one.
bool MantleCrossing::is_between_ends(const Strand &strand, double from, double to) const {
  int between = 0;
  for (const double part : {0.3, 0.5, 0.7}) {
    Place place;
    const bool found = find_place(strand, from + part * (to - from), place);
    between += found && std::fabs(place.height) <= ruled_.body().half && std::fabs(place.in_other.z) <= other_.body().half ? 1 : 0;
  }
  return between >= 2;
}

void MantleCrossing::add_corner(const Vec3 &at, const Vec3 &corner) {
  if (strands_ == 0) return;
  const double angle = std::atan2(at.y, at.x);
  const double growth = rulings_.growth_at(rulings_.ruling(angle), rulings_.place_at(at.z));
  const bool grows = growth > 0.0;
  if (!strand_[0].is_oval()) {
    const Strand &strand = strand_[grows ? 0 : 1];
    strand.cuts->push_back({strand.sense * angle, at, corner});
    return;
  }
  // Between ovals rounding may put it.
  const auto off = [&](const Strand &strand) { return std::fabs(wrapped(angle - strand.middle)) - strand.half; };
  const Strand &strand = strand_[strands_ == 2 && off(strand_[1]) < off(strand_[0]) ? 1 : 0];
  const double ahead = std::clamp(wrapped(angle - strand.middle), -strand.half, strand.half), s = ahead / strand.half;
  constexpr double turns = 0.9;  // nearer to an end the growth tells where
  double parameter = grows ? std::asin(s) : pi - std::asin(s);
  if (std::fabs(s) > turns) {
    const double c = growth / (strand.half * strand.steepness(ahead, strand.half + ahead, strand.half - ahead));
    parameter = std::fabs(c) < 1.0 ? std::atan2(std::copysign(std::sqrt(1.0 - c * c), s), c) : parameter;
  }
  strand.cuts->push_back({parameter, at, corner});
}

void MantleCrossing::follow() {
  for (int k = 0; k < strands_; ++k) follow_strand(strand_[k]);
}

void MantleCrossing::follow_strand(const Strand &strand) {
  std::vector<Cut> &cuts = *strand.cuts;
  const auto add = [&](double from, double to) {
    constexpr double widest = 1.6;  // a quarter of a strand, and rounding
    const int parts = 1 + static_cast<int>((to - from) / widest);
    const double width = (to - from) / parts;
    for (int k = 0; k < parts; ++k) add_arc(strand, from + k * width, from + (k + 1) * width, 0, {HUGE_VAL, HUGE_VAL});
  };
  if (cuts.empty()) {
    if (is_between_ends(strand, -0.5 * pi, 1.5 * pi)) add(-0.5 * pi, 1.5 * pi);
    close(nullptr, nullptr);
    return;
  }
  for (Cut &cut : cuts) cut.parameter = wrapped(cut.parameter);
  std::sort(cuts.begin(), cuts.end(), [](const Cut &p, const Cut &q) { return p.parameter < q.parameter; });
  for (std::size_t k = 0; k < cuts.size(); ++k) {
    const Cut &first = cuts[k], &last = cuts[(k + 1) % cuts.size()];
    const double from = first.parameter, to = k + 1 < cuts.size() ? last.parameter : last.parameter + 2.0 * pi;
    constexpr double empty = 1e-13;
    if (!(to - from > empty) || !is_between_ends(strand, from, to)) continue;
    const std::size_t begin = ruled_.border().size(), begin_in_other = other_.border().size();
    add(from, to);
    if (fitted_ != nullptr) {
      close(&first, &last);
      continue;
    }
    fit_turn(first.at, last.at, begin, ruled_.border());
    fit_turn(in_other_(last.at), in_other_(first.at), begin_in_other, other_.border());
  }
}

// Of a fitted edge, between two corners or closed.
void MantleCrossing::close(const Cut *from, const Cut *to) {
  if (fitted_ == nullptr) return;
  if (from != nullptr) {
    fitted_->lead(ruled_, other_, from->corner, to->corner, EdgePlaces::most_off * size_);
  } else {
    fitted_->lead({});
  }
  for (const EdgePlaces::Place &place : fitted_->places()) {
    ruled_.add_border_way(place.at, place.step, 1.0);
    other_.add_border_way(place.at, place.step, -1.0);
  }
  fitted_->clear();
}

// The turn between the ends of a part of a border is that of its places: so rounding leaves it closed. More may be left of turns about an apex
// that is in the other body, where they count for nothing.
void MantleCrossing::fit_turn(const Vec3 &from, const Vec3 &to, std::size_t begin, std::vector<BorderPlace> &border) {
  double sum = 0.0, whole = 0.0;
  for (std::size_t k = begin; k < border.size(); ++k) sum += border[k].turn, whole += std::fabs(border[k].turn);
  const double left = wrapped(std::atan2(from.x * to.y - from.y * to.x, from.x * to.x + from.y * to.y) - sum) / whole;
  constexpr double by_rounding = 1e-7;
  if (!(std::fabs(left) < by_rounding)) return;
  for (std::size_t k = begin; k < border.size(); ++k) border[k].turn += left * std::fabs(border[k].turn);
}

// Halves an arc until polynomials of one degree less than there are places are as good as the curve, or rounding is all that is unknown.
void MantleCrossing::add_arc(const Strand &strand, double from, double to, int depth, const Unknown &before) {
  const double rough = fitted_ != nullptr ? 1e-6 : 1e-4, rough_area = 0.1 * rough;
  constexpr double little = 1e-9, falls = 0.7, by_rounding = 1e-9;
  constexpr int deepest = 30;
  const overlap::GaussNodes rule(overlap::gauss_rule<static_cast<int>(node_count)>);
  const double width = to - from;
  Place place[node_count];
  bool found = true;
  for (std::size_t k = 0; k < node_count; ++k) found = find_place(strand, from + rule.node[k] * width, place[k]) && found;
  if (depth < deepest && arcs_left_ > 0) {
    Vec3 last, next, low = place[0].at, high = low;
    double last_area = 0.0, next_area = 0.0, most_area = 0.0, last_turn = 0.0, next_turn = 0.0;
    for (std::size_t k = 0; k < node_count; ++k) {
      const Vec3 &at = fitted_ != nullptr ? place[k].fitted.at : place[k].at;
      last = last + rule.series.last[k] * at, next = next + rule.series.next[k] * at;
      const double turn = width * place[k].turn_in_other, across = other_.width_at(height_in_other(place[k]), height_in_other(place[0]));
      const double area = turn * across;
      last_turn += rule.series.last[k] * turn, next_turn += rule.series.next[k] * turn;
      last_area += rule.series.last[k] * area, next_area += rule.series.next[k] * area;
      widest_ = std::max(widest_, std::fabs(across));
      low = {std::min(low.x, at.x), std::min(low.y, at.y), std::min(low.z, at.z)};
      high = {std::max(high.x, at.x), std::max(high.y, at.y), std::max(high.z, at.z)};
      most_area = std::max(most_area, std::fabs(area));
    }
    const double extent = norm(high - low);
    // Where it counts from is not known before all of the border is.
    const double turn = other_.counts_from_apex() ? 0.0 : widest_ * std::max(std::fabs(last_turn), std::fabs(next_turn));
    const Unknown unknown{std::max(norm(last), norm(next)), turn + std::max(std::fabs(last_area), std::fabs(next_area))};
    most_area_ = std::max(most_area_, most_area);
    const bool is_smooth = unknown.way <= rough * extent && unknown.area <= rough_area * most_area_;
    const bool is_little = std::max(unknown.way * extent, unknown.area) <= little * most_area_;
    const bool is_rounding = unknown.way <= by_rounding * size_ && unknown.area <= by_rounding * size_ * size_ &&
                             unknown.way > falls * before.way && unknown.area > falls * before.area;
    if (!found || !(is_smooth || is_little || is_rounding)) {
      --arcs_left_;
      const double middle = 0.5 * (from + to);
      add_arc(strand, from, middle, depth + 1, unknown);
      add_arc(strand, middle, to, depth + 1, unknown);
      return;
    }
  }
  if (!found) return;
  if (fitted_ != nullptr) fitted_->begin_arc(rule.series);
  for (std::size_t k = 0; k < node_count; ++k) {
    const Place &at = place[k];
    const double part = width * rule.weight[k];
    if (fitted_ != nullptr) {
      fitted_->add({at.fitted.at, part * at.fitted.step});
      continue;
    }
    ruled_.add_border_place({at.angle_cosine, at.angle_sine, 0.0}, within(at.height, ruled_.body()), part * at.turn);
    const Vec3 &p = at.in_other;
    const double across = std::sqrt(p.x * p.x + p.y * p.y);
    if (!(across > 0.0)) continue;
    other_.add_border_place({p.x / across, p.y / across, 0.0}, within(height_in_other(at), other_.body()), -part * at.turn_in_other);
  }
}

}  // namespace cmb
