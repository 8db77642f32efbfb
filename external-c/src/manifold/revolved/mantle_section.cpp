#include "manifold/revolved/mantle_section.hpp"

#include <algorithm>
#include <cmath>

#include "math/gauss_rule.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

using overlap::gauss_rule;
using overlap::GaussNodes;
using overlap::NodeTurns;

// Of so many places, from 7 to 16.
GaussNodes rule_of(int places) {
  switch (places) {
    case 7: return GaussNodes(gauss_rule<7>);
    case 8: return GaussNodes(gauss_rule<8>);
    case 9: return GaussNodes(gauss_rule<9>);
    case 10: return GaussNodes(gauss_rule<10>);
    case 11: return GaussNodes(gauss_rule<11>);
    case 12: return GaussNodes(gauss_rule<12>);
    case 13: return GaussNodes(gauss_rule<13>);
    case 14: return GaussNodes(gauss_rule<14>);
    case 15: return GaussNodes(gauss_rule<15>);
    default: return GaussNodes(gauss_rule<16>);
  }
}
constexpr double most_places = 16.0;

// So many serve for curves through so great an angle. What is cut off by a chord is as deep as the angle's square, and that counts by its third
// power. Of a plane as good as along the axis the height goes by the angle's square, and its fifth power counts: so seven at least.
int places_for(double through, const EdgePlaces *fitted, const Mantle &mantle) {
  constexpr int fewest = 7, most = 14;
  constexpr double widest_of[most - fewest] = {0.5, 1.1, 1.4, 1.8, 2.1, 2.5, 2.9};
  if (fitted != nullptr) return most;
  const double angle = (mantle.partner() == Mantle::Partner::wedge ? 1.4 : 1.0) * through;  // of one degree more
  int places = fewest;
  while (places < most && !(angle < widest_of[places - fewest])) ++places;
  return places;
}
GaussNodes rule_for(double through, const EdgePlaces *fitted, const Mantle &mantle) { return rule_of(places_for(through, fitted, mantle)); }
// That one rule serves for.
constexpr double widest = 3.3, widest_of_cone = 1.8;

// How many places a part of a cone's conic asks for, beside those of its angle: the distance from the apex is the inverse of a linear function of
// the angle's cosine, which has a pole where that is `pole`, real or not. What Gauss' rule leaves falls with each place by the square of
// the sum of semi-axes of the ellipse that has the part's ends as foci and the pole on it.
double places_by_pole(double pole, double from, double turn) {
  constexpr double enough = 36.0;  // of the logarithm; the pole is of the sixth order
  const double half = 0.5 * std::fabs(turn), size = std::fabs(pole);
  const double real = size < 1.0 ? std::acos(pole) : pole > 0.0 ? 0.0 : pi, imaginary = size < 1.0 ? 0.0 : std::acosh(size);
  double beside = HUGE_VAL;  // from the middle of the part
  for (const double sense : {1.0, -1.0}) beside = std::fmin(beside, std::fabs(std::remainder(sense * real - from - 0.5 * turn, 2.0 * pi)));
  const double axis = 0.5 * (std::hypot(beside - half, imaginary) + std::hypot(beside + half, imaginary)) / half;
  return axis > 1.0 ? 0.5 * enough / std::acosh(axis) : HUGE_VAL;
}

// Places evenly round, so many as are exact for the trigonometric polynomials that integrals on a circle are, and on plane sections of a
// cylinder: moments of the fifth degree, the place from the fan's apex and its step.
constexpr int round_places = 8;
constexpr double half_root = 0.707106781186547524;
constexpr double round_cosine[round_places] = {1.0, half_root, 0.0, -half_root, -1.0, -half_root, 0.0, half_root};
constexpr double round_sine[round_places] = {0.0, half_root, 1.0, half_root, 0.0, -half_root, -1.0, -half_root};
// Of a cone's plane sections the inverse of the distance from the apex swings by this part of its mean: harmonics fall so much the faster,
// the less that is, and as good as none are left.
constexpr double most_round_places = 64.0;
double round_places_of_cone(double swing) {
  constexpr double enough = 36.0;  // of the harmonics' logarithm
  return swing > 0.0 ? round_places + 1 + enough / std::acosh(1.0 / swing) : round_places;
}

