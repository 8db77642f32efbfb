# An archive of C++ objects that a C compiler links: the parts of the C++ runtime that they need are inside, and no symbol
# but the C interface shows, so that it meets neither a C++ runtime of what it is linked with nor a second such archive.
#
#   cmb_self_contained_archive(name OBJECTS object... HEADERS header...)
#
# HEADERS, in include/, declare the functions that stay visible. Equal objects give equal bytes. With sanitizers or counters,
# whose runtimes cannot be taken in, it is a plain archive.
function(cmb_self_contained_archive name)
  cmake_parse_arguments(PARSE_ARGV 1 archive "" "" "OBJECTS;HEADERS")
  if(CMB_SANITIZE OR CMB_COVERAGE OR APPLE)
    add_library(${name} STATIC ${archive_OBJECTS})
    target_include_directories(${name} INTERFACE include)
    return()
  endif()
  set(functions)
  foreach(header IN LISTS archive_HEADERS)
    set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS include/${header})
    file(READ include/${header} text)
    string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
    string(REGEX MATCHALL "cmb_[a-z0-9_]+\\(" calls "${text}")
    list(APPEND functions ${calls})
  endforeach()
  list(TRANSFORM functions REPLACE "\\($" "")
  list(REMOVE_DUPLICATES functions)
  list(SORT functions)

  set(file ${CMAKE_CURRENT_BINARY_DIR}/lib${name}.a)
  set(runtime)
  foreach(library libstdc++.a libgcc_eh.a)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=${library} OUTPUT_VARIABLE path
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    list(APPEND runtime ${path})
  endforeach()
  if(WIN32)
    execute_process(COMMAND ${CMAKE_CXX_COMPILER} -print-file-name=libwinpthread.a OUTPUT_VARIABLE path
                    OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
    # Partial linking loses sections that several objects share (COMDAT) there: all symbols but the interface get names of
    # their own instead.
    set(script ${CMAKE_CURRENT_SOURCE_DIR}/cmake/RenameSymbols.cmake)
    add_custom_command(OUTPUT ${file} COMMAND_EXPAND_LISTS VERBATIM
      COMMAND ${CMAKE_COMMAND} -E rm -f ${name}.objects.a
      COMMAND ${CMAKE_AR} qcD ${name}.objects.a ${archive_OBJECTS}
      COMMAND ${CMAKE_COMMAND} -DAR=${CMAKE_AR} -DLD=${CMAKE_LINKER} -DNM=${CMAKE_NM} -DOBJCOPY=${CMAKE_OBJCOPY}
              -DOBJECTS=${name}.objects.a "-DRUNTIME=$<JOIN:${runtime},$<COMMA>>,${path}"
              "-DKEEP=$<JOIN:${functions},$<COMMA>>" -DOUTPUT=${file} -P ${script}
      DEPENDS ${archive_OBJECTS} ${script})
  else()
    list(TRANSFORM functions PREPEND -Wl,-u, OUTPUT_VARIABLE roots)
    list(TRANSFORM functions PREPEND --keep-global-symbol= OUTPUT_VARIABLE kept)
    add_custom_command(OUTPUT ${file} COMMAND_EXPAND_LISTS VERBATIM
      COMMAND ${CMAKE_CXX_COMPILER} -r -nostdlib -o ${name}.o -Wl,--force-group-allocation -Wl,--gc-sections ${roots}
              ${archive_OBJECTS} -Wl,--start-group ${runtime} -lgcc -Wl,--end-group
      # Symbols that are unique to the process (STB_GNU_UNIQUE) cannot be made local; weak ones can.
      COMMAND ${CMAKE_OBJCOPY} --enable-deterministic-archives --wildcard --weaken-symbol=_Z* ${name}.o
      COMMAND ${CMAKE_OBJCOPY} --enable-deterministic-archives --strip-unneeded ${kept} ${name}.o
      COMMAND ${CMAKE_COMMAND} -E rm -f ${file}
      COMMAND ${CMAKE_AR} qcD ${file} ${name}.o
      DEPENDS ${archive_OBJECTS})
  endif()
  add_custom_target(${name}_file ALL DEPENDS ${file})
  add_library(${name} STATIC IMPORTED GLOBAL)
  set_target_properties(${name} PROPERTIES IMPORTED_LOCATION ${file}
                        INTERFACE_INCLUDE_DIRECTORIES ${CMAKE_CURRENT_SOURCE_DIR}/include)
  add_dependencies(${name} ${name}_file)
endfunction()
