#include "manifold/revolved/mantle_crossing.hpp"

#include <algorithm>
#include <cmath>

#include "math/gauss_rule.hpp"
#include "math/pi.hpp"

namespace cmb {

namespace {

constexpr int most_steps = 1000;
constexpr double straight = 0.85;  // the cosine of how much the curve may turn in a step, itself and about the axes

// By a step's length: how far a cubic may be from it. Of cones the curve may nearly meet itself.
constexpr double bent_of_cylinders = 2e-3, bent_of_cones = 2e-4;

}  // namespace

MantleCrossing::Side::Side(Mantle &m)
    : mantle(&m),
      axis(m.in_common().rotation.column(2)),
      center(m.in_common().translation),
      slope(m.body().slope),
      radius(m.body().radius_at(0.0)),
      half(m.body().half) {}

double MantleCrossing::Side::beyond(const Vec3 &p) const {
  const Vec3 way = p - center;
  const double z = dot(axis, way), r = radius + slope * z;
  return norm2(way - z * axis) - r * r;
}

Vec3 MantleCrossing::Side::gradient(const Vec3 &p) const {
  const Vec3 way = p - center;
  const double z = dot(axis, way), r = radius + slope * z;
  return 2.0 * (way - (z + slope * r) * axis);
}

double MantleCrossing::Side::turn(const Vec3 &p, const Vec3 &q) const {
  const auto outward = [&](const Vec3 &place) {
    const Vec3 way = place - center;
    return normalized(way - dot(axis, way) * axis);
  };
  return dot(outward(p), outward(q));
}

double MantleCrossing::Side::way_out(const Vec3 &p, const Vec3 &ray, bool &through_mantle) const {
  const Pose &pose = mantle->in_common();
  return mantle->body().way_out(transposed_times(pose.rotation, p - pose.translation), transposed_times(pose.rotation, ray), through_mantle);
}

MantleCrossing::MantleCrossing(Mantle &a, Mantle &b, std::vector<Piece> &followed)
    : a_(a),
      b_(b),
      size_(a.body().radius + a.body().half + b.body().radius + b.body().half),
      bent_(a.body().is_cylinder() && b.body().is_cylinder() ? bent_of_cylinders : bent_of_cones),
      followed_(followed) {
  followed_.clear();
}

// Counter-clockwise about A's mantle, clockwise about B's.
Vec3 MantleCrossing::tangent(const Vec3 &p) const { return normalized(cross(a_.gradient(p), b_.gradient(p))); }

// Moves the place within the plane of this normal onto both mantles.
bool MantleCrossing::correct(const Vec3 &normal, Vec3 &p) const {
  double last = HUGE_VAL;
  for (int round = 0; round < 12; ++round) {
    const double beyond_a = a_.beyond(p), beyond_b = b_.beyond(p);
    const Vec3 of_a = a_.gradient(p), of_b = b_.gradient(p), across = cross(of_b, normal);
    const double whole = dot(of_a, across);
    if (whole == 0.0) return false;
    const Vec3 move = (-1.0 / whole) * (beyond_a * across + beyond_b * cross(normal, of_a));
    const double length = norm(move);
    if (!(length < size_)) return false;
    p = p + move;
    // Moves fall by their squares, at last to rounding.
    const double next = length * (length / last) * (length / last);
    if (length <= 1e-15 * size_ || (length <= 1e-9 * size_ && (length >= 0.5 * last || next <= 1e-17 * size_))) return true;
    last = length;
  }
  return false;
}

bool MantleCrossing::step(const Vec3 &from, const Vec3 &way, double &length, Vec3 &to, Vec3 &way_there, double sense) const {
  for (; length > 1e-13 * size_; length *= 0.5) {
    to = from + length * way;
    const Vec3 ahead = to;
    if (!correct(way, to) || !(norm(to - ahead) < 0.4 * length)) continue;
    way_there = sense * tangent(to);
    if (!(dot(way, way_there) > straight) || !(a_.turn(from, to) > straight) || !(b_.turn(from, to) > straight)) continue;
    const Piece piece(from, way, to, way_there);
    const Vec3 guess = piece.at(0.5);
    Vec3 middle = guess;
    if (piece.ahead && correct(piece.along, middle) && norm(middle - guess) < bent_ * piece.length) return true;
  }
  return false;
}

MantleCrossing::Piece::Piece(const Vec3 &begin, const Vec3 &way, const Vec3 &end, const Vec3 &way_there)
    : from(begin), chord(end - begin), along(normalized(chord)), length(norm(chord)) {
  const double here = dot(way, along), there = dot(way_there, along);
  ahead = here > 0.1 && there > 0.1;
  lean = (1.0 / here) * way - along, lean_there = (1.0 / there) * way_there - along;
}

Vec3 MantleCrossing::Piece::at(double part) const {
  const double rest = 1.0 - part;
  return from + part * chord + (length * part * rest) * (rest * lean - part * lean_there);
}

// `part`: where along the piece.
bool MantleCrossing::is_on(const Piece &piece, const Vec3 &place, double &part) const {
  part = dot(place - piece.from, piece.along) / piece.length;
  if (!(part >= -1e-9) || !(part <= 1.0 + 1e-9)) return false;
  Vec3 at = piece.at(part);
  if (!(norm(at - place) < 0.1 * piece.length + 1e-9 * size_) || !correct(piece.along, at)) return false;
  return norm(at - place) < 1e-7 * size_;
}

// The first corner on the way; corners.size() for none.
std::size_t MantleCrossing::corner_on(const Piece &piece, const std::vector<Corner> &corners) const {
  std::size_t first = corners.size();
  double nearest = HUGE_VAL, part = 0.0;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    if (is_on(piece, corners[k].at, part) && part < nearest) first = k, nearest = part;
  }
  return first;
}

