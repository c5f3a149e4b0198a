# What a project outside needs: headers, libraries, and files for pkg-config and for find_package(fbs). Each shared library is
# a component, and what compilers need another.
include(CMakePackageConfigHelpers)
set(config_folder ${CMAKE_INSTALL_LIBDIR}/cmake/fbs)
set(pkgconfig_folder ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
string(REGEX REPLACE "[^/]+" ".." prefix_from_pc ${pkgconfig_folder})  # so that the whole tree can be moved

# install_library(TARGET NAME SET COMPONENT): exported as fbs::NAME by fbs-<SET>targets.cmake
function(install_library target name set component)
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS ${target} EXPORT fbs-${set}targets
          LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT ${component} NAMELINK_COMPONENT development
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT fbs-${set}targets NAMESPACE fbs:: DESTINATION ${config_folder} COMPONENT development)
endfunction()

function(install_pkgconfig file)
  configure_file(${file}.pc.in ${CMAKE_CURRENT_BINARY_DIR}/${file}.pc @ONLY)
  install(FILES ${CMAKE_CURRENT_BINARY_DIR}/${file}.pc DESTINATION ${pkgconfig_folder} COMPONENT development)
endfunction()

set(headers fbs.h fbs.hpp packet.h)
install_library(fbs_shared fbs "" decoder)
install_library(fbs_static fbs_static static- development)
install_pkgconfig(fbs)
if(TARGET fbs_sound_shared)
  list(APPEND headers sound.h)
  install_library(fbs_sound_shared sound sound- sound)
  install_pkgconfig(fbs-sound)
endif()
if(FBS_BUILD_ENCODER)
  list(APPEND headers encoder.h encoder.hpp)
  install_library(fbs_encoder_shared encoder encoder- encoder)
  install_library(fbs_encoder_static encoder_static encoder-static- development)
  install_pkgconfig(fbs-encoder)
endif()
list(TRANSFORM headers PREPEND ${PROJECT_SOURCE_DIR}/include/fbs/)
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/fbs COMPONENT development)

configure_package_config_file(fbs-config.cmake.in fbs-config.cmake INSTALL_DESTINATION ${config_folder})
write_basic_package_version_file(fbs-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/fbs-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/fbs-config-version.cmake
        DESTINATION ${config_folder} COMPONENT development)
