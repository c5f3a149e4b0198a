# cmake -D ROOT=<repository> -P check_includes.cmake
# Folders are floors, and so are the rooms inside them: a file includes files on its own floor or below. The lowest comes
# first. What is directly in bitstream/ (the plain data of the syntax) is below its payloads; what stands
# directly in decoder/ and encoder/ joins their rooms and is above them. fbs/ is what include/ holds for others, which itself
# includes nothing of ours.
cmake_minimum_required(VERSION 3.25)
set(floors
  common
  bitstream/entropy bitstream bitstream/payload bitstream/pattern bitstream/motion bitstream/blend bitstream/scene
  decoder/vectors decoder/head decoder/raster decoder/field decoder/atlas decoder/animate decoder/blend decoder/pattern decoder/scene decoder/draw decoder/stream
  decoder/expression decoder/export decoder/sound
  encoder/sound encoder/image encoder/shots encoder/landmarks encoder/model encoder/find encoder/effort.h encoder/settings.h encoder/track/head encoder/track/snake encoder/track encoder/fit encoder/surround encoder/patterns encoder/plan encoder/blend encoder/analysis encoder/segment encoder/scene encoder/retarget
  encoder
  fbs library
  cli/program cli/files cli/video cli/video/y4m cli/video/images cli/video/av cli/video/open cli/stream cli/matroska cli/display cli/source cli/command_line
  cli/doctor cli/inspect cli/remux cli/decode cli/play/sound cli/play cli/encode cli/export cli/track cli/retarget
  cli/evaluate/run cli/evaluate/peers cli/evaluate/quality cli/evaluate/rate_distortion cli/evaluate/report cli/evaluate
  cli)
# These stand side by side: neither may include the other.
set(apart "decoder/head decoder/raster" "decoder/animate decoder/raster"
          "decoder/raster decoder/field" "decoder/export encoder" "decoder/export library"
          "decoder/export decoder/sound" "decoder/expression decoder/sound" "decoder/expression encoder"
          "encoder/landmarks encoder/model" "encoder/track/head encoder/track/snake" "encoder/track encoder/fit" "encoder/fit encoder/surround"
          "encoder/track encoder/surround" "encoder/patterns encoder/plan" "encoder/surround encoder/plan"
          "cli/video/y4m cli/video/images" "cli/video/y4m cli/video/av" "cli/video/images cli/video/av"
          "cli/video/images cli/video/open" "cli/video/av cli/video/open")
# What big libraries are for, and the only rooms that may include them.
set(foreign
  "opencv2/video/@encoder/track/head"
  "opencv2/videoio@cli/video"
  "opencv2/highgui@none"
  "opencv2/@encoder/image|encoder/shots|encoder/landmarks|encoder/model|encoder/find|encoder/track(/head|/snake)?|encoder/fit|encoder/surround|encoder/blend|encoder/plan|encoder/analysis|encoder/segment|encoder/scene|cli/(video|display|doctor|source|play|encode|evaluate/quality)"
  "opus(/|\\.h)@decoder/sound|encoder/sound|cli/doctor"
  "codec2(/|\\.h)@decoder/sound|encoder/sound|cli/doctor"
  "aom/@encoder/patterns|cli/doctor"
  "dav1d/@decoder/pattern|cli/doctor"
  "hwy/@decoder/vectors|decoder/field|decoder/raster|encoder/blend|encoder/fit|cli/doctor"
  "draco/@bitstream/payload|decoder/export|cli/doctor"
  "nlohmann@encoder/find|cli/(stream|doctor|inspect|evaluate(/.*)?)"
  "OpenImageIO@cli/video/images"
  "libav|libsw@cli/video/av"
  "(matroska|ebml|webm)/@cli/matroska"
  "CLI/@cli|cli/command_line"
  "SDL@cli/play(/sound)?"
  "tiny_gltf@decoder/export"
  "gst/@gstreamer")