// Whichever way it was followed, a piece counts along the tangent.
bool MantleCrossing::add_piece(const Piece &piece) {
  if (!(piece.length > 1e-14 * size_)) return true;
  if (!piece.ahead) return piece.length < 1e-9 * size_;
  const overlap::GaussNodes rule =
      bent_ == bent_of_cylinders ? overlap::GaussNodes(overlap::gauss_rule<7>) : overlap::GaussNodes(overlap::gauss_rule<8>);
  for (std::size_t k = 0; k < rule.count; ++k) {
    Vec3 at = piece.at(rule.node[k]);
    if (!correct(piece.along, at)) return false;
    const Vec3 direction = tangent(at);
    const Vec3 step = (piece.length * rule.weight[k] / std::fabs(dot(direction, piece.along))) * direction;
    a_.mantle->add_border_node(at, -step);
    b_.mantle->add_border_node(at, step);
  }
  followed_.push_back(piece);
  return true;
}

bool MantleCrossing::follow(const Corner &from, std::vector<Corner> &left) {
  const double sense = dot(tangent(from.at), from.normal) < 0.0 ? 1.0 : -1.0;
  Vec3 at = from.at, way = sense * tangent(from.at);
  double length = 0.5 * std::min(a_.mantle->body().radius, b_.mantle->body().radius);
  const double longest = 0.25 * size_;
  for (int k = 0; k < most_steps; ++k) {
    Vec3 to, way_there;
    if (!step(at, way, length, to, way_there, sense)) return false;
    const Piece piece(at, way, to, way_there);
    const std::size_t corner = corner_on(piece, left);
    if (corner < left.size()) {
      const Vec3 end = left[corner].at;
      left.erase(left.begin() + static_cast<std::ptrdiff_t>(corner));
      return add_piece({at, way, end, sense * tangent(end)});
    }
    if (std::fabs(a_.height(to)) > a_.half || std::fabs(b_.height(to)) > b_.half || !add_piece(piece)) return false;
    at = to, way = way_there;
    length = std::min(longest, 2.0 * length);
  }
  return false;
}

