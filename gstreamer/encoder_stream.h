/* An encoder whose stream comes out in groups. */
#ifndef FBS_GSTREAMER_ENCODER_STREAM_H
#define FBS_GSTREAMER_ENCODER_STREAM_H

#include <fbs/encoder.h>
#include <gst/gst.h>

G_BEGIN_DECLS

/** Bytes of one buffer: alignment "group" of caps.h. */
typedef struct {
  GByteArray* bytes; /**< owned */
  guint64 number;    /**< of the first picture shown; for the end packet: number of pictures */
  gboolean key;      /**< begins a scene where decoding can begin */
  gboolean end;      /**< the end packet */
} GstFbsGroup;

void gst_fbs_group_free(GstFbsGroup* group);

/** All zero: closed. */
typedef struct {
  fbs_encoder* encoder; /**< null: closed */
  guint64 pictures;     /**< pushed to the encoder */
  guint64 time;         /**< the sum of their durations, 1/90000 s */
  guint32 nominal;      /**< duration, 1/90000 s */
  GstFbsGroup* group;   /**< not complete yet; or null */
  GQueue ready;         /**< GstFbsGroup */
} GstFbsEncoderStream;

/** Begins a stream.
 * @return as fbs_encoder_open(); the stream is closed unless that is FBS_OK */
fbs_status gst_fbs_encoder_stream_open(GstFbsEncoderStream* stream, const fbs_encoder_settings* settings);

/** @param end  of the picture, from the beginning of the stream, 1/90000 s. The durations of pictures add up
 * to it, to half a picture; a longer pause prolongs this picture
 * @return as fbs_encoder_push(); then groups may be ready */
fbs_status gst_fbs_encoder_stream_push(GstFbsEncoderStream* stream, const fbs_const_picture* picture,
                                       guint64 end);

/** Codes all that has been pushed.
 * @return as fbs_encoder_finish(); FBS_OK if nothing has been pushed */
fbs_status gst_fbs_encoder_stream_finish(GstFbsEncoderStream* stream);

void gst_fbs_encoder_stream_close(GstFbsEncoderStream* stream);

G_END_DECLS

#endif
