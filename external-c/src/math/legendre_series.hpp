// The series of Legendre's polynomials through values at a Gauss rule's nodes.
#pragma once

#include <cstddef>

namespace cmb {

// Of a rule of `count` nodes; gauss_rule.hpp makes it.
struct LegendreSeries {
  std::size_t count;
  const double *node, *weight;
  const double *last, *next;  // by these, values add to its last two coefficients
  // A row a node: by it the parts that the nodes have in an integral add to the integral as far as there; exact for polynomials of degree
  // count - 1.
  const double *part;
};

}  // namespace cmb
