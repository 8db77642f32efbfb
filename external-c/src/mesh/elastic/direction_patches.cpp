#include "mesh/elastic/direction_patches.hpp"

namespace cmb::mesh {

// Integrals of products of two and three of a triangle's barycentric coordinates are area/12 and area/60, twice that where two are
// equal, six times where three are.
void PatchSums::add_triangle(double size, const Vec3 &p, double dp, const Vec3 &q, double dq, const Vec3 &r, double dr) {
  const double depths = dp + dq + dr;
  area += size;
  load += size * depths / 3.0;
  energy += size * (depths * depths + dp * dp + dq * dq + dr * dr) / 12.0;
  const Vec3 sum = p + q + r, weighted = dp * p + dq * q + dr * r;
  moment = moment + (size / 12.0) * (depths * sum + weighted);
  const double part = size / 60.0;
  const auto product = [&](int i, int j) {
    const double squares = p[i] * p[j] + q[i] * q[j] + r[i] * r[j];
    const double cubes = dp * p[i] * p[j] + dq * q[i] * q[j] + dr * r[i] * r[j];
    return part * (depths * (sum[i] * sum[j] + squares) + weighted[i] * sum[j] + sum[i] * weighted[j] + 2.0 * cubes);
  };
  second[0] += product(0, 0), second[1] += product(1, 1), second[2] += product(2, 2);
  second[3] += product(1, 2), second[4] += product(2, 0), second[5] += product(0, 1);
}

PatchSums LanePatchSums::sums() const {
  PatchSums result;
  result.area = convex::sum_of(area_), result.load = convex::sum_of(load_), result.energy = convex::sum_of(energy_);
  result.moment = convex::sum_of(moment_);
  for (int k = 0; k < 6; ++k) result.second[k] = convex::sum_of(second_[k]);
  return result;
}

void PatchSums::scale(double part) {
  load *= part, energy *= part;
  moment = part * moment;
  for (double &sum : second) sum *= part;
}

void PatchSums::add(double part, const PatchSums &other) {
  area += part * other.area, load += part * other.load, energy += part * other.energy;
  moment = moment + part * other.moment;
  for (int k = 0; k < 6; ++k) second[k] += part * other.second[k];
}

void PatchSums::keep_within(const Vec3 &center, double radius) {
  const Vec3 first = moment - load * center;
  const double squares = second[0] + second[1] + second[2] - dot(center, first + moment);  // of distances from the center
  const double most_first = load * radius, most_squares = most_first * radius;
  double part = 1.0;
  if (norm(first) > most_first) part = most_first / norm(first);
  if (std::fabs(squares) * part > most_squares) part = most_squares / std::fabs(squares);
  if (!(part < 1.0)) return;
  const double rest = (1.0 - part) * load;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    second[i] = part * second[i] + rest * center[i] * center[i];
    second[3 + i] = part * second[3 + i] + rest * center[j] * center[k];
  }
  moment = load * center + part * first;
}

void DirectionPatches::add(double part, const PatchSums &patch, const Vec3 &normal) {
  if (!(patch.load > 0.0) || !(part > 0.0)) return;
  for (int axis = 0; axis < 3; ++axis) {
    const double component = normal[axis], share = part * component * component;
    if (!(share > 0.0)) continue;
    Sum &sum = sums_[2 * axis + (component > 0.0 ? 1 : 0)];
    sum.patch.add(share, patch);
    sum.force = sum.force + (share * patch.load) * normal;
  }
}

void DirectionPatches::add(double part, const DirectionPatches &patches) {
  for (std::size_t direction = 0; direction < directions; ++direction) {
    sums_[direction].patch.add(part, patches.sums_[direction].patch);
    sums_[direction].force = sums_[direction].force + part * patches.sums_[direction].force;
  }
}

namespace {

// The columns of a triangular factor of the matrix (xx, yy, zz, yz, zx, xy), axes in the order that begins after `last`. Squares
// count above `rounding`; where cancelling loads leave no squares, columns are no longer than those of a matrix that is one.
Mat3 factor(const double (&m)[6], int last, double rounding) {
  const auto root = [rounding](double square) { return std::sqrt(std::fmax(0.0, square - rounding)); };
  const auto bounded = [](double value, double most) { return value > most ? most : value < -most ? -most : value; };
  const int i = (last + 1) % 3, j = (last + 2) % 3, k = last;
  const auto cross_term = [&](int a, int b) { return m[6 - a - b]; };  // yz = 3, zx = 4, xy = 5
  Vec3 columns[3];
  const double first = root(m[i]);
  if (first > 0.0) {
    columns[0].set(i, first);
    columns[0].set(j, bounded(cross_term(i, j) / first, root(m[j])));
    columns[0].set(k, bounded(cross_term(i, k) / first, root(m[k])));
  }
  const double second = root(m[j] - columns[0][j] * columns[0][j]);
  if (second > 0.0) {
    columns[1].set(j, second);
    columns[1].set(k, bounded((cross_term(j, k) - columns[0][j] * columns[0][k]) / second, root(m[k] - columns[0][k] * columns[0][k])));
  }
  columns[2].set(k, root(m[k] - columns[0][k] * columns[0][k] - columns[1][k] * columns[1][k]));
  return {{columns[0], columns[1], columns[2]}};
}

}  // namespace

void DirectionPatches::append(std::vector<LoadPoint> &points) const {
  // Next to the others a load that is rounding has no place.
  constexpr double rounding_load = 1e-13;
  double load = 0.0;
  for (const Sum &sum : sums_) load += sum.patch.load;
  for (std::size_t direction = 0; direction < directions; ++direction) {
    const Sum &sum = sums_[direction];
    if (!(sum.patch.load > rounding_load * load)) continue;
    const double part = 1.0 / sum.patch.load, depth = part * sum.patch.energy;
    const Vec3 force = sum.force, middle = part * sum.patch.moment;
    if (!(norm2(force) > 0.0) || !(depth > 0.0) || !std::isfinite(part)) continue;
    double spread[6];
    for (int k = 0; k < 3; ++k) {
      spread[k] = part * sum.patch.second[k] - middle[k] * middle[k];
      spread[3 + k] = part * sum.patch.second[3 + k] - middle[(k + 1) % 3] * middle[(k + 2) % 3];
    }
    const double rounding = 1e-14 * (norm2(middle) + spread[0] + spread[1] + spread[2]);
    const Mat3 columns = factor(spread, static_cast<int>(direction / 2), rounding);
    const Vec3 surface = middle + (0.5 * depth / norm(force)) * force;
    for (const double(&corner)[3] : convex::tetrahedron_corners) {
      points.push_back({(1.0 / points_each) * force,
                        surface + corner[0] * columns.row[0] + corner[1] * columns.row[1] + corner[2] * columns.row[2], depth});
    }
  }
}

}  // namespace cmb::mesh
