// Gauss' rule of 7 and Kronrod's of 15 nodes (QUADPACK: Piessens et al. 1983).
#pragma once

#include <algorithm>
#include <cmath>

namespace cmb::overlap {

// Calls visit(s, kronrod, gauss): nodes on (0, 1), Kronrod's weights, of sum 2, and Gauss', 0 at nodes that are not his.
template <typename Visit>
void visit_kronrod_nodes(Visit &&visit) {
  // On [-1, 1], from the outer nodes to the middle.
  constexpr double node[8] = {0.991455371120812639206854697526329, 0.949107912342758524526189684047851,
                              0.864864423359769072789712788640926, 0.741531185599394439863864773280788,
                              0.586087235467691130294144691258381, 0.405845151377397166906606412076961,
                              0.207784955007898467600689403773245, 0.0};
  constexpr double kronrod[8] = {0.022935322010529224963732008058970, 0.063092092629978553290700663189204,
                                 0.104790010322250183839876322541518, 0.140653259715525918745189590510238,
                                 0.169004726639267902826583426598550, 0.190350578064785409913256402421014,
                                 0.204432940075298892414161999234649, 0.209482141084727828012999174891714};
  constexpr double gauss[4] = {0.129484966168869693270611432679082, 0.279705391489276667901467771423780,
                               0.381830050505118944950369775488975, 0.417959183673469387755102040816327};
  for (int k = 0; k < 8; ++k) {
    const double weight = k % 2 == 1 ? gauss[k / 2] : 0.0;
    visit(0.5 - 0.5 * node[k], kronrod[k], weight);
    if (k < 7) visit(0.5 + 0.5 * node[k], kronrod[k], weight);
  }
}

// How far Kronrod's sum is off. The difference from Gauss' overestimates it: QUADPACK's correction by what the integral is.
inline double kronrod_error(double kronrod, double gauss) {
  const double difference = std::fabs(kronrod - gauss), integral = std::fabs(kronrod);
  if (!(integral > 0.0)) return difference;
  return integral * std::min(1.0, std::pow(200.0 * difference / integral, 1.5));
}

}  // namespace cmb::overlap