// The cosines' way from angle0 to angle1, and its slope, at parts of the turn between them. No angles of both signs.
class CosineWay {
 public:
  CosineWay(double angle0, double turn)
      : turn_(turn), cosine0_(std::cos(angle0)), sine0_(std::sin(angle0)), half_cosine_(std::cos(0.5 * turn)), half_sine_(std::sin(0.5 * turn)) {
    whole_ = (sine0_ * half_cosine_ + cosine0_ * half_sine_) * half_sine_;
    is_short_ = std::fabs(turn) < 1e-12 || whole_ == 0.0;
  }
  struct Place {
    double cosine, sine, way, slope;
  };
  Place at(double part) const { return at(part, std::cos(0.5 * part * turn_), std::sin(0.5 * part * turn_)); }
  // Of half of the turn up to the rule's nodes, for what follows.
  NodeTurns half_turns(const GaussNodes &rule) const { return {rule, 0.5 * turn_, half_cosine_, half_sine_}; }
  // By the cosine and sine of half of the turn's part.
  Place at(double part, double c, double s) const {
    const double cosine = 1.0 - 2.0 * s * s, sine = 2.0 * s * c;
    Place place{cosine0_ * cosine - sine0_ * sine, sine0_ * cosine + cosine0_ * sine, part, 1.0};
    if (!is_short_) {
      place.way = (sine0_ * c + cosine0_ * s) * s / whole_;
      place.slope = 0.5 * turn_ * place.sine / whole_;
    }
    return place;
  }

 private:
  double turn_, cosine0_, sine0_, half_cosine_, half_sine_, whole_;
  bool is_short_;
};

double rounding_of(const RevolvedBody &body) { return 1e-12 * (body.radius + body.half); }

double most_off(const RevolvedBody &body) { return EdgePlaces::most_off * (body.radius + body.half); }

void begin_arc(EdgePlaces *places, const GaussNodes &rule) {
  if (places != nullptr) places->begin_arc(rule.series);
}

// Of a fitted edge, between two corners or closed.
void close(EdgePlaces *places, const Passages::Arc *arc, PlaneFan &fan, Mantle &mantle) {
  if (places == nullptr) return;
  if (arc != nullptr) {
    places->lead(fan, mantle, arc->from.corner, arc->to.corner, most_off(mantle.body()));
  } else {
    places->lead({});
  }
  for (const EdgePlaces::Place &place : places->places()) {
    fan.add_curve_node(place.at, place.step);
    mantle.add_border_way(place.at, place.step, 1.0);
  }
  places->clear();
}

// So of one that is as good as empty.
void close_straight(EdgePlaces *places, const Passages::Arc &arc, PlaneFan &fan, Mantle &mantle) {
  if (places == nullptr) return;
  const Vec3 &from = arc.from.corner, &to = arc.to.corner;
  fan.add_segment(from, to);
  mantle.add_border_way(0.5 * (from + to), to - from, 1.0);
}

}  // namespace

void MantleSection::start(Mantle &mantle, const Vec3 &n, double offset, EdgePlaces *fitted) {
  mantle_ = &mantle, fitted_ = fitted;
  passages_.clear();
  const RevolvedBody &body = mantle.body();
  radial_ = std::sqrt(n.x * n.x + n.y * n.y);
  axial_ = n.z, offset_ = offset;
  along_ = radial_ > 1e-14 ? Vec3{n.x / radial_, n.y / radial_, 0.0} : Vec3{1.0, 0.0, 0.0};
  across_ = {-along_.y, along_.x, 0.0};
  // A cone's apex in the plane counts as within the polytope, as for holds().
  sense_ = (body.is_cylinder() ? n.z >= 0.0 : n.z * body.half > offset) ? 1.0 : -1.0;
  pole_ = body.is_cylinder() ? HUGE_VAL : -axial_ / (radial_ * body.slope);
  if (!find_height(1.0, front_)) front_ = -body.half;
  front_ = std::clamp(front_, -body.half, body.half);
  constexpr double steady = 0.05;
  is_steady_ = body.is_cylinder() && std::fabs(axial_) > steady;
  if (!is_steady_) return;
  swing_ = radial_ * body.radius / axial_;
  swing_front_ = offset_ / axial_ - swing_;
}

