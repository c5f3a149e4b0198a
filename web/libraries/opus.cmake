# The decoder of Opus, in floating point.
set(opus ${SOURCES}/opus)
prefixed(opus_sources ${opus}
  celt/bands.c celt/celt.c celt/celt_decoder.c celt/celt_lpc.c celt/cwrs.c celt/entcode.c celt/entdec.c celt/entenc.c
  celt/kiss_fft.c celt/laplace.c celt/mathops.c celt/mdct.c celt/modes.c celt/pitch.c celt/quant_bands.c celt/rate.c
  celt/vq.c
  silk/CNG.c silk/LPC_analysis_filter.c silk/LPC_fit.c silk/LPC_inv_pred_gain.c silk/NLSF2A.c silk/NLSF_VQ_weights_laroia.c
  silk/NLSF_decode.c silk/NLSF_stabilize.c silk/NLSF_unpack.c silk/PLC.c silk/bwexpander.c silk/bwexpander_32.c
  silk/code_signs.c silk/dec_API.c silk/decode_core.c silk/decode_frame.c silk/decode_indices.c silk/decode_parameters.c
  silk/decode_pitch.c silk/decode_pulses.c silk/decoder_set_fs.c silk/gain_quant.c silk/init_decoder.c
  silk/inner_prod_aligned.c silk/lin2log.c silk/log2lin.c silk/pitch_est_tables.c silk/resampler.c
  silk/resampler_down2.c silk/resampler_down2_3.c silk/resampler_private_AR2.c silk/resampler_private_IIR_FIR.c
  silk/resampler_private_down_FIR.c silk/resampler_private_up2_HQ.c silk/resampler_rom.c silk/shell_coder.c
  silk/sigm_Q15.c silk/sort.c silk/stereo_MS_to_LR.c silk/stereo_decode_pred.c silk/sum_sqr_shift.c
  silk/table_LSF_cos.c silk/tables_LTP.c silk/tables_NLSF_CB_NB_MB.c silk/tables_NLSF_CB_WB.c silk/tables_gain.c
  silk/tables_other.c silk/tables_pitch_lag.c silk/tables_pulses_per_block.c
  src/opus.c src/opus_decoder.c)
add_library(opus STATIC ${opus_sources})
target_compile_definitions(opus PRIVATE OPUS_BUILD USE_ALLOCA HAVE_LRINT HAVE_LRINTF FLOAT_APPROX)
target_compile_options(opus PRIVATE -Os)
target_include_directories(opus PRIVATE ${opus}/include ${opus}/celt ${opus}/silk ${opus}/silk/float)
installed(opus opus 1.3.1)
install(DIRECTORY ${opus}/include/ DESTINATION include/opus FILES_MATCHING PATTERN "*.h")
