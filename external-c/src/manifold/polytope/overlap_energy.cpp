#include "manifold/polytope/overlap_energy.hpp"

#include <algorithm>
#include <cmath>

#include "math/branchless.hpp"

namespace cmb {

namespace {

using convex::Mat3;
using convex::SymmetricMatrix;

Vec3 times(const SymmetricMatrix &matrix, const Vec3 &p) {
  const double(&m)[6] = matrix.m;
  return {m[0] * p.x + m[5] * p.y + m[4] * p.z, m[5] * p.x + m[1] * p.y + m[3] * p.z, m[4] * p.x + m[3] * p.y + m[2] * p.z};
}

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

// Integrals over the surface of a quadric, and of place times quadric; places are from the overlap's middle.
class SurfaceIntegral {
 public:
  explicit SurfaceIntegral(const Quadric &quadric) : q_(quadric) {}

  void add(const OverlapSolid &solid, const OverlapSolid::Piece &piece) {
    const Vec3 *const corners = solid.points().data() + piece.first, middle = solid.middle();
    double whole = 0.0;
    Vec3 places;
    const Corner p = corner(corners[0] - middle);
    Corner q = corner(corners[1] - middle);
    for (std::size_t i = 2; i < piece.count; ++i) {
      const Corner r = corner(corners[i] - middle);
      const double area = 0.5 * dot(piece.normal, cross(q.at - p.at, r.at - p.at));
      if (piece.fades == nullptr) {
        add_triangle(area, p, q, r, whole, places);
      } else {
        add_faded(area, p.at, q.at, r.at, solid, *piece.fades, whole, places);
      }
      q = r;
    }
    force_ = force_ + whole * piece.normal;
    torque_ = torque_ + cross(places, piece.normal);
  }

  const Vec3 &force() const { return force_; }
  const Vec3 &torque() const { return torque_; }

 private:
  // A place with the quadric's polar plane and value there.
  struct Corner {
    Vec3 at, gradient;
    double rest, value;
  };
  Corner corner(const Vec3 &p) const {
    const Vec3 gradient = times(q_.squares, p) - q_.linear;
    const double rest = q_.constant - dot(q_.linear, p);
    return {p, gradient, rest, dot(gradient, p) + rest};
  }

  // Exact: integrals of products of two and three barycentric coordinates are area/12 and area/60, twice that where two are
  // equal, six times where three are.
  static void add_triangle(double area, const Corner &p, const Corner &q, const Corner &r, double &whole, Vec3 &places) {
    const Vec3 sum = p.at + q.at + r.at, gradient = p.gradient + q.gradient + r.gradient;
    const double rest = p.rest + q.rest + r.rest;
    const double with_p = dot(gradient, p.at) + rest, with_q = dot(gradient, q.at) + rest, with_r = dot(gradient, r.at) + rest;
    const double all = with_p + with_q + with_r + p.value + q.value + r.value, part = area / 60.0;
    whole += 5.0 * part * all;
    places = places + (part * all) * sum + (2.0 * part * (with_p + p.value)) * p.at + (2.0 * part * (with_q + q.value)) * q.at +
             (2.0 * part * (with_r + r.value)) * r.at;
  }

  // Times a share that grows linearly: by the rule of six places that is exact to the fourth degree (Dunavant 1985).
  void add_faded(double area, const Vec3 &p, const Vec3 &q, const Vec3 &r, const OverlapSolid &solid,
                 const OverlapSolid::Plane &fades, double &whole, Vec3 &places) const {
    constexpr struct {
      double weight, near;
    } rule[2] = {{0.223381589678011, 0.445948490915965}, {0.109951743655322, 0.091576213509771}};
    const Vec3 sum = p + q + r;
    for (const auto &node : rule) {
      for (const Vec3 *apart : {&p, &q, &r}) {
        const Vec3 at = node.near * (sum - *apart) + (1.0 - 2.0 * node.near) * *apart;
        const double part = node.weight * area * solid.share(fades, at + solid.middle()) * corner(at).value;
        whole += part;
        places = places + part * at;
      }
    }
  }