// False where there is none, on a cone on its own side of the apex.
bool MantleSection::find_height(double cosine, double &height) const {
  const RevolvedBody &body = mantle_->body();
  if (body.is_cylinder()) {
    height = (offset_ - radial_ * body.radius * cosine) / axial_;
    return axial_ != 0.0;
  }
  const double above = axial_ * body.half - offset_, growth = -radial_ * body.slope * cosine - axial_;
  height = body.half + above / growth;
  return above > 0.0 ? growth < 0.0 : growth > 0.0;
}

void MantleSection::add_passage(const Vec3 &at, bool to_curve, const Vec3 &corner) {
  // A cone's apex is where the first axis points, for all planes that meet there.
  const Vec3 radial = at.x == 0.0 && at.y == 0.0 ? Vec3{1.0, 0.0, 0.0} : at;
  const double height = std::clamp(mantle_->body().height_on_mantle(at), -mantle_->body().half, mantle_->body().half);
  const double angle = std::atan2(dot(across_, radial), dot(along_, radial)), beyond = height - front_;
  // Where the plane is as good as parallel to the axis the height tells how far along the conic a place is; elsewhere both do.
  passages_.add({sense_ * mantle_->body().radius * angle + std::copysign(beyond, beyond >= 0.0 ? angle : -angle), angle, height, to_curve, corner});
}

bool MantleSection::find_loop(Vec3 &at) const {
  const RevolvedBody &body = mantle_->body();
  const auto is_between = [&](double height) { return std::fabs(height) <= body.half; };
  double front = 0.0, back = 0.0;
  if (!find_height(1.0, front) || !find_height(-1.0, back) || !is_between(front) || !is_between(back)) return false;
  at = body.radius_at(front) * along_;
  at.z = front;
  return true;
}

void MantleSection::follow_loop(PlaneFan &fan) {
  add_loop(fan);
  close(fitted_, nullptr, fan, *mantle_);
}

void MantleSection::add_loop(PlaneFan &fan) {
  double front = 0.0, back = 0.0;  // heights at angle 0 and on the other side
  find_height(1.0, front);
  find_height(-1.0, back);
  const RevolvedBody &body = mantle_->body();
  // Round a cone the inverse of the distance from the apex swings with the cosine.
  const double down = body.half - front, down_back = body.half - back;
  if (body.is_cylinder()) {
    const double width = sense_ * 2.0 * pi / round_places, swing = 0.5 * (back - front);
    for (int k = 0; k < round_places; ++k) {
      const double cosine = round_cosine[k], sine = round_sine[k];
      add_place(fan, cosine, sine, front + swing * (1.0 - cosine), width, swing * sine * width);
    }
    return;
  }
  const double places = down > 0.0 && down_back > 0.0 ? round_places_of_cone(std::fabs(down - down_back) / (down + down_back)) : HUGE_VAL;
  if (places < most_round_places) {
    const int count = static_cast<int>(places);
    const double width = sense_ * 2.0 * pi / count, swing = 0.5 * (1.0 / down - 1.0 / down_back);
    for (int k = 0; k < count; ++k) {
      const double angle = width * k, cosine = std::cos(angle), sine = std::sin(angle);
      const double on_cone = 1.0 / (1.0 / down + 0.5 * (1.0 - cosine) * (1.0 / down_back - 1.0 / down));
      add_place(fan, cosine, sine, body.half - on_cone, width, -swing * sine * on_cone * on_cone * width);
    }
    return;
  }
  add_arc(fan, -sense_ * pi, back, 0.0, front);
  add_arc(fan, 0.0, front, sense_ * pi, back);
}

// A place of the conic, by how far it turns and rises there.
void MantleSection::add_place(PlaneFan &fan, double cosine, double sine, double height, double turn, double rise) {
  const RevolvedBody &body = mantle_->body();
  const Pose &in_common = mantle_->in_common();
  const double radius = body.radius_at(height);
  const Vec3 outward = cosine * along_ + sine * across_, around = cosine * across_ - sine * along_;
  Vec3 step = (radius * turn) * around + (body.slope * rise) * outward;
  step.z = rise;
  const Vec3 at = in_common({radius * outward.x, radius * outward.y, height}), way = in_common.rotation * step;
  if (fitted_ != nullptr) {
    fitted_->add(EdgePlaces::on_both(fan, *mantle_, at, way, most_off(body)));
    return;
  }
  fan.add_curve_node(at, way);
  mantle_->add_border_place(outward, height, turn);
}

