// How functions of the C interface end: with a status and this thread's error text, never with an exception.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "backend/distance_library.hpp"
#include "c_api/last_error.hpp"
#include "contact_multibody.h"
#include "scene/registry.hpp"

namespace cmb {

inline cmb_status fail(cmb_status status, const std::string &text) {
  set_last_error(text.c_str());
  return status;
}

// Runs `work`, turning exceptions into a status: none may leave through a C interface.
template <typename Work>
cmb_status guarded(Work &&work) noexcept {
  try {
    return work();
  } catch (const SceneError &error) {
    set_last_error(error.what());
    return error.status();
  } catch (const LibraryMissing &error) {
    set_last_error(error.what());
    return CMB_ERROR_ARGUMENT;
  } catch (const std::bad_alloc &) {
    set_last_error("out of memory; make the scene smaller");
    return CMB_ERROR_MEMORY;
  } catch (const std::exception &error) {
    set_last_error(error.what());
    return CMB_ERROR_INTERNAL;
  } catch (...) {
    set_last_error("unknown failure");
    return CMB_ERROR_INTERNAL;
  }
}

}  // namespace cmb