  const Quadric q_;
  Vec3 force_, torque_;
};

}  // namespace

// In the body's frame, where its planes stand still.
void OverlapEnergy::weigh(const OverlapSolid &solid, const ContactPolytope &body, const Pose &in_axes, Depth &depth) {
  constexpr std::size_t size = FaceClusters::size;
  // Faces with a greater mean square, by the least, change the energy by less than 1e-14 of it.
  constexpr double farthest = 100.0;
  const FaceClusters &clusters = body.clusters();
  const std::size_t count = clusters.count();
  if (bounds_.size() < count) {
    for (std::vector<double> *const room : {&below_, &mean_square_, &part_}) room->resize(size * count + 1);
    bounds_.resize(count);
    groups_.resize(count);
    near_.resize(size * count + 1);
  }
  const Vec3 middle = transposed_times(in_axes.rotation, solid.middle() - in_axes.translation);
  const SymmetricMatrix spread = turned(transposed(in_axes.rotation), solid.spread());
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
      if (g != first && !(bounds[g] > 0.0 && bounds[g] * bounds[g] > farthest * least)) look_at(size * g);
    }
  }
  std::size_t *const near = near_.data();
  std::size_t near_count = 0;
  const double limit = farthest * least;
  for (std::size_t k = 0; k < looked_at; ++k) {
    const std::size_t begin = groups_[k];
    for (std::size_t f = begin; f < begin + width; ++f) {  // which count is unpredictable: no branch
      near[near_count] = f;
      near_count += mean_square[f] <= limit ? 1 : 0;
    }
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
  double constant = 0.0;
  SymmetricMatrix squares;
  Vec3 linear;
  for (std::size_t k = 0; k < near_count; ++k) {
    const std::size_t f = near[k];
    const double square = part[k] * part[k], fourth = square * square;
    const double weight = fourth * fourth * (8.0 * mean * part[k] - 7.0) * inverse_sum;
    const Vec3 n{x[f], y[f], z[f]}, scaled = weight * n;
    squares.m[0] += scaled.x * n.x, squares.m[1] += scaled.y * n.y, squares.m[2] += scaled.z * n.z;
    squares.m[3] += scaled.y * n.z, squares.m[4] += scaled.z * n.x, squares.m[5] += scaled.x * n.y;
    linear = linear + below[f] * scaled;
    constant += weight * below[f] * below[f];
  }
  depth.least = least * mean;
  depth.squares = {turned(in_axes.rotation, squares), in_axes.rotation * linear, constant};
  depth.moment = 2.0 * (in_axes.rotation * sum_of_crosses(spread, squares));
}

// The means over the overlap O of B's squares q_B have the gradient, by A's motion v, of the integral of (q_B - mean) n.v / |O| over A's
// surface in B; those of A's squares change as if B moved by -v. Both are sums over one of the two surfaces, as an integral over all of
// the overlap's surface is one over its inside.
void OverlapEnergy::find(const OverlapSolid &solid, const ContactPolytope &a, const Pose &a_in_axes, const ContactPolytope &b,
                         const Pose &b_in_axes) {
  Depth of_a, of_b;
  weigh(solid, a, a_in_axes, of_a);
  weigh(solid, b, b_in_axes, of_b);
  energy_ = 0.75 * (of_a.least + of_b.least);
  Quadric both = of_a.squares;
  both.squares.add(1.0, of_b.squares.squares);
  both.linear = both.linear + of_b.squares.linear;
  both.constant += of_b.squares.constant - of_a.least - of_b.least;
  const bool over_b = solid.fades() || solid.pieces_b().size() <= solid.pieces_a().size();
  SurfaceIntegral surface(both);
  for (const OverlapSolid::Piece &piece : over_b ? solid.pieces_b() : solid.pieces_a()) {
    if (piece.carries) surface.add(solid, piece);
  }
  const double sense = over_b ? 0.75 : -0.75, part = sense / solid.volume();
  const Depth &inside = over_b ? of_b : of_a;
  force_ = part * surface.force() + (2.0 * sense) * inside.squares.linear;
  torque_ = part * surface.torque() - sense * inside.moment;
}

}  // namespace cmb
