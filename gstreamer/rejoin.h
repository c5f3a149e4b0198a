/* Streams of several encoders, one after the other, as one stream: SPEC 6.1. */
#ifndef FBS_GSTREAMER_REJOIN_H
#define FBS_GSTREAMER_REJOIN_H

#include "packet.h"

G_BEGIN_DECLS

/** What has gone before the stream whose packets come next. All zero: nothing, and they stay as they are. */
typedef struct {
  guint64 pictures;
  guint64 time; /**< 1/90000 s */
  guint16 chain;
} GstFbsRejoin;

/** Appends a packet of an encoder to what came before: setup packets and the end packet count the pictures
 * from the first stream's beginning on, and the checks that run on through the scene follow.
 * @param data   a whole packet; before the first of a stream its signature, which is written only if nothing
 *               has gone before
 * @return FALSE: it is no packet; nothing is written */
gboolean gst_fbs_rejoin_append(GstFbsRejoin* rejoin, const guint8* data, gsize size, GByteArray* out);

G_END_DECLS

#endif
