// Gauss' rule of integration.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

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

// Any of them.
struct GaussNodes {
  const double *node, *weight;
  std::size_t count;
  template <int n>
  explicit GaussNodes(const GaussRule<n> &rule) : node(rule.node.data()), weight(rule.weight.data()), count(n) {}
};

}  // namespace cmb::overlap
