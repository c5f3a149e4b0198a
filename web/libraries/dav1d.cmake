# Pictures of 8 bits, no assembly: there is none for WebAssembly.
set(dav1d ${SOURCES}/dav1d)
set(dav1d_config ${CMAKE_CURRENT_BINARY_DIR}/dav1d_config)
file(WRITE ${dav1d_config}/config.h [[
#define ARCH_AARCH64 0
#define ARCH_ARM 0
#define ARCH_PPC64LE 0
#define ARCH_X86 0
#define ARCH_X86_32 0
#define ARCH_X86_64 0
#define CONFIG_16BPC 0
#define CONFIG_8BPC 1
#define CONFIG_LOG 0
#define ENDIANNESS_BIG 0
#define HAVE_ASM 0
#define HAVE_CLOCK_GETTIME 1
#define HAVE_POSIX_MEMALIGN 1
#define HAVE_UNISTD_H 1
]])
# Wrong arguments are not printed: printf is 5 kB.
file(WRITE ${dav1d_config}/common/validate.h [[
#include <stdlib.h>
#define validate_input_or_ret_with_msg(x, r, ...) if (!(x)) return r
#define validate_input_or_ret(x, r) if (!(x)) return r
#define validate_input(x) if (!(x)) return
]])
# Film grain is not applied.
file(WRITE ${dav1d_config}/no_grain.c [[
#include "common/bitdepth.h"
#include "src/fg_apply.h"
void bitfn(dav1d_film_grain_dsp_init)(Dav1dFilmGrainDSPContext* dsp) {}
void bitfn(dav1d_prep_grain)(const Dav1dFilmGrainDSPContext* dsp, Dav1dPicture* out, const Dav1dPicture* in,
                             uint8_t scaling[3][SCALING_SIZE], entry grain[3][GRAIN_HEIGHT + 1][GRAIN_WIDTH]) {}
void bitfn(dav1d_apply_grain_row)(const Dav1dFilmGrainDSPContext* dsp, Dav1dPicture* out, const Dav1dPicture* in,
                                  const uint8_t scaling[3][SCALING_SIZE],
                                  const entry grain[3][GRAIN_HEIGHT + 1][GRAIN_WIDTH], int row) {}
void bitfn(dav1d_apply_grain)(const Dav1dFilmGrainDSPContext* dsp, Dav1dPicture* out, const Dav1dPicture* in) {}
]])
file(WRITE ${dav1d_config}/vcs_version.h "#define DAV1D_VERSION \"1\"\n")

prefixed(dav1d_sources ${dav1d}/src
  cdf.c cpu.c data.c decode.c dequant_tables.c getbits.c intra_edge.c itx_1d.c lf_mask.c lib.c log.c mem.c msac.c obu.c
  picture.c qm.c ref.c refmvs.c scan.c tables.c thread_task.c warpmv.c wedge.c)
# Compiled once for each depth of samples.
prefixed(dav1d_depth_sources ${dav1d}/src
  cdef_apply_tmpl.c cdef_tmpl.c ipred_prepare_tmpl.c ipred_tmpl.c itx_tmpl.c lf_apply_tmpl.c loopfilter_tmpl.c
  looprestoration_tmpl.c lr_apply_tmpl.c mc_tmpl.c recon_tmpl.c)
list(APPEND dav1d_depth_sources ${dav1d_config}/no_grain.c)
set_source_files_properties(${dav1d_depth_sources} PROPERTIES COMPILE_DEFINITIONS BITDEPTH=8)

add_library(dav1d STATIC ${dav1d_sources} ${dav1d_depth_sources})
target_compile_options(dav1d PRIVATE -Os -std=c99 -D_POSIX_C_SOURCE=200112L)
target_include_directories(dav1d PRIVATE ${dav1d_config} ${dav1d_config}/dav1d ${dav1d} ${dav1d}/include ${dav1d}/include/compat/gcc)
installed(dav1d dav1d 1.0.0)
install(DIRECTORY ${dav1d}/include/dav1d DESTINATION include FILES_MATCHING PATTERN "*.h")
file(READ ${dav1d}/meson.build dav1d_build)
string(REGEX MATCH "dav1d_soname_version *= *'([0-9]+)\\.([0-9]+)\\.([0-9]+)'" ignored "${dav1d_build}")
set(DAV1D_API_VERSION_MAJOR ${CMAKE_MATCH_1})
set(DAV1D_API_VERSION_MINOR ${CMAKE_MATCH_2})
set(DAV1D_API_VERSION_PATCH ${CMAKE_MATCH_3})
configure_file(${dav1d}/include/dav1d/version.h.in ${dav1d_config}/dav1d/version.h @ONLY)
install(FILES ${dav1d_config}/dav1d/version.h DESTINATION include/dav1d)
