// Gauss' rule of integration.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "math/cosine_sine.hpp"
#include "math/legendre_series.hpp"
#include "math/pi.hpp"

namespace cmb::overlap {

// Nodes and weights on [0, 1]; exact for polynomials of degree 2 n - 1.
template <int n>
struct GaussRule {
  std::array<double, n> node, weight;
  GaussRule() {
    for (int k = 0; k < n; ++k) {
      // Newton's method on Legendre's polynomial.
      double x = std::cos(pi * (k + 0.75) / (n + 0.5)), slope = 1.0;
      for (int step = 0; step < 20; ++step) {
        double before = 1.0, value = x;
        for (int j = 2; j <= n; ++j) {
          const double next = ((2 * j - 1) * x * value - (j - 1) * before) / j;
          before = value, value = next;
        }
        slope = n * (x * value - before) / (x * x - 1.0);
        x -= value / slope;
      }
      node[static_cast<std::size_t>(k)] = 0.5 * (1.0 + x);
      weight[static_cast<std::size_t>(k)] = 1.0 / ((1.0 - x * x) * slope * slope);
    }
  }
};

// Made when the program is loaded, not while others may ask.
template <int n>
inline const GaussRule<n> gauss_rule;

// What a LegendreSeries is made of.
template <int n>
struct GaussSeries {
  std::array<double, n> last, next;
  std::array<std::array<double, n>, n> part;
  GaussSeries() {
    const GaussRule<n> rule;
    // Legendre's polynomials up to degree n at the nodes.
    std::array<std::array<double, n + 1>, n> value;
    for (std::size_t k = 0; k < n; ++k) {
      const double x = 2.0 * rule.node[k] - 1.0;
      value[k][0] = 1.0, value[k][1] = x;
      for (int j = 2; j <= n; ++j) {
        const auto at = static_cast<std::size_t>(j);
        value[k][at] = ((2 * j - 1) * x * value[k][at - 1] - (j - 1) * value[k][at - 2]) / j;
      }
    }
    for (std::size_t k = 0; k < n; ++k) {
      last[k] = (2 * n - 1) * rule.weight[k] * value[k][n - 1];
      next[k] = (2 * n - 3) * rule.weight[k] * value[k][n - 2];
      for (std::size_t j = 0; j < n; ++j) {
        double sum = rule.node[k];
        for (std::size_t l = 1; l < n; ++l) sum += 0.5 * value[j][l] * (value[k][l + 1] - value[k][l - 1]);
        part[k][j] = sum;
      }
    }
  }
};

template <int n>
inline const GaussSeries<n> gauss_series;

// Any of them.
struct GaussNodes {
  const double *node, *weight;
  std::size_t count;
  LegendreSeries series;
  template <int n>
  explicit GaussNodes(const GaussRule<n> &rule)
      : node(rule.node.data()),
        weight(rule.weight.data()),
        count(n),
        series{n, rule.node.data(), rule.weight.data(), gauss_series<n>.last.data(), gauss_series<n>.next.data(), gauss_series<n>.part[0].data()} {}
};

// Cosines and sines of an angle's parts up to the nodes; of two nodes opposite each other one from the other.
struct NodeTurns {
  static constexpr std::size_t most = 16;
  double cosine[most], sine[most];
  NodeTurns(const GaussNodes &rule, double angle, double whole_cosine, double whole_sine) {
    const std::size_t middle = rule.count / 2;
    if (std::fabs(angle) <= convex::widest_of_series) {
      for (std::size_t near = middle; near < rule.count; near += 2) {
        const std::size_t next = near + 1 < rule.count ? near + 1 : near;
        convex::Lanes c, s;
        convex::find_cosine_sine(convex::Lanes{rule.node[near], rule.node[next]} * angle, c, s);
        cosine[near] = c[0], sine[near] = s[0];
        cosine[next] = c[1], sine[next] = s[1];
      }
    } else {
      for (std::size_t near = middle; near < rule.count; ++near) {
        const double part = rule.node[near] * angle;
        cosine[near] = std::cos(part), sine[near] = std::sin(part);
      }
    }
    for (std::size_t near = rule.count - middle; near < rule.count; ++near) {
      const double c = cosine[near], s = sine[near];
      const std::size_t far = rule.count - 1 - near;
      cosine[far] = whole_cosine * c + whole_sine * s, sine[far] = whole_sine * c - whole_cosine * s;
    }
  }
};

}  // namespace cmb::overlap
