# cmake -D PROGRAM=<program or library with the decoder alone> -D READELF=<readelf> -D LDD=<ldd> -P check_links.cmake
# The decoder, which goes into players and phones, links no OpenCV, OpenImageIO, tinygltf or codec of sound, directly or indirectly.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${READELF} -d ${PROGRAM} OUTPUT_VARIABLE needed COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${LDD} ${PROGRAM} OUTPUT_VARIABLE all COMMAND_ERROR_IS_FATAL ANY)
if(NOT needed MATCHES "libdav1d")
  message(FATAL_ERROR "${PROGRAM} does not even need dav1d: this is not the decoder")
endif()
string(REGEX MATCHALL "[^\n]*(opencv|OpenImageIO|tinygltf|libaom|libavcodec|libavformat|libopus|libcodec2)[^\n]*" found "${needed}${all}")
if(found)
  list(JOIN found "\n" found)
  message(FATAL_ERROR "the decoder links\n${found}")
endif()
