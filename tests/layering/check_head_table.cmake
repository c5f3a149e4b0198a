# cmake -D TOOL=<head_table_tool> -D HEAD=<generic_head.gltf> -D TABLE=<generic_head_table.cpp> -D OUT=<file to write>
#       -P check_head_table.cmake
# The head's table in the source is the one that the tool makes of the head.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${TOOL} ${HEAD} ${OUT} COMMAND_ERROR_IS_FATAL ANY)
file(SHA256 ${TABLE} kept)
file(SHA256 ${OUT} made)
if(NOT kept STREQUAL made)
  message(FATAL_ERROR "${TABLE} is not made of ${HEAD}: build the target head_table")
endif()
