#include "query/query_memory.hpp"

#include <algorithm>
#include <cstring>

namespace cmb {

namespace {

constexpr std::size_t numbers_of_position = 3, numbers_of_rotation = 9;  // of a body

bool same_numbers(const double *a, const double *b, std::size_t count) { return std::memcmp(a, b, count * sizeof *a) == 0; }

void copy_numbers(const std::vector<double> &from, std::size_t first, std::size_t count, double *to) {
  std::memcpy(to, from.data() + first, count * sizeof *to);
}

}  // namespace

void QueryMemory::begin(const Scene &scene, const cmb_poses &poses, double exact_within, std::size_t point_capacity) {
  scene_ = &scene;
  recalled_ = 0;
  const std::size_t bodies = scene.bodies.size();
  if (scene_number_ != scene.number || exact_within_ != exact_within || point_capacity_ != point_capacity) {
    scene_number_ = 0;
    exact_within_ = exact_within;
    point_capacity_ = point_capacity;
    stands_.assign(bodies, 0);
    return;
  }
  for (std::size_t body = 0; body < bodies; ++body) {
    stands_[body] =
        same_numbers(position_.data() + numbers_of_position * body, poses.position + numbers_of_position * body, numbers_of_position) &&
        same_numbers(rotation_.data() + numbers_of_rotation * body, poses.rotation + numbers_of_rotation * body, numbers_of_rotation);
  }
}

bool QueryMemory::recall(std::size_t pair, const cmb_contact_points &points) {
  const Scene::Pair &bodies = scene_->pairs[pair];
  if (stands_[bodies.first] == 0 || stands_[bodies.second] == 0) return false;
  const std::size_t slot = pair * point_capacity_;
  points.distance[pair] = distance_[pair];
  copy_numbers(depth_, slot, point_capacity_, points.depth + slot);
  copy_numbers(weight_, slot, point_capacity_, points.weight + slot);
  copy_numbers(normal_, 3 * slot, 3 * point_capacity_, points.normal + 3 * slot);
  copy_numbers(point_, 3 * slot, 3 * point_capacity_, points.point + 3 * slot);
  ++recalled_;
  return true;
}

void QueryMemory::end(const cmb_poses &poses, const cmb_contact_points &points) {
  const std::size_t pairs = scene_->pairs.size(), slots = pairs * point_capacity_;
  if (pairs == 0 || 2 * recalled_ >= pairs) return;
  scene_number_ = 0;  // should there be no room for the rest
  position_.assign(poses.position, poses.position + numbers_of_position * poses.body_count);
  rotation_.assign(poses.rotation, poses.rotation + numbers_of_rotation * poses.body_count);
  distance_.assign(points.distance, points.distance + pairs);
  depth_.assign(points.depth, points.depth + slots);
  weight_.assign(points.weight, points.weight + slots);
  normal_.assign(points.normal, points.normal + 3 * slots);
  point_.assign(points.point, points.point + 3 * slots);
  scene_number_ = scene_->number;
}

}  // namespace cmb
