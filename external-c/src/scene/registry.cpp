#include "scene/registry.hpp"

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <string_view>
#include <vector>

#include "scene/body_bounds.hpp"
#include "scene/descriptor.hpp"
#include "scene/geometry_cache.hpp"
#include "scene/interned.hpp"
#include "scene/mesh_hull.hpp"
#include "scene/thickness.hpp"

namespace cmb {

namespace {

Interned<Scene, CMB_SCENE_LIMIT> &registry() {
  static Interned<Scene, CMB_SCENE_LIMIT> instance;
  return instance;
}

std::string folder_of(const cmb_scene_source &source) { return source.folder == nullptr ? "" : source.folder; }

std::string scene_key(const cmb_scene_source &source) {
  const std::string folder = folder_of(source);
  std::string key = std::to_string(static_cast<int>(source.backend)) + ' ' + std::to_string(folder.size()) + ':' + folder;
  for (std::size_t i = 0; i < source.body_count; ++i) {
    key += ' ';
    key += std::to_string(std::strlen(source.geometry[i]));
    key += ':';
    key += source.geometry[i];
  }
  for (std::size_t i = 0; i < 2 * source.pair_count; ++i) {
    key += i == 0 ? '|' : ' ';
    key += std::to_string(source.pairs[i]);
  }
  return key;
}

// Half-spaces touch meshes by their hulls; without half-spaces none is needed.
void attach_mesh_hulls(std::vector<BodyShapes> &bodies) {
  const auto is_halfspace = [](const Shape &shape) { return shape.kind == ShapeKind::halfspace; };
  const bool needed = std::any_of(bodies.begin(), bodies.end(), [&](const BodyShapes &shapes) {
    return std::any_of(shapes.begin(), shapes.end(), is_halfspace);
  });
  if (!needed) return;
  std::map<const mesh::TriangleMesh *, std::shared_ptr<const ContactPolytope>> hulls;
  for (BodyShapes &shapes : bodies) {
    for (Shape &shape : shapes) {
      if (shape.kind != ShapeKind::mesh) continue;
      const auto [entry, added] = hulls.try_emplace(shape.mesh.get());
      if (added) entry->second = make_mesh_hull(*shape.mesh);
      shape.mesh_hull = entry->second;
    }
  }
}

std::shared_ptr<Scene> make_scene(const cmb_scene_source &source, const DistanceLibrary *library) {
  const std::size_t body_count = source.body_count;
  auto scene = std::make_shared<Scene>();
  scene->pairs.reserve(source.pair_count);
  for (std::size_t i = 0; i < source.pair_count; ++i) {
    const int first = source.pairs[2 * i], second = source.pairs[2 * i + 1];
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
  GeometryFiles files(folder_of(source));
  scene->bodies.reserve(body_count);
  scene->thickness.reserve(body_count);
  scene->bounds.reserve(body_count);
  // Bodies of one descriptor share their geometry: it is made once, and stays nearer to the processor.
  std::map<std::string_view, std::size_t> first_of;
  for (std::size_t i = 0; i < body_count; ++i) {
    const auto [known, added] = first_of.try_emplace(source.geometry[i], i);
    if (!added) {
      scene->bodies.push_back(scene->bodies[known->second]);
      scene->thickness.push_back(scene->thickness[known->second]);
      scene->bounds.push_back(scene->bounds[known->second]);
      continue;
    }
    try {
      scene->geometry.push_back(shared_geometry(source.geometry[i], files));
      scene->bodies.push_back(*scene->geometry.back());
      scene->thickness.push_back(thickness_of(scene->bodies.back()));
      scene->bounds.push_back(bounds_of(scene->bodies.back()));
    } catch (const DescriptorError &error) {
      throw SceneError(CMB_ERROR_DESCRIPTOR, "descriptor " + std::to_string(i + 1) + ", column " +
                                                 std::to_string(error.column()) + ": " + error.what());
    }
  }
  attach_mesh_hulls(scene->bodies);
  attach_library(*scene, source.backend, library);
  return scene;
}

}  // namespace

void attach_library(Scene &scene, cmb_backend backend, const DistanceLibrary *library) {
  scene.backend = backend;
  scene.library = library;
  for (BodyShapes &shapes : scene.bodies) {
    for (Shape &shape : shapes) {
      const bool convex = shape.kind != ShapeKind::halfspace && shape.kind != ShapeKind::mesh;
      const bool kept = convex && library != nullptr && library->make_shape != nullptr;
      shape.in_library.reset(kept ? library->make_shape(shape) : nullptr);
    }
  }
}

cmb_scene intern_scene(const cmb_scene_source &source, const DistanceLibrary *library) {
  const int handle = registry().intern(
      scene_key(source), [&]() -> std::shared_ptr<const Scene> { return make_scene(source, library); });
  if (handle == 0) {
    throw SceneError(CMB_ERROR_MEMORY, "there are " + std::to_string(CMB_SCENE_LIMIT) +
                                           " scenes already; intern a scene once, not at every step, or release those "
                                           "that are done with");
  }
  return {handle};
}

bool release_scene(cmb_scene handle) { return registry().release(handle.number); }

const Scene *find_scene(cmb_scene handle) { return registry().find(handle.number); }

std::shared_ptr<const Scene> share_scene(cmb_scene handle) { return registry().share(handle.number); }

}  // namespace cmb
