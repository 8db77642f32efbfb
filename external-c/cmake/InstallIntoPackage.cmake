# Installs headers and libraries into the Modelica package, where a Modelica tool finds them by
# Library={"ContactMultiBody"}. Beside the archive lie the engine for other programs, and back ends: modules, and the
# shared libraries of the system that they need, so that an FMU can carry them.
if(WIN32)
  set(platform win64)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(platform aarch64-linux-gnu)
else()
  set(platform linux64)
endif()
set(library_folder "${CMB_PACKAGE_RESOURCES}/Library/${platform}")

install(FILES include/contact_multibody.h include/contact_multibody_modelica.h include/contact_multibody_scene.h
        include/contact_multibody_scene_modelica.h
        DESTINATION "${CMB_PACKAGE_RESOURCES}/Include")
install(FILES $<TARGET_FILE:ContactMultiBody> DESTINATION "${library_folder}" COMPONENT archive)
if(TARGET contactmultibody_shared)
  install(TARGETS contactmultibody_shared LIBRARY DESTINATION "${library_folder}")
endif()

# name: of the library; installs the file under its soname.
function(cmb_install_system_library name)
  find_library(cmb_found_${name} NAMES ${name} REQUIRED)
  file(REAL_PATH "${cmb_found_${name}}" file)
  execute_process(COMMAND ${CMAKE_OBJDUMP} -p "${file}" OUTPUT_VARIABLE headers COMMAND_ERROR_IS_FATAL ANY)
  if(NOT headers MATCHES "SONAME +([^ \n]+)")
    message(FATAL_ERROR "${file} has no soname; install the Debian package of lib${name}")
  endif()
  install(FILES "${file}" DESTINATION "${library_folder}" RENAME "${CMAKE_MATCH_1}")
endfunction()

foreach(module ContactMultiBodyLibccd ContactMultiBodyFcl ContactMultiBodyCoal)
  if(TARGET ${module})
    install(TARGETS ${module} LIBRARY DESTINATION "${library_folder}")
  endif()
endforeach()
if(TARGET ContactMultiBodyLibccd)
  cmb_install_system_library(ccd)
endif()
if(TARGET ContactMultiBodyFcl)
  foreach(name fcl octomap octomath)
    cmb_install_system_library(${name})
  endforeach()
endif()
