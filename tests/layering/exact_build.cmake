# fbs_exact_build(NAME option...): stream_md5 with all of common, bitstream and decoder compiled anew with these options.
# fbs_exact_build_clang(NAME option...): the same by clang++, whatever the compiler of the build is.
# What every build decodes is compared with one table: design, section 10, "decoding is exact".
set(exact_sources ${PROJECT_SOURCE_DIR}/common/md5.cpp ${PROJECT_SOURCE_DIR}/tests/vectors/stream_digest.cpp
                  ${PROJECT_SOURCE_DIR}/tests/vectors/stream_md5.cpp)
foreach(library fbs_common fbs_bitstream fbs_decoder)
  get_target_property(sources ${library} SOURCES)
  get_target_property(folder ${library} SOURCE_DIR)
  foreach(source ${sources})
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${folder})
    list(APPEND exact_sources ${source})
    get_source_file_property(alone ${source} TARGET_DIRECTORY ${library} SKIP_UNITY_BUILD_INCLUSION)
    if(alone)
      set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
    endif()
  endforeach()
endforeach()
find_package(draco REQUIRED)
pkg_check_modules(dav1d REQUIRED IMPORTED_TARGET dav1d)
pkg_check_modules(hwy REQUIRED IMPORTED_TARGET libhwy)

function(fbs_exact_test name)
  add_test(NAME exact.${name} COMMAND ${name} ${PROJECT_SOURCE_DIR}/tests/vectors)
endfunction()

function(fbs_exact_build name)
  add_executable(${name} ${exact_sources})
  target_compile_options(${name} PRIVATE ${ARGN})
  target_link_libraries(${name} PRIVATE fbs_options glm::glm tl::expected draco::draco PkgConfig::dav1d PkgConfig::hwy)
  fbs_exact_test(${name})
endfunction()

function(fbs_exact_build_clang name)
  set(objects "")
  foreach(source ${exact_sources})
    get_filename_component(stem ${source} NAME_WE)
    set(object ${CMAKE_CURRENT_BINARY_DIR}/${name}.dir/${stem}.o)
    add_custom_command(
      OUTPUT ${object}
      COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_CURRENT_BINARY_DIR}/${name}.dir
      COMMAND ${FBS_CLANGXX} -std=c++20 ${ARGN} -I${PROJECT_SOURCE_DIR} -I${PROJECT_BINARY_DIR}
              -MD -MF ${object}.d -c ${source} -o ${object}
      DEPENDS ${source}
      DEPFILE ${object}.d
      VERBATIM)
    list(APPEND objects ${object})
  endforeach()
  set(program ${PROJECT_BINARY_DIR}/${name})
  add_custom_command(
    OUTPUT ${program}
    COMMAND ${FBS_CLANGXX} ${objects} -ldraco ${dav1d_LINK_LIBRARIES} ${hwy_LINK_LIBRARIES} -o ${program}
    DEPENDS ${objects}
    VERBATIM)
  add_custom_target(${name} ALL DEPENDS ${program})
  add_test(NAME exact.${name} COMMAND ${program} ${PROJECT_SOURCE_DIR}/tests/vectors)
endfunction()
