# Codec 2 without its modems, in the modes of bitstream/codec2_mode.h.
set(codec2 ${SOURCES}/codec2/src)
set(codec2_made ${CMAKE_CURRENT_BINARY_DIR}/codec2)
set(codec2_books ${codec2}/codebook)

# Its tables are made by a program of its own, which runs here.
find_program(HOST_CC NAMES cc gcc clang REQUIRED NO_CMAKE_FIND_ROOT_PATH)
add_custom_command(OUTPUT ${codec2_made}/generate_codebook
  COMMAND ${CMAKE_COMMAND} -E make_directory ${codec2_made}/include/codec2
  COMMAND ${HOST_CC} -w ${codec2}/generate_codebook.c -o ${codec2_made}/generate_codebook -lm)
set(codec2_tables "")
# table(FILE NAME book...)
function(table file name)
  list(TRANSFORM ARGN PREPEND ${codec2_books}/)
  list(TRANSFORM ARGN APPEND .txt)
  add_custom_command(OUTPUT ${codec2_made}/${file}.c DEPENDS ${codec2_made}/generate_codebook
    COMMAND ${codec2_made}/generate_codebook ${name} ${ARGN} > ${codec2_made}/${file}.c)
  set(codec2_tables ${codec2_tables} ${codec2_made}/${file}.c PARENT_SCOPE)
endfunction()
set(numbers 1 2 3 4 5 6 7 8 9 10)
list(TRANSFORM numbers PREPEND lsp OUTPUT_VARIABLE scalar)
list(TRANSFORM numbers PREPEND dlsp OUTPUT_VARIABLE differential)
table(codebook lsp_cb ${scalar})
table(codebookd lsp_cbd ${differential})
table(codebookjmv lsp_cbjmv lspjmv1 lspjmv2 lspjmv3)
table(codebookge ge_cb gecb)
table(codebooknewamp1 newamp1vq_cb train_120_1 train_120_2)
table(codebooknewamp1_energy newamp1_energy_cb newamp1_energy_q)

# Its decoder alone: what encodes is left out.
file(READ ${codec2}/codec2.c codec2_text)
string(REGEX REPLACE "c2->encode = codec2_encode_[0-9c]+" "c2->encode = NULL" codec2_text "${codec2_text}")
file(WRITE ${codec2_made}/codec2.c "${codec2_text}")
prefixed(codec2_sources ${codec2}
  codec2_fft.c interp.c kiss_fft.c kiss_fftr.c lpc.c lsp.c mbest.c newamp1.c nlp.c pack.c phase.c postfilter.c
  quantise.c sine.c)
add_library(codec2 STATIC ${codec2_made}/codec2.c ${codec2_sources} ${codec2_tables})
target_compile_options(codec2 PRIVATE -Os)
target_compile_definitions(codec2 PRIVATE CODEC2_MODE_EN_DEFAULT=0)
foreach(mode 3200 2400 1600 1400 1300 1200)
  target_compile_definitions(codec2 PRIVATE CODEC2_MODE_${mode}_EN=1)
endforeach()
target_include_directories(codec2 PRIVATE ${codec2})
file(WRITE ${codec2_made}/include/codec2/version.h "")
target_include_directories(codec2 PRIVATE ${codec2_made}/include)
installed(codec2 codec2 1)
install(FILES ${codec2}/codec2.h ${codec2_made}/include/codec2/version.h DESTINATION include/codec2)
