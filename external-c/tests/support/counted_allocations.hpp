// Replaces the program's operator new by one that counts. Include it in one source of a program only: replacements
// cannot be inline.
#pragma once

#include <atomic>
#include <cstdlib>
#include <new>

namespace cmb::test {

inline std::atomic<unsigned long> allocations{0};

}  // namespace cmb::test

void *operator new(std::size_t size) {
  ++cmb::test::allocations;
  void *memory = std::malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}

// Sanitizers' own would not fit the delete below.
void *operator new(std::size_t size, const std::nothrow_t &) noexcept {
  ++cmb::test::allocations;
  return std::malloc(size > 0 ? size : 1);
}

void operator delete(void *memory) noexcept { std::free(memory); }
void operator delete(void *memory, std::size_t) noexcept { std::free(memory); }
