/* Media types, and functions shared by several elements. */
#ifndef FBS_GSTREAMER_CAPS_H
#define FBS_GSTREAMER_CAPS_H

#include <fbs/packet.h>
#include <gst/gst.h>

G_BEGIN_DECLS

#define GST_FBS_MEDIA_TYPE "video/x-fbs"

/* A buffer of alignment "group" has whole packets, of which the last one releases pictures (SPEC 6), and so
 * shows some; its timestamp is that of the first of them. An end packet has a buffer of its own. The first
 * buffer of a stream may begin with the signature. */
#define GST_FBS_GROUP_CAPS \
  GST_FBS_MEDIA_TYPE ", stream-format = (string) byte-stream, alignment = (string) group"

/** Sets the caps of a source pad, of alignment "group", unless it has them. */
void gst_fbs_set_format(GstPad* pad, const fbs_format* format);

/** The bytes of a signature at the beginning of a buffer: 4 or 0. */
gsize gst_fbs_signature_at(const guint8* data, gsize size);

static inline GstClockTime gst_fbs_ticks_to_time(guint64 ticks) {
  return gst_util_uint64_scale_round(ticks, GST_SECOND, FBS_TICKS_PER_SECOND);
}

G_END_DECLS

#endif
