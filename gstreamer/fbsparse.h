#ifndef FBS_GSTREAMER_FBSPARSE_H
#define FBS_GSTREAMER_FBSPARSE_H

#include <fbs/fbs.h>
#include <gst/base/gstbaseparse.h>

#include "packet.h"

G_BEGIN_DECLS

#define GST_TYPE_FBS_PARSE (gst_fbs_parse_get_type())
G_DECLARE_FINAL_TYPE(GstFbsParse, gst_fbs_parse, GST, FBS_PARSE, GstBaseParse)

struct _GstFbsParse {
  GstBaseParse parent;

  fbs_decoder* clock; /**< tells which pictures a packet releases; nothing is drawn */
  gboolean has_index; /**< the file has been scanned, or cannot be */
  gboolean timed;     /**< upstream has timestamps */
  gboolean synced;    /**< the next bytes follow what has been parsed */
  guint16 chain;      /**< check of the last packet */
  gsize scanned;      /**< scanned bytes of the next buffer: whole packets */
  guint64 offset;     /**< of the next buffer in the file, bytes */
  gboolean has_scene; /**< a setup packet has come */
  gboolean key;       /**< it begins with a setup packet */
  GstClockTime pts;   /**< of its first picture; or none */
  GstClockTime end;   /**< of the last picture so far */
};

G_END_DECLS

#endif