bool MantleSection::follow_arcs(PlaneFan &fan) {
  double front = 0.0, back = 0.0;
  // What an arc goes by is between the ends. Of a plane as good as along the axis, which rounding has pass a line of the mantle twice, it may
  // be anywhere.
  constexpr double slack = 1e-6;
  const RevolvedBody &body = mantle_->body();
  const double most = body.half + slack * (body.radius + body.half);
  const bool has_front = find_height(1.0, front) && std::fabs(front) <= most;
  const bool has_back = find_height(-1.0, back) && std::fabs(back) <= most;
  const double rounding = rounding_of(body);
  while (!passages_.empty()) {
    Passages::Arc arc;
    if (!passages_.take_arc(rounding, arc)) return false;
    if (arc.empty) {
      close_straight(fitted_, arc, fan, *mantle_);
      continue;
    }
    if (is_steady_) {
      if (arc.round && !has_back) return false;
      add_swing(fan, arc.from.angle, arc.to.angle - arc.from.angle + (arc.round ? sense_ * 2.0 * pi : 0.0));
      close(fitted_, &arc, fan, *mantle_);
      continue;
    }
    double angle = arc.from.angle, height = arc.from.height;
    const auto go = [&](double to_angle, double to_height) {
      add_arc(fan, angle, height, to_angle, to_height);
      angle = to_angle, height = to_height;
    };
    // By way of the places where the height turns.
    if (arc.round) {
      if (sense_ * angle < 0.0) {
        if (!has_front) return false;
        go(0.0, front);
      }
      if (!has_back) return false;
      go(sense_ * pi, back);
      angle = -sense_ * pi;
    }
    if (sense_ * angle < 0.0 && sense_ * arc.to.angle > 0.0) {
      if (!has_front) return false;
      go(0.0, front);
    }
    go(arc.to.angle, arc.to.height);
    close(fitted_, &arc, fan, *mantle_);
  }
  return true;
}

void Rim::start(Mantle &mantle, End end, EdgePlaces *fitted) {
  const RevolvedBody &body = mantle.body();
  mantle_ = &mantle;
  height_ = end == base ? -body.half : body.half;
  radius_ = end == base || body.is_cylinder() ? body.radius : 0.0;
  sense_ = end == base ? -1.0 : 1.0;
  fitted_ = radius_ > 0.0 ? fitted : nullptr;
  passages_.clear();
}

void Rim::add_passage(const Vec3 &at, bool to_rim, const Vec3 &corner) {
  const double angle = std::atan2(at.y, at.x);
  passages_.add({sense_ * radius_ * angle, angle, height_, to_rim, corner});
}

void Rim::follow_all(PlaneFan &fan) {
  const double width = sense_ * 2.0 * pi / round_places;
  for (int k = 0; k < round_places; ++k) add_place(fan, round_cosine[k], round_sine[k], width);
  close(fitted_, nullptr, fan, *mantle_);
}

void Rim::add_place(PlaneFan &fan, double cosine, double sine, double step) {
  const Pose &in_common = mantle_->in_common();
  const double way = radius_ * step;
  const Vec3 at = in_common({radius_ * cosine, radius_ * sine, height_}), along = in_common.rotation * Vec3{-way * sine, way * cosine, 0.0};
  if (fitted_ != nullptr) {
    fitted_->add(EdgePlaces::on_both(fan, *mantle_, at, along, most_off(mantle_->body())));
    return;
  }
  fan.add_curve_node(at, along);
  mantle_->add_border_place({cosine, sine, 0.0}, height_, step);
}

bool Rim::follow_arcs(PlaneFan &fan) {
  const double rounding = rounding_of(mantle_->body());
  while (!passages_.empty()) {
    Passages::Arc arc;
    if (!passages_.take_arc(rounding, arc)) return false;
    if (arc.empty) {
      close_straight(fitted_, arc, fan, *mantle_);
      continue;
    }
    add_arc(fan, arc.from.angle, arc.to.angle - arc.from.angle + (arc.round ? sense_ * 2.0 * pi : 0.0));
    close(fitted_, &arc, fan, *mantle_);
  }
  return true;
}

