// Integrals along a conic's side; part of conic_section.hpp.
#pragma once

#include <algorithm>
#include <cmath>

#include "math/gauss_rule.hpp"
#include "volume/slices/conic_section.hpp"

namespace cmb::overlap {

// A stretch of angles cut into equal parts, and the rule for each. `fine`: angles up to it are short.
struct AngleParts {
  int count;
  double width;
  GaussNodes rule;

  AngleParts(double whole, double fine)
      : count(1 + static_cast<int>(std::min(64.0, whole / (2.0 * fine)))),
        width(whole / count),
        rule(width > 0.4 * fine   ? GaussNodes(gauss_rule<10>)
             : width > 0.1 * fine ? GaussNodes(gauss_rule<6>)
                                  : GaussNodes(gauss_rule<4>)) {}
};

// In the angles used here x and the root of D are sums of sines and cosines, circular or hyperbolic, also at the ends of
// reach: rules converge as for entire functions.
template <typename Visit>
void Conic::integrate(bool upper, double from, double to, Visit &&visit) const {
  // place(angle): x, root and dx/dangle.
  const auto sum = [&](const GaussNodes &rule, double start, double width, auto &&place) {
    for (std::size_t k = 0; k < rule.count; ++k) {
      double x, root, slope;
      place(start + width * rule.node[k], x, root, slope);
      visit(x, side(upper, x, root), std::fabs(slope) * width * rule.weight[k]);
    }
  };
  const auto sum_parts = [&](double begin, double end, double fine, auto &&place) {
    const AngleParts parts(end - begin, fine);
    for (int part = 0; part < parts.count; ++part) {
      sum(parts.rule, begin + (end - begin) * part / parts.count, parts.width, place);
    }
  };
  const GaussNodes few(gauss_rule<4>), many(gauss_rule<10>);
  // Far from the ends of reach x itself will do, and keeps its digits; `squared(t)`: D at from + t, > 0.
  const double length = to - from;
  const auto plainly = [&](auto &&squared) {
    for (std::size_t k = 0; k < many.count; ++k) {
      const double t = length * many.node[k], x = from + t;
      visit(x, side(upper, x, std::sqrt(squared(t))), length * many.weight[k]);
    }
  };
  switch (kind_) {
    case Kind::ellipse: {
      const double reach = size_, rate = std::sqrt(-d2_) * reach;
      const double off = from - end_[0], rest = end_[1] - from;
      if (off >= length && rest >= 2.0 * length) return plainly([&](double t) { return -d2_ * (off + t) * (rest - t); });
      const bool left = from - end_[0] <= end_[1] - to;
      const double begin = std::max(0.0, left ? from - end_[0] : end_[1] - to);
      const double end = std::min(reach, left ? to - end_[0] : end_[1] - from);
      const auto angle_at = [&](double u) { return std::atan2(std::sqrt(u), std::sqrt(reach - u)); };
      sum_parts(angle_at(begin), angle_at(end), 0.8, [&](double angle, double &x, double &root, double &slope) {
        const double s = std::sin(angle), c = std::cos(angle), u = reach * s * s;
        x = left ? end_[0] + u : end_[1] - u;
        root = rate * s * c;
        slope = 2.0 * reach * s * c;
      });
      return;
    }
    case Kind::hyperbola: {
      const double rate = std::sqrt(d2_) * size_, off = std::fabs(from - end_[0]), way = from_left_ ? 1.0 : -1.0;
      if (std::min(off, std::fabs(to - end_[0])) >= length) {
        return plainly([&](double t) { return d2_ * (off + way * t) * (off + way * t + size_); });
      }
      const double begin = std::max(0.0, from_left_ ? from - end_[0] : end_[0] - to);
      const double end = std::max(begin, from_left_ ? to - end_[0] : end_[0] - from);
      const auto angle_at = [&](double u) { return std::asinh(std::sqrt(u / size_)); };
      sum_parts(angle_at(begin), angle_at(end), 0.4, [&](double angle, double &x, double &root, double &slope) {
        const double s = std::sinh(angle), c = std::sqrt(1.0 + s * s), u = size_ * s * s;
        x = from_left_ ? end_[0] + u : end_[0] - u;
        root = rate * s * c;
        slope = 2.0 * size_ * s * c;
      });
      return;
    }
    case Kind::open_hyperbola: {
      const double rate = std::sqrt(d2_) * size_;
      const auto angle_at = [&](double x) { return std::asinh((x - end_[0]) / size_); };
      sum_parts(angle_at(from), angle_at(to), 0.8, [&](double angle, double &x, double &root, double &slope) {
        const double s = std::sinh(angle), c = std::sqrt(1.0 + s * s);
        x = end_[0] + size_ * s;
        root = rate * c;
        slope = size_ * c;
      });
      return;
    }
    case Kind::parabola: {
      const double rate = std::sqrt(2.0 * std::fabs(d1_)), off = std::fabs(from - end_[0]), way = from_left_ ? 1.0 : -1.0;
      if (std::min(off, std::fabs(to - end_[0])) >= length) {
        return plainly([&](double t) { return 2.0 * std::fabs(d1_) * (off + way * t); });
      }
      const double begin = std::max(0.0, from_left_ ? from - end_[0] : end_[0] - to);
      const double end = std::max(begin, from_left_ ? to - end_[0] : end_[0] - from);
      const double start = std::sqrt(begin);
      sum(few, start, std::sqrt(end) - start, [&](double angle, double &x, double &root, double &slope) {
        x = from_left_ ? end_[0] + angle * angle : end_[0] - angle * angle;
        root = rate * angle;
        slope = 2.0 * angle;
      });
      return;
    }
    case Kind::level: {
      const double root = std::sqrt(d0_);
      sum(few, from, to - from, [&](double place, double &x, double &r, double &slope) {
        x = place, r = root, slope = 1.0;
      });
      return;
    }
    case Kind::empty:
    case Kind::wall: return;
  }
}

}  // namespace cmb::overlap
