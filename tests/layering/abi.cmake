# The binary interface of the shared libraries against that of the last release, as abidw has written it down in
# library/abi: functions may be added, and members at the end of settings. Anything else wants another soname, and then new
# dumps: `cmake --build build/release --target abi_dump`.
find_program(FBS_ABIDW abidw)
find_program(FBS_ABIDIFF abidiff)
if(NOT FBS_ABIDW OR NOT FBS_ABIDIFF OR NOT CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" OR FBS_SANITIZED)
  return()
endif()
set(dumps ${PROJECT_SOURCE_DIR}/library/abi)
add_custom_target(abi_dump)
foreach(kind decoder encoder sound)
  if(NOT TARGET fbs_${kind}_api)
    continue()
  endif()
  # The library again, of the same sources with the types of the interface as debug information.
  get_target_property(sources fbs_${kind}_api SOURCES)
  list(TRANSFORM sources PREPEND ${PROJECT_SOURCE_DIR}/library/)
  add_library(abi_${kind} SHARED ${sources})
  set_target_properties(abi_${kind} PROPERTIES OUTPUT_NAME abi_${kind} UNITY_BUILD ON)
  target_compile_definitions(abi_${kind} PRIVATE FBS_VERSION="${PROJECT_VERSION}")
  target_compile_options(abi_${kind} PRIVATE -g -O0)
  target_link_libraries(abi_${kind} PRIVATE $<TARGET_PROPERTY:fbs_${kind}_api,LINK_LIBRARIES>)
  target_link_options(abi_${kind} PRIVATE -Wl,--version-script=${PROJECT_SOURCE_DIR}/library/exports.map)

  set(dump ${dumps}/${kind}.abi)
  add_test(NAME layering.abi_${kind}
           COMMAND ${FBS_ABIDIFF} --no-added-syms --suppressions ${dumps}/suppressions.ini
                   --headers-dir2 ${PROJECT_SOURCE_DIR}/include/fbs ${dump} $<TARGET_FILE:abi_${kind}>)
  fbs_quick(TESTS layering.abi_${kind} RUN abi_${kind})
  add_custom_command(TARGET abi_dump
    COMMAND ${FBS_ABIDW} --no-comp-dir-path --no-corpus-path --no-show-locs --no-elf-needed --drop-private-types
            --exported-interfaces-only --headers-dir ${PROJECT_SOURCE_DIR}/include/fbs --out-file ${dump}
            $<TARGET_FILE:abi_${kind}>
    VERBATIM)
  add_dependencies(abi_dump abi_${kind})
endforeach()
