/* The plugin "fbs": elements over include/fbs. */
#include "caps.h"
#include "elements.h"

static void find_type(GstTypeFind* find, gpointer unused) {
  const guint8* const data = gst_type_find_peek(find, 0, FBS_SIGNATURE_SIZE);
  (void)unused;
  if (data != NULL && gst_fbs_signature_at(data, FBS_SIGNATURE_SIZE) > 0)
    gst_type_find_suggest_simple(find, GST_TYPE_FIND_MAXIMUM, GST_FBS_MEDIA_TYPE, NULL, NULL);
}

gboolean gst_fbs_type_find_register(GstPlugin* plugin) {
  GstCaps* const caps = gst_caps_new_empty_simple(GST_FBS_MEDIA_TYPE);
  const gboolean done = gst_type_find_register(plugin, GST_FBS_MEDIA_TYPE, GST_RANK_PRIMARY, find_type, "fbs",
                                               caps, NULL, NULL);
  gst_caps_unref(caps);
  return done;
}

static gboolean plugin_init(GstPlugin* plugin) {
  gboolean done = gst_fbs_type_find_register(plugin);
#ifdef GST_FBS_HAS_ENCODER
  done |= GST_ELEMENT_REGISTER(fbsenc, plugin);
#endif
  done |= GST_ELEMENT_REGISTER(fbsdec, plugin);
  done |= GST_ELEMENT_REGISTER(fbsparse, plugin);
  done |= GST_ELEMENT_REGISTER(rtpfbspay, plugin);
  done |= GST_ELEMENT_REGISTER(rtpfbsdepay, plugin);
  return done;
}

GST_PLUGIN_DEFINE(GST_VERSION_MAJOR, GST_VERSION_MINOR, fbs, "fbs, a video codec for talking heads",
                  plugin_init, GST_FBS_VERSION, "MIT/X11", "fbs", "Unknown package origin")
