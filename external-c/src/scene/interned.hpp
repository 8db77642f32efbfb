// Values that are interned: equal keys give one handle, and values never change. A value lives until it is released as
// often as it was interned.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace cmb {

// Handles are positive; at most `limit` values at a time. Thread safe; find does not lock, and what it gives stays while
// nobody releases it.
template <typename Value, std::size_t limit>
class Interned {
 public:
  // The handle of `key`. Where it is new, make() gives the value (std::shared_ptr<const Value>); 0 where all handles
  // are taken. What make throws leaves everything as it was.
  template <typename Make>
  int intern(std::string key, Make &&make) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const auto known = entries_.find(key);
    if (known != entries_.end()) {
      ++known->second->users;
      return known->second->handle;
    }
    const bool reused = !free_.empty();
    if (!reused && used_ >= limit) return 0;
    auto entry = std::make_unique<Entry>();
    entry->value = make();
    entry->handle = reused ? free_.back() : static_cast<int>(used_ + 1);
    const Entry *const kept = entry.get();
    const auto place = entries_.emplace(std::move(key), std::move(entry)).first;
    place->second->key = &place->first;
    if (reused) {
      free_.pop_back();
    } else {
      ++used_;
    }
    published_[slot_of(kept->handle)].store(kept, std::memory_order_release);
    return kept->handle;
  }

  // Takes one intern back; false where there is no such value.
  bool release(int handle) {
    const std::lock_guard<std::mutex> lock(mutex_);
    const Entry *const entry = entry_of(handle);
    if (entry == nullptr) return false;
    const auto place = entries_.find(*entry->key);
    if (--place->second->users > 0) return true;
    free_.reserve(free_.size() + 1);  // so that nothing below can throw
    published_[slot_of(handle)].store(nullptr, std::memory_order_release);
    free_.push_back(next_of(handle));
    entries_.erase(place);
    return true;
  }

  // The value of a handle, null where there is none.
  const Value *find(int handle) const {
    const Entry *const entry = entry_of(handle);
    return entry == nullptr ? nullptr : entry->value.get();
  }

  // The same, to be kept beyond its release.
  std::shared_ptr<const Value> share(int handle) const {
    const Entry *const entry = entry_of(handle);
    return entry == nullptr ? nullptr : entry->value;
  }

 private:
  struct Entry {
    std::shared_ptr<const Value> value;
    const std::string *key = nullptr;  // in entries_
    int handle = 0;
    std::size_t users = 1;  // guarded by the mutex
  };

  static std::size_t slot_of(int handle) { return static_cast<std::size_t>(handle - 1) % limit; }
  // A slot's handles differ by `limit`, so that those of released values are told from their successors'.
  static int next_of(int handle) {
    constexpr int step = static_cast<int>(limit);
    return handle > std::numeric_limits<int>::max() - step ? static_cast<int>(slot_of(handle) + 1) : handle + step;
  }
  const Entry *entry_of(int handle) const {
    if (handle < 1) return nullptr;
    const Entry *const entry = published_[slot_of(handle)].load(std::memory_order_acquire);
    return entry != nullptr && entry->handle == handle ? entry : nullptr;
  }

  std::mutex mutex_;
  std::unordered_map<std::string, std::unique_ptr<Entry>> entries_;  // guarded by the mutex
  std::vector<int> free_;                                            // guarded: handles for slots that were released
  std::size_t used_ = 0;                                             // guarded: slots that were ever taken
  std::array<std::atomic<const Entry *>, limit> published_{};        // written under the mutex, read by all
};

}  // namespace cmb