void Rim::add_arc(PlaneFan &fan, double from, double turn) {
  const int parts = 1 + static_cast<int>(std::fabs(turn) / widest);
  const double width = turn / parts;
  const GaussNodes rule = rule_for(std::fabs(width), fitted_, *mantle_);
  const NodeTurns turns(rule, width, std::cos(width), std::sin(width));
  for (int part = 0; part < parts; ++part) {
    begin_arc(fitted_, rule);
    const double cosine = std::cos(from + width * part), sine = std::sin(from + width * part);
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double c = turns.cosine[k], s = turns.sine[k];
      add_place(fan, cosine * c - sine * s, sine * c + cosine * s, width * rule.weight[k]);
    }
  }
}

void MantleSection::add_swing(PlaneFan &fan, double from, double turn) {
  const int parts = 1 + static_cast<int>(std::fabs(turn) / widest);
  const double width = turn / parts;
  const GaussNodes rule = rule_for(std::fabs(width), fitted_, *mantle_);
  const NodeTurns turns(rule, width, std::cos(width), std::sin(width));
  for (int part = 0; part < parts; ++part) {
    begin_arc(fitted_, rule);
    const double cosine0 = std::cos(from + width * part), sine0 = std::sin(from + width * part);
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double c = turns.cosine[k], s = turns.sine[k], cosine = cosine0 * c - sine0 * s, sine = sine0 * c + cosine0 * s;
      const double step = width * rule.weight[k];
      add_place(fan, cosine, sine, swing_front_ + swing_ * (1.0 - cosine), step, swing_ * sine * step);
    }
  }
}

void MantleSection::add_way_by_apex(PlaneFan &fan, double angle0, double height0, double angle1, double height1) {
  const RevolvedBody &body = mantle_->body();
  const auto outward = [&](double angle) { return std::cos(angle) * along_ + std::sin(angle) * across_; };
  const auto place = [&](double angle, double height) {
    return mantle_->in_common()(body.radius_at(height) * outward(angle) + Vec3{0.0, 0.0, height});
  };
  fan.add_segment(place(angle0, height0), place(angle1, height1));
  const double turn = angle1 - angle0, height = std::max(height0, height1);
  const GaussNodes rule = rule_for(std::fabs(turn), fitted_, *mantle_);
  for (std::size_t k = 0; k < rule.count; ++k) {
    mantle_->add_border_place(outward(angle0 + rule.node[k] * turn), height, rule.weight[k] * turn);
  }
}

