// Values that are interned: equal keys give one handle, and values are never changed or freed.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>

namespace cmb {

// Handles are 1, 2, ... `limit`. Thread safe; find does not lock.
template <typename Value, std::size_t limit>
class Interned {
 public:
  // The handle of `key`. Where it is new, make() gives the value (std::unique_ptr<const Value>); 0 where all handles
  // are taken. What make throws leaves everything as it was.
  template <typename Make>
  int intern(std::string key, Make &&make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = handles_.find(key);
    if (known != handles_.end()) return known->second;
    const std::size_t slot = handles_.size();
    if (slot >= limit) return 0;
    std::unique_ptr<const Value> value = make();
    const int handle = static_cast<int>(slot + 1);
    handles_.emplace(std::move(key), handle);
    owned_[slot] = std::move(value);
    published_[slot].store(owned_[slot].get(), std::memory_order_release);
    return handle;
  }

  // The value of a handle, null where there is none.
  const Value *find(int handle) const {
    if (handle < 1 || static_cast<std::size_t>(handle) > limit) return nullptr;
    return published_[static_cast<std::size_t>(handle - 1)].load(std::memory_order_acquire);
  }

 private:
  std::mutex mutex_;
  std::unordered_map<std::string, int> handles_;             // guarded by the mutex
  std::array<std::unique_ptr<const Value>, limit> owned_;    // guarded by the mutex
  std::array<std::atomic<const Value *>, limit> published_{};  // written under the mutex, read by all
};

}  // namespace cmb
