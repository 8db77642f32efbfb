#include "scene/geometry_cache.hpp"

#include <mutex>
#include <unordered_map>

#include "scene/descriptor.hpp"

namespace cmb {

namespace {

// Never destroyed: scenes may be released while the process ends.
struct Cache {
  std::mutex mutex;
  std::unordered_map<std::string, std::weak_ptr<const BodyShapes>> shapes;
};

Cache &cache() {
  static Cache *const instance = new Cache;
  return *instance;
}

std::shared_ptr<const BodyShapes> known_geometry(const std::string &descriptor) {
  const std::lock_guard<std::mutex> lock(cache().mutex);
  const auto found = cache().shapes.find(descriptor);
  return found == cache().shapes.end() ? nullptr : found->second.lock();
}

// Forgets an entry whose shapes are gone; another thread may have made them anew meanwhile.
void forget(const std::string &descriptor) {
  const std::lock_guard<std::mutex> lock(cache().mutex);
  const auto found = cache().shapes.find(descriptor);
  if (found != cache().shapes.end() && found->second.expired()) cache().shapes.erase(found);
}

// Shapes that take their entry along when the last scene lets them go.
std::shared_ptr<const BodyShapes> remember(const std::string &descriptor, BodyShapes shapes) {
  auto own = std::make_unique<const BodyShapes>(std::move(shapes));
  const auto dispose = [descriptor](const BodyShapes *gone) {
    delete gone;
    forget(descriptor);
  };
  std::shared_ptr<const BodyShapes> shared(own.release(), dispose);
  const std::lock_guard<std::mutex> lock(cache().mutex);
  cache().shapes[descriptor] = shared;
  return shared;
}

}  // namespace

std::shared_ptr<const BodyShapes> shared_geometry(const char *descriptor, GeometryFiles &files) {
  const std::string text(descriptor);
  if (text.find("file=") != std::string::npos) {
    return std::make_shared<const BodyShapes>(parse_descriptor(text, files));
  }
  if (std::shared_ptr<const BodyShapes> known = known_geometry(text)) return known;
  return remember(text, parse_descriptor(text, files));
}

}  // namespace cmb
