#include "network.h"

#include <math.h>

#include "pipeline.h"

#define IP_AND_UDP 28 /* bytes */

/* Gilbert's chain in continuous time: the duration of each state is exponentially distributed, and in the bad
 * one all packets of all streams are lost. */
static gboolean burst_loses(Network* network) {
  const gint64 now = g_get_monotonic_time();
  const gdouble ms = (gdouble)(now - network->changed) / 1000;
  const gdouble bad_rate = 1 / network->burst; /* of leaving the bad state, 1/ms */
  const gdouble good_rate = bad_rate * network->loss / (1 - network->loss); /* of leaving the good one */
  const gdouble decay = exp(-(bad_rate + good_rate) * ms);
  const gdouble bad = network->loss + ((network->bad ? 1 : 0) - network->loss) * decay;
  network->bad = g_rand_double(network->chance) < bad;
  network->changed = now;
  return network->bad;
}

static gboolean loses(Network* network) {
  if (network->loss <= 0) return FALSE;
  if (network->burst > 0) return burst_loses(network);
  return g_rand_double(network->chance) < network->loss;
}

static SentKind kind_of(GstPad* pad, GstBuffer* packet) {
  guint8 type = 0;
  if (g_strcmp0(GST_OBJECT_NAME(GST_OBJECT_PARENT(pad)), "network4") == 0) return SENT_REPAIR;
  gst_buffer_extract(packet, 1, &type, 1);
  if (type >= 192 && type <= 223) return SENT_RTCP; /* RFC 5761 */
  switch (type & 127) {
    case PAYLOAD_PICTURES:
      return SENT_PICTURES;
    case PAYLOAD_VOICE:
      return SENT_VOICE;
    default:
      return SENT_REPAIR;
  }
}

static GstPadProbeReturn on_packet(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Network* const network = user;
  GstBuffer* const packet = gst_pad_probe_info_get_buffer(info);
  g_mutex_lock(&network->lock);
  network->bytes[kind_of(pad, packet)] += gst_buffer_get_size(packet) + IP_AND_UDP;
  ++network->packets;
  const gboolean lost = loses(network);
  network->lost += lost;
  g_mutex_unlock(&network->lock);
  return lost ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
}

void network_init(Network* network, const CallOptions* options, GstElement* pipeline) {
  *network = (Network){.loss = options->loss, .burst = options->burst};
  g_mutex_init(&network->lock);
  network->chance = g_rand_new_with_seed((guint32)options->seed);
  network->changed = g_get_monotonic_time();
  for (guint k = 0; k < 5; ++k) {
    char name[16];
    g_snprintf(name, sizeof name, "network%u", k);
    GstElement* const netsim = gst_bin_get_by_name(GST_BIN(pipeline), name);
    if (netsim == NULL) continue;
    GstPad* const pad = gst_element_get_static_pad(netsim, "src"); /* lists have been taken apart there */
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_packet, network, NULL);
    gst_object_unref(pad);
    gst_object_unref(netsim);
  }
}

void network_clear(Network* network) {
  g_rand_free(network->chance);
  g_mutex_clear(&network->lock);
}
