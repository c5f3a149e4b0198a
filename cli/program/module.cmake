# fbs_add_module(NAME [COMPONENT component] source...): a module that the program loads when a verb needs it
# (cli/program/module.h), installed with the program unless another component is named.
# It lands beside the program in the build tree and in lib/fbs when installed. Link its libraries afterwards with
# target_link_libraries(NAME PRIVATE ...); static libraries that go in must be position independent.
include_guard(GLOBAL)

add_library(fbs_module_version OBJECT ${CMAKE_CURRENT_LIST_DIR}/module_version.cpp)
target_compile_definitions(fbs_module_version PRIVATE FBS_VERSION="${PROJECT_VERSION}")
target_link_libraries(fbs_module_version PRIVATE fbs_options tl::expected)

function(fbs_add_module name)
  cmake_parse_arguments(arg "" "COMPONENT" "" ${ARGN})
  add_library(${name} MODULE ${arg_UNPARSED_ARGUMENTS})
  set_target_properties(${name} PROPERTIES
    PREFIX ""
    SUFFIX ".so"
    CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  target_sources(${name} PRIVATE $<TARGET_OBJECTS:fbs_module_version>)
  target_link_libraries(${name} PRIVATE fbs_options)
  target_link_options(${name} PRIVATE -Wl,--exclude-libs,ALL)  # only the marked functions are seen from outside
  if(FBS_INSTALL)
    if(NOT arg_COMPONENT)
      set(arg_COMPONENT program)
    endif()
    # Where the program looks, whatever CMAKE_INSTALL_LIBDIR is.
    install(TARGETS ${name} LIBRARY DESTINATION lib/fbs COMPONENT ${arg_COMPONENT})
  endif()
endfunction()
