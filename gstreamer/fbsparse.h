#ifndef FBS_GSTREAMER_FBSPARSE_H
#define FBS_GSTREAMER_FBSPARSE_H

#include <fbs/packet.h>
#include <gst/base/gstbaseparse.h>

G_BEGIN_DECLS

#define GST_TYPE_FBS_PARSE (gst_fbs_parse_get_type())
G_DECLARE_FINAL_TYPE(GstFbsParse, gst_fbs_parse, GST, FBS_PARSE, GstBaseParse)

struct _GstFbsParse {
  GstBaseParse parent;

  fbs_packet_reader* packets; /**< has been fed the first bytes of the next buffer */
  gsize fed;                  /**< so many of them */
  guint64 base;               /**< of the next buffer, where the reader counts its bytes */
  gboolean has_index;         /**< the file has been scanned, or cannot be */
  gboolean timed;             /**< upstream has timestamps */
  gboolean synced;            /**< the next bytes follow what has been parsed */
  gboolean searching;         /**< the reader looks for a packet behind damage */
  gboolean finished;          /**< the reader knows that no more bytes will come */
  gsize scanned;              /**< bytes of the next buffer that are its group so far: whole packets */
  gboolean has_next;          /**< the packet behind the group has been read */
  fbs_packet_info next;
  guint64 offset;     /**< of the next buffer in the file, bytes */
  gboolean has_scene; /**< a setup packet has come */
  gboolean key;       /**< it begins with a setup packet where decoding can begin */
  GstClockTime pts;   /**< of its first picture; or none */
  GstClockTime end;   /**< of the last picture so far */
};

G_END_DECLS

#endif
