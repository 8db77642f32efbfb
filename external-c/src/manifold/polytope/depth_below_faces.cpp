#include "manifold/polytope/depth_below_faces.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"

namespace cmb {

namespace {

using convex::Lanes;
using convex::LaneVec3;
using convex::Mat3;
using convex::SymmetricMatrix;

// turn matrix turn^T
SymmetricMatrix turned(const Mat3 &turn, const SymmetricMatrix &matrix) {
  const Vec3 x = times(matrix, turn.row[0]), y = times(matrix, turn.row[1]), z = times(matrix, turn.row[2]);
  return {{dot(turn.row[0], x), dot(turn.row[1], y), dot(turn.row[2], z), dot(turn.row[1], z), dot(turn.row[2], x), dot(turn.row[0], y)}};
}

// The sum of row x row of both matrices, row by row.
Vec3 sum_of_crosses(const SymmetricMatrix &left, const SymmetricMatrix &right) {
  const double(&l)[6] = left.m, (&r)[6] = right.m;
  const Vec3 left_row[3] = {{l[0], l[5], l[4]}, {l[5], l[1], l[3]}, {l[4], l[3], l[2]}};
  const Vec3 right_row[3] = {{r[0], r[5], r[4]}, {r[5], r[1], r[3]}, {r[4], r[3], r[2]}};
  return cross(left_row[0], right_row[0]) + cross(left_row[1], right_row[1]) + cross(left_row[2], right_row[2]);
}

// Of planes: how far the middle is below them, and the mean square of that over what has this spread about the middle. Arrays
// that do not overlap, so that compilers make vectors of them.
void find_mean_squares(std::size_t count, const double *__restrict x, const double *__restrict y, const double *__restrict z,
                       const double *__restrict offset, const Vec3 &middle, const SymmetricMatrix &spread,
                       double *__restrict below, double *__restrict mean_square) {
  const double mx = middle.x, my = middle.y, mz = middle.z;
  const double xx = spread.m[0], yy = spread.m[1], zz = spread.m[2];
  const double yz = 2.0 * spread.m[3], zx = 2.0 * spread.m[4], xy = 2.0 * spread.m[5];
  for (std::size_t f = 0; f < count; ++f) {
    const double nx = x[f], ny = y[f], nz = z[f], depth = offset[f] - (nx * mx + ny * my + nz * mz);
    below[f] = depth;
    mean_square[f] = depth * depth + nx * (nx * xx + ny * xy) + ny * (ny * yy + nz * yz) + nz * (nz * zz + nx * zx);
  }
}

}  // namespace

// Which faces count is found in the body's frame, where its planes stand still.
void DepthBelowFaces::find(const Vec3 &overlap_middle, const SymmetricMatrix &overlap_spread, const ContactPolytope &body,
                           const Pose &in_axes) {
  constexpr std::size_t size = FaceClusters::size;
  // Faces with a greater mean square, by the least, change the energy by less than 1e-14 of it.
  constexpr double farthest = 100.0;
  // Here squares of the overlap's depth are differences of those of its width.
  const double lost = 1e-14 * overlap_spread.trace();
  const FaceClusters &clusters = body.clusters();
  const std::size_t count = clusters.count();
  if (bounds_.size() < count) {
    for (std::vector<double> *const room : {&below_, &mean_square_}) room->resize(size * count + 1);
    bounds_.resize(count);
    groups_.resize(count);
    near_.resize(size * count + 1);
    pairs_.resize(size * count / 2 + 1);
  }
  const Vec3 middle = transposed_times(in_axes.rotation, overlap_middle - in_axes.translation);
  const SymmetricMatrix spread = turned(transposed(in_axes.rotation), overlap_spread);
  const double *const x = clusters.normals(0), *const y = clusters.normals(1), *const z = clusters.normals(2);
  const double *const offset = clusters.offsets();
  double *const below = below_.data(), *const mean_square = mean_square_.data();
  // Few groups are looked at as one.
  constexpr std::size_t few = 8;
  const std::size_t width = count <= few ? size * count : size;
  double least = HUGE_VAL;
  std::size_t looked_at = 0;
  const auto look_at = [&](std::size_t at) {
    find_mean_squares(width, x + at, y + at, z + at, offset + at, middle, spread, below + at, mean_square + at);
    const double here = convex::least_of(mean_square + at, width);
    least = here < least ? here : least;
    groups_[looked_at++] = at;
  };
  if (count <= few) {
    look_at(0);
  } else {
    // First the group that may be nearest: others mostly turn out to be farther than counts.
    double *const bounds = bounds_.data();
    clusters.find_bounds(middle, bounds);
    const auto first = static_cast<std::size_t>(std::min_element(bounds, bounds + count) - bounds);
    look_at(size * first);
    for (std::size_t g = 0; g < count; ++g) {
      if (g != first && !(bounds[g] > 0.0 && bounds[g] * bounds[g] > farthest * (least + lost))) look_at(size * g);
    }
  }
  std::size_t *const near = near_.data();
  std::size_t near_count = 0;
  const double limit = farthest * (least + lost);
  for (std::size_t k = 0; k < looked_at; ++k) {
    const std::size_t begin = groups_[k];
    for (std::size_t f = begin; f < begin + width; ++f) {  // which count is unpredictable: no branch
      near[near_count] = f;
      near_count += mean_square[f] <= limit ? 1 : 0;
    }
  }
  // Once more in the overlap's axes. Where one of them is perpendicular to a face that it is thin below, the square of its thickness is
  // not a difference of squares of its width.
  near[near_count] = near[0];  // in place of a second one of the last two
  const std::size_t pairs = (near_count + 1) / 2;
  Lanes leasts{HUGE_VAL, HUGE_VAL};
  for (std::size_t k = 0; k < pairs; ++k) {
    const std::size_t f = near[2 * k], g = near[2 * k + 1];
    PairOfFaces &pair = pairs_[k];
    pair.normal = in_axes.rotation * LaneVec3(Lanes{x[f], x[g]}, Lanes{y[f], y[g]}, Lanes{z[f], z[g]});
    pair.below = Lanes{below[f], below[g]};
    pair.mean_square = pair.below * pair.below + dot(pair.normal, times(overlap_spread, pair.normal));
    leasts = pair.mean_square < leasts ? pair.mean_square : leasts;
  }
  least = std::fmin(leasts[0], leasts[1]);
  Lanes sums{}, raiseds{};  // of e^-8 and of e^-7, in units of the least
  for (std::size_t k = 0; k < pairs; ++k) {
    Lanes inverse = least / pairs_[k].mean_square;
    if (2 * k + 1 == near_count) inverse[1] = 0.0;
    const Lanes square = inverse * inverse, seventh = square * square * square * inverse;
    pairs_[k].inverse = inverse;
    sums += seventh * inverse;
    raiseds += seventh;
  }
  const double sum = convex::sum_of(sums), mean = convex::sum_of(raiseds) / sum, inverse_sum = 1.0 / sum;
  Lanes xx{}, yy{}, zz{}, yz{}, zx{}, xy{}, constant{};
  LaneVec3 linear;
  for (std::size_t k = 0; k < pairs; ++k) {
    const PairOfFaces &pair = pairs_[k];
    const Lanes square = pair.inverse * pair.inverse, fourth = square * square;
    const Lanes weight = fourth * fourth * (8.0 * mean * pair.inverse - 7.0) * inverse_sum;
    const LaneVec3 &n = pair.normal, scaled = weight * n;
    xx += scaled.x * n.x, yy += scaled.y * n.y, zz += scaled.z * n.z;
    yz += scaled.y * n.z, zx += scaled.z * n.x, xy += scaled.x * n.y;
    linear = linear + pair.below * scaled;
    constant += weight * pair.below * pair.below;
  }
  squares_ = {{{convex::sum_of(xx), convex::sum_of(yy), convex::sum_of(zz), convex::sum_of(yz), convex::sum_of(zx), convex::sum_of(xy)}}, convex::sum_of(linear), convex::sum_of(constant)};
  least_ = least * mean;
  moment_ = 2.0 * sum_of_crosses(overlap_spread, squares_.squares);
}

}  // namespace cmb
