#include "scene/registry.hpp"

#include <array>
#include <atomic>
#include <cstring>
#include <memory>
#include <mutex>
#include <new>
#include <unordered_map>
#include <utility>

#include "scene/descriptor.hpp"

namespace cmb {

namespace {

struct Registry {
  std::mutex mutex;
  std::unordered_map<std::string, cmb_scene> handles;                  // guarded by the mutex
  std::array<std::unique_ptr<const Scene>, scene_limit> owned;         // guarded by the mutex
  std::array<std::atomic<const Scene *>, scene_limit> published{};     // written under the mutex, read by all
};

Registry &registry() {
  static Registry instance;
  return instance;
}

std::string scene_key(const char *const *geometry, std::size_t body_count, const int *pairs, std::size_t pair_count,
                      cmb_backend backend) {
  std::string key = std::to_string(static_cast<int>(backend));
  for (std::size_t i = 0; i < body_count; ++i) {
    key += ' ';
    key += std::to_string(std::strlen(geometry[i]));
    key += ':';
    key += geometry[i];
  }
  for (std::size_t i = 0; i < 2 * pair_count; ++i) {
    key += i == 0 ? '|' : ' ';
    key += std::to_string(pairs[i]);
  }
  return key;
}

std::unique_ptr<Scene> make_scene(const char *const *geometry, std::size_t body_count, const int *pairs,
                                  std::size_t pair_count, cmb_backend backend) {
  auto scene = std::make_unique<Scene>();
  scene->backend = backend;
  scene->pairs.reserve(pair_count);
  for (std::size_t i = 0; i < pair_count; ++i) {
    const int first = pairs[2 * i], second = pairs[2 * i + 1];
    for (const int body : {first, second}) {
      if (body < 1 || static_cast<std::size_t>(body) > body_count) {
        throw SceneError(CMB_ERROR_ARGUMENT, "pair " + std::to_string(i + 1) + " names body " + std::to_string(body) +
                                                 "; bodies are numbered from 1 to " + std::to_string(body_count));
      }
    }
    if (first == second) {
      throw SceneError(CMB_ERROR_ARGUMENT, "pair " + std::to_string(i + 1) + " names body " + std::to_string(first) +
                                               " twice; name two different bodies");
    }
    scene->pairs.push_back({static_cast<std::size_t>(first - 1), static_cast<std::size_t>(second - 1)});
  }
  scene->bodies.reserve(body_count);
  for (std::size_t i = 0; i < body_count; ++i) {
    try {
      scene->bodies.push_back(parse_descriptor(geometry[i]));
    } catch (const DescriptorError &error) {
      throw SceneError(CMB_ERROR_DESCRIPTOR, "descriptor " + std::to_string(i + 1) + ", column " +
                                                 std::to_string(error.column()) + ": " + error.what());
    }
  }
  return scene;
}

}  // namespace

cmb_scene intern_scene(const char *const *geometry, std::size_t body_count, const int *pairs, std::size_t pair_count,
                       cmb_backend backend) {
  Registry &all = registry();
  std::string key = scene_key(geometry, body_count, pairs, pair_count, backend);
  const std::lock_guard<std::mutex> lock(all.mutex);
  const auto known = all.handles.find(key);
  if (known != all.handles.end()) return known->second;
  const std::size_t slot = all.handles.size();
  if (slot >= scene_limit) {
    throw SceneError(CMB_ERROR_MEMORY, "there are " + std::to_string(scene_limit) +
                                           " scenes already; intern a scene once, not at every step");
  }
  std::unique_ptr<const Scene> scene = make_scene(geometry, body_count, pairs, pair_count, backend);
  const cmb_scene handle = static_cast<cmb_scene>(slot + 1);
  all.handles.emplace(std::move(key), handle);
  all.owned[slot] = std::move(scene);
  all.published[slot].store(all.owned[slot].get(), std::memory_order_release);
  return handle;
}

const Scene *find_scene(cmb_scene handle) {
  if (handle < 1 || static_cast<std::size_t>(handle) > scene_limit) return nullptr;
  return registry().published[static_cast<std::size_t>(handle - 1)].load(std::memory_order_acquire);
}

}  // namespace cmb