set(tool_of_the_build "common/head_table_tool.cpp")  # makes the head's table out of glTF; in no library
# The floor of a path: the longest name in `floors` that it has or lies in.
function(floor_of path out)
  set(folder ${path})
  while(folder AND NOT folder IN_LIST floors)
    get_filename_component(folder "${folder}" DIRECTORY)
  endwhile()
  set(${out} "${folder}" PARENT_SCOPE)
endfunction()

set(faults 0)
set(checked 0)
file(GLOB_RECURSE sources RELATIVE ${ROOT}
  ${ROOT}/common/*.h ${ROOT}/common/*.cpp ${ROOT}/bitstream/*.h ${ROOT}/bitstream/*.cpp ${ROOT}/decoder/*.h
  ${ROOT}/decoder/*.cpp ${ROOT}/encoder/*.h ${ROOT}/encoder/*.cpp ${ROOT}/include/*.h ${ROOT}/include/*.hpp
  ${ROOT}/library/*.h ${ROOT}/library/*.cpp ${ROOT}/cli/*.h ${ROOT}/cli/*.cpp)
foreach(source ${sources})
  math(EXPR checked "${checked} + 1")
  floor_of(${source} mine)
  list(FIND floors "${mine}" my_place)
  file(STRINGS ${ROOT}/${source} includes REGEX "^[ \t]*#[ \t]*include")
  foreach(include ${includes})
    if(include MATCHES "\"([a-z_]+/[^\"]+)\"")
      set(path ${CMAKE_MATCH_1})
      floor_of(${path} theirs)
      list(FIND floors "${theirs}" place)
      if(place EQUAL -1)
        set(place 1000)  # samples, tests, or a folder that is not in the list
      endif()
      if(place GREATER my_place)
        message("${source}: ${path} points up: ${mine} is below ${theirs}")
        math(EXPR faults "${faults} + 1")
      endif()
      foreach(pair ${apart})
        if(pair STREQUAL "${theirs} ${mine}")
          message("${source}: ${path}: ${theirs} and ${mine} stand side by side")
          math(EXPR faults "${faults} + 1")
        endif()
      endforeach()
    elseif(NOT source IN_LIST tool_of_the_build)
      foreach(rule ${foreign})
        string(REPLACE "@" ";" rule "${rule}")
        list(GET rule 0 header)
        list(GET rule 1 rooms)
        if(include MATCHES "[<\"](${header})")
          if(NOT mine MATCHES "^(${rooms})$")
            message("${source}: ${include} does not belong in ${mine}/")
            math(EXPR faults "${faults} + 1")
          endif()
          break()
        endif()
      endforeach()
    endif()
  endforeach()
endforeach()
# The plugin, Python's extension and the module for browsers are users of the libraries like any other: of ours they include
# include/fbs alone.
foreach(user "gstreamer@(fbs|gst)/|string\\.h" "python/src@(fbs|nanobind)/|[a-z_]+>"
        "web/module@fbs/|stddef\\.h")
  string(REPLACE "@" ";" user "${user}")
  list(GET user 0 folder)
  list(GET user 1 headers)
  file(GLOB its_sources RELATIVE ${ROOT} ${ROOT}/${folder}/*.h ${ROOT}/${folder}/*.c ${ROOT}/${folder}/*.cpp)
  foreach(source ${its_sources})
    math(EXPR checked "${checked} + 1")
    file(STRINGS ${ROOT}/${source} includes REGEX "^[ \t]*#[ \t]*include")
    foreach(include ${includes})
      if(include MATCHES "\"[^\"]*/" OR NOT include MATCHES "\"|<(${headers})")
        message("${source}: ${include} is not for ${folder}")
        math(EXPR faults "${faults} + 1")
      endif()
    endforeach()
  endforeach()
endforeach()
if(checked LESS 100)
  message(FATAL_ERROR "only ${checked} sources found in ${ROOT}")
endif()
if(faults)
  message(FATAL_ERROR "${faults} faults")
endif()
message("${checked} sources, no fault")