bool MantleCrossing::follow_loop_from(const Vec3 &start) {
  const Vec3 first_way = tangent(start);
  Vec3 at = start, way = first_way;
  double length = 0.5 * std::min(a_.mantle->body().radius, b_.mantle->body().radius);
  const double longest = 0.25 * size_;
  for (int k = 0; k < most_steps; ++k) {
    Vec3 to, way_there;
    if (!step(at, way, length, to, way_there, 1.0)) return false;
    if (std::fabs(a_.height(to)) > a_.half || std::fabs(b_.height(to)) > b_.half) return false;
    const Vec3 rest = start - at;
    const double ahead = dot(rest, way);
    if (k > 1 && ahead > 0.0 && ahead <= length && norm(rest) < 1.2 * ahead && dot(way, first_way) > 0.5) {
      return add_piece({at, way, start, first_way});
    }
    if (!add_piece({at, way, to, way_there})) return false;
    at = to, way = way_there;
    length = std::min(longest, 1.5 * length);
  }
  return false;
}

bool MantleCrossing::follow_loop(const Vec3 &place) {
  Vec3 at;
  if (a_.holds(place) && b_.holds(place) && find_loop(place, at)) return follow_loop_from(at);
  for (const Side *side : {&a_, &b_}) {
    // The middle of the axis in the other body.
    const Side &other = side == &a_ ? b_ : a_;
    const Pose &pose = other.mantle->in_common();
    double middle = 0.0;
    const bool meets = other.mantle->body().middle_of(transposed_times(pose.rotation, side->center - pose.translation),
                                                      transposed_times(pose.rotation, side->axis), middle);
    const Vec3 inside = side->center + middle * side->axis;
    if (meets && side->holds(inside) && find_loop(inside, at)) return follow_loop_from(at);
  }
  return false;
}

bool MantleCrossing::find_loop(const Vec3 &inside, Vec3 &at) const {
  const Vec3 poles[] = {normalized(normalized(a_.gradient(inside)) - normalized(b_.gradient(inside))), a_.axis, -a_.axis, b_.axis, -b_.axis};
  for (const Vec3 &pole : poles) {
    const Vec3 side = convex::any_perpendicular(pole), other = cross(pole, side);
    for (const Vec3 &equator : {side, other, -side, -other}) {
      double part = 0.0;
      if (!find(inside, pole, equator, at)) continue;
      if (std::none_of(followed_.begin(), followed_.end(), [&](const Piece &piece) { return is_on(piece, at, part); })) return true;
    }
  }
  return false;
}

// Rays from the place leave one body through its mantle along the pole, the other one elsewhere; between these ways both at once.
bool MantleCrossing::find(const Vec3 &inside, const Vec3 &pole, const Vec3 &equator, Vec3 &at) const {
  // 1: through A's mantle; -1: through B's; 0: through an end.
  const auto leaves = [&](double angle) {
    const Vec3 ray = std::cos(angle) * pole + std::sin(angle) * equator;
    bool mantle_a = false, mantle_b = false;
    const double way_a = a_.way_out(inside, ray, mantle_a), way_b = b_.way_out(inside, ray, mantle_b);
    at = inside + std::min(way_a, way_b) * ray;
    return way_a < way_b ? (mantle_a ? 1 : 0) : (mantle_b ? -1 : 0);
  };
  double low = 0.0, high = 0.5 * pi;
  const int first = leaves(low);
  if (first == 0) return false;
  if (leaves(high) != -first) {
    low = high, high = pi;
    if (leaves(low) != first || leaves(high) != -first) return false;
  }
  for (int round = 0; round < 50; ++round) {
    const double middle = 0.5 * (low + high);
    const int through = leaves(middle);
    if (through == 0) return false;
    (through == first ? low : high) = middle;
  }
  return correct(tangent(at), at) && std::fabs(a_.height(at)) < a_.half && std::fabs(b_.height(at)) < b_.half;
}

}  // namespace cmb
