# Installs headers and libraries into the Modelica package, together with the shared libraries of the system that
# the engine needs, so that a Modelica tool finds them by Library={"ContactMultiBody","fcl","ccd","stdc++"} and an
# FMU can carry them.
set(library_folder "${CMB_PACKAGE_RESOURCES}/Library/linux64")

install(FILES include/contact_multibody.h include/contact_multibody_modelica.h include/contact_multibody_scene.h
        include/contact_multibody_scene_modelica.h
        DESTINATION "${CMB_PACKAGE_RESOURCES}/Include")
install(TARGETS ContactMultiBody ARCHIVE DESTINATION "${library_folder}")
install(TARGETS contactmultibody_shared LIBRARY DESTINATION "${library_folder}")

# name: of the library; installs the file under its soname, and a link lib<name>.so to it.
function(cmb_install_system_library name)
  find_library(cmb_found_${name} NAMES ${name} REQUIRED)
  file(REAL_PATH "${cmb_found_${name}}" file)
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p "${file}" OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
  if(NOT headers MATCHES "SONAME +([^ \n]+)")
    message(FATAL_ERROR "${file} has no soname; install the Debian package of lib${name}")
  endif()
  set(soname "${CMAKE_MATCH_1}")
  install(FILES "${file}" DESTINATION "${library_folder}" RENAME "${soname}")
  install(CODE "file(CREATE_LINK \"${soname}\" \"${library_folder}/lib${name}.so\" SYMBOLIC)")
endfunction()

foreach(name fcl ccd octomap octomath)
  cmb_install_system_library(${name})
endforeach()
