# Debian packages, one for each component that is installed: `cmake --workflow --preset debian` puts them into
# build/debian/packages. Their dependencies on packages of Debian are those that dpkg-shlibdeps finds.
set(CPACK_GENERATOR DEB)
# Who makes them answers for them: DEBFULLNAME and DEBEMAIL, as for Debian's own tools. Packages for oneself need neither.
set(CPACK_PACKAGE_CONTACT "The fbs authors <maintainers@fbs.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(CPACK_PACKAGE_CONTACT "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each has its own
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SECTION video)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/library)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# CPack would write scripts that call ldconfig, if these two were not named, which need not exist: a trigger does that.
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA none/postinst none/postrm)

set(made ${PROJECT_BINARY_DIR}/debian)
file(WRITE ${made}/triggers "activate-noawait ldconfig\n")
file(WRITE ${made}/overrides "# What it calls of libc is inlined or in GLib.
gstreamer1.0-fbs: library-not-linked-against-libc [usr/lib/*/gstreamer-1.0/libgstfbs.so]\n")
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where that is set
file(CONFIGURE OUTPUT ${made}/changelog CONTENT
"fbs (@PROJECT_VERSION@-@CPACK_DEBIAN_PACKAGE_RELEASE@) unstable; urgency=medium

  * Version @PROJECT_VERSION@: see CHANGELOG.md of the source.

 -- @CPACK_PACKAGE_CONTACT@  @date@
" @ONLY)
execute_process(COMMAND gzip -9nkf ${made}/changelog COMMAND_ERROR_IS_FATAL ANY)
# Parts of these headers are compiled in, and their licences are handed on.
file(READ LICENSE copyright)
foreach(package libcli11-dev libexpected-dev libglm-dev libtinygltf-dev nlohmann-json3-dev)
  file(READ /usr/share/doc/${package}/copyright theirs)
  string(APPEND copyright "\n\nCompiled in: ${package}\n\n${theirs}")
endforeach()
file(WRITE ${made}/copyright "${copyright}")

# debian_package(COMPONENT NAME SUMMARY TEXT [NEEDS component...] [LIBRARY] [DEPENDS text] [SUGGESTS text] [SECTION section])
function(debian_package component name summary text)
  cmake_parse_arguments(arg "LIBRARY" "DEPENDS;SUGGESTS;SECTION" "NEEDS" ${ARGN})
  install(FILES ${made}/copyright DESTINATION share/doc/${name} COMPONENT ${component})
  install(FILES ${made}/changelog.gz DESTINATION share/doc/${name} RENAME changelog.Debian.gz COMPONENT ${component})
  string(TOUPPER ${component} upper)
  set(package CPACK_DEBIAN_${upper}_PACKAGE)
  if(arg_LIBRARY)
    set(arg_SECTION libs)
    set(${package}_CONTROL_EXTRA ${CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA} ${made}/triggers PARENT_SCOPE)
  endif()
  set(${package}_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "video codec for talking heads - ${summary}
fbs sends a few pictures of a person, and between them only how head and
face move: 2 to 8 kbit/s, and the voice 1 to 16 more.
.
${text}" PARENT_SCOPE)
  foreach(field DEPENDS SUGGESTS SECTION)
    if(arg_${field})
      set(${package}_${field} ${arg_${field}} PARENT_SCOPE)
    endif()
  endforeach()
  set(CPACK_COMPONENT_${upper}_DEPENDS ${arg_NEEDS} PARENT_SCOPE)
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

set(soversion ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
debian_package(program fbs "program"
  "The program encodes, decodes, plays, measures and exports streams. Files of
images, cameras and the stills of reports need fbs-extra."
  SUGGESTS "fbs-extra, ffmpeg")
debian_package(extra fbs-extra "image files and cameras"
  "Modules of the program that read and write image files, and read cameras." NEEDS program)
debian_package(decoder libfbs${soversion} "decoder" "The library that decodes pictures and data of the face." LIBRARY)
debian_package(sound libfbs-sound${soversion} "sound" "The library that decodes the sound of streams." LIBRARY)
debian_package(encoder libfbs-encoder${soversion} "encoder" "The library that encodes pictures." LIBRARY)
debian_package(development libfbs-dev "development files"
  "Headers, static libraries, and files for pkg-config and CMake."
  NEEDS decoder sound encoder SECTION libdevel
  DEPENDS "libaom-dev, libdav1d-dev, libdraco-dev, libhwy-dev" SUGGESTS "libopencv-dev, pkg-config")
if(TARGET gstfbs)
  install(FILES ${made}/overrides DESTINATION share/lintian/overrides RENAME gstreamer1.0-fbs COMPONENT gstreamer)
  debian_package(gstreamer gstreamer1.0-fbs "plugin for GStreamer"
    "Elements that encode, decode and parse streams, and pack them for RTP." NEEDS decoder encoder)
endif()

# For Debian's Python alone. Debian 12 has no nanobind; the version is that of python/tests/requirements.txt.
set(Python_EXECUTABLE /usr/bin/python3)
find_package(Python COMPONENTS Interpreter Development.Module)
if(Python_FOUND AND NOT nanobind_DIR)
  set(venv ${made}/venv)
  file(STRINGS python/tests/requirements.txt nanobind REGEX "^nanobind==")
  execute_process(COMMAND ${Python_EXECUTABLE} -m venv ${venv})
  execute_process(COMMAND ${venv}/bin/pip install --quiet --disable-pip-version-check ${nanobind})
  execute_process(COMMAND ${venv}/bin/python -m nanobind --cmake_dir
                  OUTPUT_VARIABLE nanobind_folder OUTPUT_STRIP_TRAILING_WHITESPACE)
endif()
find_package(nanobind CONFIG QUIET PATHS ${nanobind_folder})
if(nanobind_FOUND)
  add_subdirectory(python)
  file(GLOB licence ${nanobind_DIR}/../../nanobind-*.dist-info/licenses/LICENSE)
  file(READ ${licence} theirs)
  file(APPEND ${made}/copyright "\n\nCompiled in, in python3-fbs: nanobind\n\n${theirs}")
  math(EXPR next "${Python_VERSION_MINOR} + 1")
  debian_package(python python3-fbs "Python"
    "A package that encodes and decodes numpy's arrays, and gives pose, landmarks
and expression as tables."
    NEEDS program decoder encoder SECTION python SUGGESTS "python3-pandas"
    DEPENDS "python3 (>= 3.${Python_VERSION_MINOR}), python3 (<< 3.${next}), python3-numpy")
  file(WRITE ${made}/postinst "#!/bin/sh\nset -e\npy3compile -p python3-fbs\n")
  file(WRITE ${made}/prerm "#!/bin/sh\nset -e\npy3clean -p python3-fbs\n")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${made}/postinst ${made}/prerm)
else()
  message(STATUS "Python's headers or nanobind not found: no package python3-fbs")
endif()

# Debian compresses man pages.
install(CODE "file(GLOB pages \$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1/*.1)
              execute_process(COMMAND gzip -9nf \${pages} COMMAND_ERROR_IS_FATAL ANY)" COMPONENT program)
include(CPack)
