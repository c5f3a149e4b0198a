#ifndef FBS_GSTREAMER_FBSDEC_H
#define FBS_GSTREAMER_FBSDEC_H

#include <fbs/fbs.h>
#include <gst/video/gstvideodecoder.h>

G_BEGIN_DECLS

#define GST_TYPE_FBS_DEC (gst_fbs_dec_get_type())
G_DECLARE_FINAL_TYPE(GstFbsDec, gst_fbs_dec, GST, FBS_DEC, GstVideoDecoder)

struct _GstFbsDec {
  GstVideoDecoder parent;

  gint threads; /**< property */

  fbs_decoder* decoder; /**< null: not started */
  gboolean has_input;
  gboolean finished;
  fbs_format format;                  /**< of the output; width 0: unknown */
  GstClockTimeDiff offset;            /**< timestamp of a picture less its time in the stream; 0: unknown */
  GstClockTime group;                 /**< timestamp of a buffer whose first picture has not come; or none */
  GstPadChainFunction decode_picture; /**< the base class takes a buffer for each picture */
};

G_END_DECLS

#endif
