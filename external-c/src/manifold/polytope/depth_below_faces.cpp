#include "manifold/polytope/depth_below_faces.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"

namespace cmb {

namespace {

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
    for (std::vector<double> *const room : {&below_, &mean_square_, &part_}) room->resize(size * count + 1);
    bounds_.resize(count);
    groups_.resize(count);
    near_.resize(size * count + 1);
    normal_.resize(size * count + 1);
  }
  const Vec3 middle = transposed_times(in_axes.rotation, overlap_middle - in_axes.translation);
  const SymmetricMatrix spread = turned(transposed(in_axes.rotation), overlap_spread);
  const double *const x = clusters.normals(0), *const y = clusters.normals(1), *const z = clusters.normals(2);
  const double *const offset = clusters.offsets();
  double *const below = below_.data(), *const mean_square = mean_square_.data(), *const part = part_.data();
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
  least = HUGE_VAL;
  for (std::size_t k = 0; k < near_count; ++k) {
    const std::size_t f = near[k];
    const Vec3 n = in_axes.rotation * Vec3{x[f], y[f], z[f]};
    normal_[k] = n;
    mean_square[f] = below[f] * below[f] + dot(n, times(overlap_spread, n));
    least = mean_square[f] < least ? mean_square[f] : least;
  }
  double sum = 0.0, raised = 0.0;  // of e^-8 and of e^-7, in units of the least
  for (std::size_t k = 0; k < near_count; ++k) {
    const double inverse = least / mean_square[near[k]], square = inverse * inverse;
    const double seventh = square * square * square * inverse;
    part[k] = inverse;
    sum += seventh * inverse;
    raised += seventh;
  }
  const double mean = raised / sum, inverse_sum = 1.0 / sum;
  squares_ = {};
  for (std::size_t k = 0; k < near_count; ++k) {
    const double square = part[k] * part[k], fourth = square * square, depth = below[near[k]];
    const double weight = fourth * fourth * (8.0 * mean * part[k] - 7.0) * inverse_sum;
    const Vec3 &n = normal_[k], scaled = weight * n;
    squares_.squares.m[0] += scaled.x * n.x, squares_.squares.m[1] += scaled.y * n.y, squares_.squares.m[2] += scaled.z * n.z;
    squares_.squares.m[3] += scaled.y * n.z, squares_.squares.m[4] += scaled.z * n.x, squares_.squares.m[5] += scaled.x * n.y;
    squares_.linear = squares_.linear + depth * scaled;
    squares_.constant += weight * depth * depth;
  }
  least_ = least * mean;
  moment_ = 2.0 * sum_of_crosses(overlap_spread, squares_.squares);
}

}  // namespace cmb
