# Headers that most sources of a target include are read once: reading them takes a quarter of the time of compiling. All targets of
# a group share them and have the same options. Compiler caches keep nothing that was compiled so; they do without.
#
#   cmb_precompile_headers(group [PROGRAMS] OPTIONS option... HEADERS header... [LIBRARIES library...])
#   cmb_use_precompiled_headers(target group)
#
# PROGRAMS: the targets are executables, whose code is position-independent in another way than that of libraries.
function(cmb_precompile_headers group)
  cmake_parse_arguments(PARSE_ARGV 1 precompiled "PROGRAMS" "" "OPTIONS;HEADERS;LIBRARIES")
  if(CMAKE_CXX_COMPILER_LAUNCHER)
    return()
  endif()
  # A target of its own: what is precompiled counts as an object of its target, and those go into archives.
  set(source ${CMAKE_CURRENT_BINARY_DIR}/precompiled_${group}.cpp)
  if(precompiled_PROGRAMS)
    file(CONFIGURE OUTPUT ${source} CONTENT "int main() {}\n")
    add_executable(cmb_precompiled_${group} ${source})
  else()
    file(CONFIGURE OUTPUT ${source} CONTENT "")
    add_library(cmb_precompiled_${group} OBJECT ${source})
  endif()
  target_compile_options(cmb_precompiled_${group} PRIVATE ${precompiled_OPTIONS})
  target_link_libraries(cmb_precompiled_${group} PRIVATE ${precompiled_LIBRARIES})
  target_precompile_headers(cmb_precompiled_${group} PRIVATE ${precompiled_HEADERS})
endfunction()

function(cmb_use_precompiled_headers target group)
  if(TARGET cmb_precompiled_${group})
    target_precompile_headers(${target} REUSE_FROM cmb_precompiled_${group})
  endif()
endfunction()
