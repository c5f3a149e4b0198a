#include "caps.h"

#include <string.h>

GstCaps* gst_fbs_caps_of_setup(const GstFbsSetup* setup) {
  GstCaps* const caps = gst_caps_from_string(GST_FBS_GROUP_CAPS);
  gst_caps_set_simple(caps, "width", G_TYPE_INT, (gint)MIN(setup->width, FBS_MAX_SIDE), "height", G_TYPE_INT,
                      (gint)MIN(setup->height, FBS_MAX_SIDE), NULL);
  if (setup->rate_num > 0 && setup->rate_num <= G_MAXINT && setup->rate_den > 0 &&
      setup->rate_den <= G_MAXINT)
    gst_caps_set_simple(caps, "framerate", GST_TYPE_FRACTION, (gint)setup->rate_num, (gint)setup->rate_den,
                        NULL);
  if (setup->aspect_num > 0 && setup->aspect_num <= G_MAXINT && setup->aspect_den > 0 &&
      setup->aspect_den <= G_MAXINT)
    gst_caps_set_simple(caps, "pixel-aspect-ratio", GST_TYPE_FRACTION, (gint)setup->aspect_num,
                        (gint)setup->aspect_den, NULL);
  return caps;
}

gsize gst_fbs_signature_at(const guint8* data, gsize size) {
  const gboolean has =
      size >= GST_FBS_SIGNATURE_SIZE && memcmp(data, GST_FBS_SIGNATURE, GST_FBS_SIGNATURE_SIZE) == 0;
  return has ? GST_FBS_SIGNATURE_SIZE : 0;
}
