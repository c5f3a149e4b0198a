#include "caps.h"

#include <string.h>

static GstCaps* caps_of(const fbs_format* format) {
  GstCaps* const caps = gst_caps_from_string(GST_FBS_GROUP_CAPS);
  gst_caps_set_simple(caps, "width", G_TYPE_INT, (gint)format->width, "height", G_TYPE_INT,
                      (gint)format->height, NULL);
  if (format->frame_rate_num <= G_MAXINT && format->frame_rate_den <= G_MAXINT)
    gst_caps_set_simple(caps, "framerate", GST_TYPE_FRACTION, (gint)format->frame_rate_num,
                        (gint)format->frame_rate_den, NULL);
  if (format->pixel_aspect_num > 0 && format->pixel_aspect_num <= G_MAXINT &&
      format->pixel_aspect_den <= G_MAXINT)
    gst_caps_set_simple(caps, "pixel-aspect-ratio", GST_TYPE_FRACTION, (gint)format->pixel_aspect_num,
                        (gint)format->pixel_aspect_den, NULL);
  return caps;
}

void gst_fbs_set_format(GstPad* pad, const fbs_format* format) {
  GstCaps* const caps = caps_of(format);
  GstCaps* const current = gst_pad_get_current_caps(pad);
  if (current == NULL || !gst_caps_is_equal(caps, current)) gst_pad_set_caps(pad, caps);
  if (current != NULL) gst_caps_unref(current);
  gst_caps_unref(caps);
}

gsize gst_fbs_signature_at(const guint8* data, gsize size) {
  const gboolean has = size >= FBS_SIGNATURE_SIZE && memcmp(data, FBS_SIGNATURE, FBS_SIGNATURE_SIZE) == 0;
  return has ? FBS_SIGNATURE_SIZE : 0;
}
