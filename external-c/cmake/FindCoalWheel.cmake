# coal from the wheel `libcoal` and those it needs, unpacked into one folder (scripts/setup_bench does so):
# defines the imported target `coal` if CMB_COAL_PREFIX/cmeel.prefix holds it.
set(CMB_COAL_PREFIX "${CMAKE_CURRENT_SOURCE_DIR}/../.deps/coal" CACHE PATH "Folder that holds coal's wheels unpacked")
find_library(CMB_COAL_LIBRARY coal PATHS "${CMB_COAL_PREFIX}/cmeel.prefix/lib" NO_DEFAULT_PATH NO_CACHE)
if(CMB_COAL_LIBRARY)
  add_library(coal SHARED IMPORTED GLOBAL)
  set_target_properties(coal PROPERTIES IMPORTED_LOCATION "${CMB_COAL_LIBRARY}")
  target_include_directories(coal SYSTEM INTERFACE "${CMB_COAL_PREFIX}/cmeel.prefix/include")
  target_link_libraries(coal INTERFACE Eigen3::Eigen)
  # What libcoal needs in turn lies beside it.
  get_filename_component(coal_folder "${CMB_COAL_LIBRARY}" DIRECTORY)
  target_link_options(coal INTERFACE LINKER:--disable-new-dtags LINKER:-rpath,${coal_folder}
                      LINKER:-rpath-link,${coal_folder})
  message(STATUS "coal: ${CMB_COAL_LIBRARY}")
else()
  message(STATUS "coal: not in ${CMB_COAL_PREFIX}; built without it")
endif()
