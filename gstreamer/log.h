/* The log of the library in GStreamer's. */
#ifndef FBS_GSTREAMER_LOG_H
#define FBS_GSTREAMER_LOG_H

#include <fbs/fbs.h>
#include <gst/gst.h>

G_BEGIN_DECLS

/** An error is told of by the element itself.
 * @param level  fbs_log_level */
static inline GstDebugLevel gst_fbs_debug_level(int level) {
  return level <= FBS_LOG_WARNING ? GST_LEVEL_WARNING
         : level == FBS_LOG_INFO  ? GST_LEVEL_INFO
                                  : GST_LEVEL_LOG;
}

G_END_DECLS

#endif
