#ifndef FBS_GSTREAMER_FBSENC_H
#define FBS_GSTREAMER_FBSENC_H

#include <fbs/encoder.h>
#include <gst/video/gstvideoencoder.h>

#include "encoder_stream.h"

G_BEGIN_DECLS

#define GST_TYPE_FBS_ENC (gst_fbs_enc_get_type())
G_DECLARE_FINAL_TYPE(GstFbsEnc, gst_fbs_enc, GST, FBS_ENC, GstVideoEncoder)

struct _GstFbsEnc {
  GstVideoEncoder parent;

  fbs_encoder_settings settings; /**< properties; `format` comes from the caps */
  GstVideoCodecState* input;     /**< null until the caps have come */
  GstFbsEncoderStream stream;
  GQueue frames;        /**< GstVideoCodecFrame whose pictures were pushed but not yet sent, in order */
  guint64 first_number; /**< number in the stream of the picture of the first of them */
  GstClockTime origin;  /**< timestamp of the stream's first picture */
  GstClockTime end;     /**< of the last picture pushed */
};

/** Properties are read and written in `settings`. */
void gst_fbs_enc_install_properties(GObjectClass* type);

G_END_DECLS

#endif
