#include "retransmission.h"

#include "pipeline.h"

#define USUAL_JITTER 60 /* ms */
#define DELAY "call-rtx-delay"

static void expose(GstElement* bin, GstElement* element, const char* pad_name, guint session) {
  char* const name = g_strdup_printf("%s_%u", pad_name, session);
  GstPad* const pad = gst_element_get_static_pad(element, pad_name);
  gst_element_add_pad(bin, gst_ghost_pad_new(name, pad));
  gst_object_unref(pad);
  g_free(name);
}

/* rtpbin takes a bin whose pads have the session's number. */
static GstElement* retransmission(const char* factory, guint session) {
  GstElement* const bin = gst_bin_new(NULL);
  GstElement* const element = gst_element_factory_make(factory, NULL);
  char* const sent = g_strdup_printf("%u", PAYLOAD_PICTURES + session);
  GstStructure* const map = gst_structure_new("types", sent, G_TYPE_UINT, (guint)PAYLOAD_RTX + session, NULL);
  g_object_set(element, "payload-type-map", map, NULL);
  gst_structure_free(map);
  g_free(sent);
  gst_bin_add(GST_BIN(bin), element);
  expose(bin, element, "sink", session);
  expose(bin, element, "src", session);
  return bin;
}

static GstElement* on_aux_sender(GstElement* rtp, guint session, gpointer user) {
  (void)rtp;
  (void)user;
  return retransmission("rtprtxsend", session);
}

static GstElement* on_aux_receiver(GstElement* rtp, guint session, gpointer user) {
  (void)rtp;
  (void)user;
  return retransmission("rtprtxreceive", session);
}

/* Neither late packets nor those whose copies are on their way are requested. */
static void on_jitter_buffer(GstElement* rtp, GstElement* buffer, guint session, guint source,
                             gpointer user) {
  const CallOptions* const options = user;
  const gboolean copied = session == SESSION_PICTURES && (options->repair & REPAIR_COPY) != 0;
  (void)rtp;
  (void)source;
  const guint delay = USUAL_JITTER + (copied ? COPY_DELAY : 0);
  g_object_set(buffer, "rtx-min-delay", delay, NULL);
  g_object_set_data(G_OBJECT(buffer), DELAY, GUINT_TO_POINTER(delay));
}

static void add_wait(const GValue* buffer, gpointer queue) {
  GObject* const object = g_value_get_object(buffer);
  const guint delay = GPOINTER_TO_UINT(g_object_get_data(object, DELAY));
  g_object_set(object, "rtx-min-delay", delay + (guint)(1000 * *(const gdouble*)queue), NULL);
}

void retransmission_wait(GstElement* rtp, gdouble queue) {
  GstIterator* const buffers = gst_bin_iterate_all_by_element_factory_name(GST_BIN(rtp), "rtpjitterbuffer");
  while (gst_iterator_foreach(buffers, add_wait, &queue) == GST_ITERATOR_RESYNC) gst_iterator_resync(buffers);
  gst_iterator_free(buffers);
}

void retransmission_connect(GstElement* rtp, const CallOptions* options) {
  g_object_set(rtp, "do-retransmission", TRUE, NULL);
  g_signal_connect(rtp, "request-aux-sender", G_CALLBACK(on_aux_sender), NULL);
  g_signal_connect(rtp, "request-aux-receiver", G_CALLBACK(on_aux_receiver), NULL);
  g_signal_connect(rtp, "new-jitterbuffer", G_CALLBACK(on_jitter_buffer), (gpointer)options);
}
