/* The elements of the plugin "fbs". */
#ifndef FBS_GSTREAMER_ELEMENTS_H
#define FBS_GSTREAMER_ELEMENTS_H

#include <gst/gst.h>

G_BEGIN_DECLS

GST_ELEMENT_REGISTER_DECLARE(fbsenc);
GST_ELEMENT_REGISTER_DECLARE(fbsdec);
GST_ELEMENT_REGISTER_DECLARE(fbsparse);
GST_ELEMENT_REGISTER_DECLARE(rtpfbspay);
GST_ELEMENT_REGISTER_DECLARE(rtpfbsdepay);

/** Makes `.fbs` files known by their signature. */
gboolean gst_fbs_type_find_register(GstPlugin* plugin);

G_END_DECLS

#endif