void MantleSection::add_arc(PlaneFan &fan, double angle0, double height0, double angle1, double height1) {
  const RevolvedBody &body = mantle_->body();
  const double turn = angle1 - angle0;
  if (body.is_cylinder()) {
    const int parts = 1 + static_cast<int>(std::fabs(turn) / widest);
    constexpr double hardly = 1e-4;  // by the angle: as good as a straight line along the axis
    const bool is_line = std::fabs(turn) < hardly * std::min(std::fabs(angle0), std::fabs(angle1));
    const GaussNodes rule = is_line ? GaussNodes(gauss_rule<5>) : rule_for(std::fabs(turn) / parts, fitted_, *mantle_);
    const CosineWay cosine_way(angle0, turn);
    const double half = 0.5 * turn / parts;
    const NodeTurns halves(rule, half, std::cos(half), std::sin(half));
    for (int part = 0; part < parts; ++part) {
      begin_arc(fitted_, rule);
      const double cosine = std::cos(part * half), sine = std::sin(part * half);
      for (std::size_t k = 0; k < rule.count; ++k) {
        const double weight = rule.weight[k] / parts, c = halves.cosine[k], s = halves.sine[k];
        const CosineWay::Place at = cosine_way.at((part + rule.node[k]) / parts, cosine * c - sine * s, sine * c + cosine * s);
        add_place(fan, at.cosine, at.sine, height0 + at.way * (height1 - height0), weight * turn, weight * at.slope * (height1 - height0));
      }
    }
    return;
  }
  const double down0 = std::max(body.half - height0, 0.0), down1 = std::max(body.half - height1, 0.0);
  constexpr double in_apex = 1e-10;  // by the way there
  if (std::min(down0, down1) <= in_apex * std::max(down0, down1)) {
    add_way_by_apex(fan, angle0, height0, angle1, height1);
    return;
  }
  // The inverse of how far a cone's place is below the apex is linear in the cosine. Parts in which that hardly changes.
  if (std::fabs(turn) < 1e-9) {  // a straight line, as good as
    const GaussNodes rule = rule_for(std::fabs(std::log(down1 / down0)), fitted_, *mantle_);
    begin_arc(fitted_, rule);
    for (std::size_t k = 0; k < rule.count; ++k) {
      const double part = rule.node[k], angle = angle0 + part * turn;
      add_place(fan, std::cos(angle), std::sin(angle), height0 + part * (height1 - height0), rule.weight[k] * turn,
                rule.weight[k] * (height1 - height0));
    }
    return;
  }
  const double inverse0 = 1.0 / down0, inverse1 = 1.0 / down1, ratio = down1 / down0;
  constexpr double most_ratio = 2.0;
  const auto places_of = [&](double begin, double angle) {
    const double by_angle = places_for(std::fabs(angle), fitted_, *mantle_);
    return fitted_ != nullptr ? by_angle : std::max(by_angle, places_by_pole(pole_, begin, angle));
  };
  int parts = 1 + static_cast<int>(std::max(std::fabs(turn) / widest_of_cone, std::fabs(std::log(ratio)) / std::log(most_ratio)));
  double places_of_whole = HUGE_VAL;
  if (parts == 1 || (fitted_ == nullptr && std::fabs(turn) < widest)) {
    // One rule may serve for several such parts, angle and pole together.
    constexpr double together = 1.5;
    places_of_whole = places_of(angle0, turn) + (parts == 1 ? 0.0 : together);
    if (places_of_whole <= most_places) parts = 1;
  }
  const CosineWay whole_way(angle0, turn);
  // Where the cosine has gone a part of its way; by both ends' half angles, as a lying cone's conic is narrower than cosines tell.
  const auto square = [](double x) { return x * x; };
  const double sine0 = square(std::sin(0.5 * angle0)), sine1 = square(std::sin(0.5 * angle1));
  const double cosine0 = square(std::cos(0.5 * angle0)), cosine1 = square(std::cos(0.5 * angle1));
  const auto angle_at = [&](double way) {
    return 2.0 * std::atan2(std::sqrt((1.0 - way) * sine0 + way * sine1), std::sqrt((1.0 - way) * cosine0 + way * cosine1));
  };
  double from = angle0, from_inverse = inverse0;
  for (int part = 0; part < parts; ++part) {
    double to = angle1, to_inverse = inverse1;
    if (part + 1 < parts) {
      if (std::fabs(turn) / widest_of_cone > std::fabs(std::log(ratio)) / std::log(most_ratio)) {
        to = angle0 + turn * (part + 1) / parts;
        to_inverse = inverse0 + whole_way.at(static_cast<double>(part + 1) / parts).way * (inverse1 - inverse0);
      } else {
        to_inverse = inverse0 * std::pow(ratio, -static_cast<double>(part + 1) / parts);
        const double way = (to_inverse - inverse0) / (inverse1 - inverse0);
        to = std::copysign(angle_at(way), angle0 + angle1);
      }
    }
    const double part_turn = to - from;
    const CosineWay cosine_way(from, part_turn);
    const double places = parts == 1 ? places_of_whole : places_of(from, part_turn);
    const GaussNodes rule = rule_of(static_cast<int>(std::ceil(std::min(places, most_places))));
    begin_arc(fitted_, rule);
    const NodeTurns halves = cosine_way.half_turns(rule);
    for (std::size_t k = 0; k < rule.count; ++k) {
      const CosineWay::Place at = cosine_way.at(rule.node[k], halves.cosine[k], halves.sine[k]);
      const double down = 1.0 / (from_inverse + at.way * (to_inverse - from_inverse));
      add_place(fan, at.cosine, at.sine, body.half - down, rule.weight[k] * part_turn,
                rule.weight[k] * at.slope * (to_inverse - from_inverse) * down * down);
    }
    from = to, from_inverse = to_inverse;
  }
}

}  // namespace cmb
