# cmake -D ROOT=<repository> -P check_integers.cmake
# The path from stream to picture is integers only (design, section 10): no floating-point type, literal or function is
# named in it. Comments and strings may speak of them.
cmake_minimum_required(VERSION 3.25)
file(GLOB_RECURSE sources
  ${ROOT}/bitstream/*.h ${ROOT}/bitstream/*.cpp
  ${ROOT}/decoder/*.h ${ROOT}/decoder/*.cpp)
# Models, tables and named expressions for other programs are made beside the decoder, which uses none of them.
list(FILTER sources EXCLUDE REGEX "/decoder/(export|expression)/")
list(APPEND sources
  ${ROOT}/common/generic_head.cpp ${ROOT}/common/picture.h ${ROOT}/common/result.h ${ROOT}/common/state.h)
# common/generic_head.h is left out: FeatureVertex::s is a float, "only the encoder uses it".
# common/bspline.h and common/quality.* are the encoder's and the measurements'.

set(word "[^A-Za-z0-9_]")
set(types "float|double|float_t|double_t|glm::[df]?vec[234]|glm::[df]?mat[234x]+|glm::[df]?quat|_Float[0-9]+")
set(functions "sqrt|sqrtf|pow|powf|exp|exp2|log|log2|sin|cos|tan|atan|atan2|floor|ceil|lround|llround|round|rint|fabs|hypot|fma|ldexp")
set(faults 0)
list(LENGTH sources checked)
foreach(source ${sources})
  file(RELATIVE_PATH name ${ROOT} ${source})
  file(READ ${source} text)
  # ; and brackets would make lists of it; strings and comments go.
  string(REGEX REPLACE "[][;]" " " text "${text}")
  string(REGEX REPLACE "\"([^\"\\\n]|\\\\.)*\"" "S" text "${text}")
  string(REGEX REPLACE "//[^\n]*" "" text "${text}")
  string(REGEX REPLACE "/\\*([^*]|\\*+[^*/])*\\*+/" "" text "${text}")
  set(text " ${text} ")
  foreach(rule
      "${word}(${types})${word}"
      "${word}std::(${functions})[ ]*\\("
      "${word}[0-9]+\\.[0-9]*[fFlL]?${word}"
      "${word}\\.[0-9]+"
      "${word}[0-9]+[eE][-+]?[0-9]+"
      "#[ ]*include[ ]*<(cmath|math.h|cfloat|glm/glm.hpp|glm/mat[^>]*|glm/gtc[^>]*)>")
    string(REGEX MATCHALL "${rule}" found "${text}")
    foreach(hit ${found})
      string(STRIP "${hit}" hit)
      message("${name}: ${hit}")
      math(EXPR faults "${faults} + 1")
    endforeach()
  endforeach()
endforeach()
if(checked LESS 40)
  message(FATAL_ERROR "only ${checked} sources found in ${ROOT}")
endif()
if(faults)
  message(FATAL_ERROR "${faults} floating-point names on the decoder's path")
endif()
message("${checked} sources, integers only")
