#include "volume/face_columns.hpp"

#include <algorithm>
#include <cmath>

#include "math/index.hpp"

namespace cmb::overlap {

namespace {

// Cells of a grid over the columns.
struct Grid {
  double low[2], per_length[2];
  std::int64_t count[2];

  Grid(const Columns &columns, std::size_t faces) {
    const double width[2] = {columns.x[1] - columns.x[0], columns.y[1] - columns.y[0]};
    low[0] = columns.x[0], low[1] = columns.y[0];
    const double side = std::sqrt(width[0] * width[1] / static_cast<double>(faces + 1));
    for (int k = 0; k < 2; ++k) {
      count[k] = std::clamp<std::int64_t>(side > 0.0 ? static_cast<std::int64_t>(width[k] / side) : 1, 1, 1024);
      per_length[k] = static_cast<double>(count[k]) / width[k];
    }
  }
  std::int64_t cell(int k, double place) const {
    const double at = (place - low[k]) * per_length[k];
    return at > 0.0 ? std::min(count[k] - 1, static_cast<std::int64_t>(std::min(at, 1e9))) : 0;
  }
  std::size_t number(std::int64_t i, std::int64_t j) const { return static_cast<std::size_t>(j * count[0] + i); }
};

}  // namespace

double FaceSet::Face::height(const Vec3 &p) const { return std::clamp(z0 + zx * p.x + zy * p.y, z[0], z[1]); }

void FaceSet::add(const Vec3 *corner, std::int32_t count, const Columns &columns) {
  Face face{static_cast<std::int32_t>(corners_.size()), count, 1.0, 0, 0, 0, {1e300, -1e300}, {1e300, -1e300}, {1e300, -1e300}};
  Vec3 area, middle;
  for (std::int32_t k = 0; k < count; ++k) {
    const Vec3 &p = corner[k];
    face.x[0] = std::min(face.x[0], p.x), face.x[1] = std::max(face.x[1], p.x);
    face.y[0] = std::min(face.y[0], p.y), face.y[1] = std::max(face.y[1], p.y);
    face.z[0] = std::min(face.z[0], p.z), face.z[1] = std::max(face.z[1], p.z);
    if (k >= 2) area = area + cross(corner[k - 1] - corner[0], p - corner[0]);
    middle = middle + (1.0 / count) * p;
  }
  if (area.z == 0.0 || face.z[1] <= columns.low || face.x[1] <= columns.x[0] || face.x[0] >= columns.x[1] ||
      face.y[1] <= columns.y[0] || face.y[0] >= columns.y[1]) {
    return;
  }
  face.sign = area.z > 0.0 ? 1.0 : -1.0;
  face.zx = -area.x / area.z, face.zy = -area.y / area.z;
  face.z0 = middle.z - face.zx * middle.x - face.zy * middle.y;
  corners_.insert(corners_.end(), corner, corner + count);
  if (face.sign < 0.0) std::reverse(corners_.end() - count, corners_.end());
  faces_.push_back(face);
}

template <typename Height>
void FaceColumns::keep(Height &&height) {
  next_.clear();
  if (polygon_.empty()) return;
  const Vec3 *from = &polygon_.back();
  double before = height(*from);
  for (const Vec3 &to : polygon_) {
    const double after = height(to);
    if ((before < 0.0 && after > 0.0) || (before > 0.0 && after < 0.0)) {
      next_.push_back(*from + (before / (before - after)) * (to - *from));
    }
    if (after <= 0.0) next_.push_back(to);
    from = &to, before = after;
  }
  polygon_.swap(next_);
}

// Adds what lies below `top` and polygon_, where `other` lies above.
void FaceColumns::add_below(const FaceSet::Face &top, const FaceSet::Face &other) {
  if (top.z[0] < low_) keep([&](const Vec3 &p) { return low_ - top.height(p); });
  if (polygon_.size() < 3) return;
  const double factor = top.sign * other.sign;
  SideSums &side = top.sign > 0.0 ? sums_.upper : sums_.lower;
  // Sums of products over a triangle by those over its corners.
  const Vec3 &p = polygon_[0];
  const double zp = top.height(p);
  for (std::size_t k = 1; k + 1 < polygon_.size(); ++k) {
    const Vec3 &q = polygon_[k], &r = polygon_[k + 1];
    const double zq = top.height(q), zr = top.height(r);
    const double area = 0.5 * ((q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x));
    const double x = p.x + q.x + r.x, y = p.y + q.y + r.y, z = zp + zq + zr;
    const auto product = [&](double ap, double aq, double ar, double bp, double bq, double br) {
      return area / 12.0 * (ap * bp + aq * bq + ar * br + (ap + aq + ar) * (bp + bq + br));
    };
    const double height = area * (z / 3.0 - low_);
    sums_.volume += factor * height;
    sums_.x += factor * (product(p.x, q.x, r.x, zp, zq, zr) - low_ * area * x / 3.0);
    sums_.y += factor * (product(p.y, q.y, r.y, zp, zq, zr) - low_ * area * y / 3.0);
    sums_.z += factor * 0.5 * (product(zp, zq, zr, zp, zq, zr) - low_ * low_ * area);
    const SideSums part{area,
                        area * x / 3.0,
                        area * y / 3.0,
                        product(p.x, q.x, r.x, p.x, q.x, r.x),
                        product(p.x, q.x, r.x, p.y, q.y, r.y),
                        product(p.y, q.y, r.y, p.y, q.y, r.y),
                        area * z / 3.0};
    side.add(part, other.sign);
  }
}

void FaceColumns::add_pair(const FaceSet &a, const FaceSet::Face &face_a, const FaceSet &b, const FaceSet::Face &face_b) {
  polygon_.assign(a.corners().begin() + face_a.first, a.corners().begin() + face_a.first + face_a.count);
  for (std::int32_t k = 0; k < face_b.count && polygon_.size() >= 3; ++k) {
    const Vec3 &from = b.corners()[index(face_b.first + k)], &to = b.corners()[index(face_b.first + (k + 1) % face_b.count)];
    const double dx = to.x - from.x, dy = to.y - from.y;
    keep([&](const Vec3 &p) { return dy * (p.x - from.x) - dx * (p.y - from.y); });
  }
  if (polygon_.size() < 3) return;
  if (face_a.z[1] <= face_b.z[0]) return add_below(face_a, face_b);
  if (face_b.z[1] <= face_a.z[0]) return add_below(face_b, face_a);
  both_.assign(polygon_.begin(), polygon_.end());
  const auto difference = [&](const Vec3 &p) { return face_a.height(p) - face_b.height(p); };
  keep(difference);
  if (polygon_.size() >= 3) add_below(face_a, face_b);
  polygon_.assign(both_.begin(), both_.end());
  keep([&](const Vec3 &p) { return -difference(p); });
  if (polygon_.size() >= 3) add_below(face_b, face_a);
}

SolidSums FaceColumns::common_part(const FaceSet &a, const FaceSet &b, const Columns &columns) {
  low_ = columns.low;
  sums_ = {};
  // B's faces by the cells they reach; a pair belongs to the cell where both begin.
  const Grid grid(columns, b.faces().size());
  const auto visit_cells = [&](const FaceSet::Face &face, auto &&visit) {
    for (std::int64_t j = grid.cell(1, face.y[0]); j <= grid.cell(1, face.y[1]); ++j) {
      for (std::int64_t i = grid.cell(0, face.x[0]); i <= grid.cell(0, face.x[1]); ++i) visit(i, j);
    }
  };
  cell_begin_.assign(static_cast<std::size_t>(grid.count[0] * grid.count[1]) + 1, 0);
  for (const auto &face : b.faces()) {
    visit_cells(face, [&](std::int64_t i, std::int64_t j) { ++cell_begin_[grid.number(i, j) + 1]; });
  }
  for (std::size_t k = 1; k < cell_begin_.size(); ++k) cell_begin_[k] += cell_begin_[k - 1];
  cell_faces_.resize(cell_begin_.back());
  for (std::size_t f = b.faces().size(); f-- > 0;) {
    // Filled from each cell's end: its begin moves to where the cell before it ended.
    visit_cells(b.faces()[f], [&](std::int64_t i, std::int64_t j) {
      cell_faces_[--cell_begin_[grid.number(i, j) + 1]] = static_cast<std::uint32_t>(f);
    });
  }
  for (const auto &face_a : a.faces()) {
    visit_cells(face_a, [&](std::int64_t i, std::int64_t j) {
      const std::size_t cell = grid.number(i, j);
      const std::size_t end = cell + 2 < cell_begin_.size() ? cell_begin_[cell + 2] : cell_faces_.size();
      for (std::size_t k = cell_begin_[cell + 1]; k < end; ++k) {
        const auto &face_b = b.faces()[cell_faces_[k]];
        if (face_a.x[1] <= face_b.x[0] || face_b.x[1] <= face_a.x[0] || face_a.y[1] <= face_b.y[0] ||
            face_b.y[1] <= face_a.y[0]) {
          continue;
        }
        if (grid.cell(0, std::max(face_a.x[0], face_b.x[0])) != i || grid.cell(1, std::max(face_a.y[0], face_b.y[0])) != j) {
          continue;
        }
        add_pair(a, face_a, b, face_b);
      }
    });
  }
  return sums_;
}

}  // namespace cmb::overlap
