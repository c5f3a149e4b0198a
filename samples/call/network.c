#include "network.h"

#include <math.h>

#include "pipeline.h"

#define IP_AND_UDP 28 /* bytes */

/* Gilbert's chain in continuous time: the duration of each state is exponentially distributed, and in the bad
 * one all packets of all streams are lost. */
static gboolean burst_loses(Network* network) {
  const gdouble loss = network->options->loss;
  const gint64 now = g_get_monotonic_time();
  const gdouble ms = (gdouble)(now - network->changed) / 1000;
  const gdouble bad_rate = 1 / network->options->burst;   /* of leaving the bad state, 1/ms */
  const gdouble good_rate = bad_rate * loss / (1 - loss); /* of leaving the good one */
  const gdouble decay = exp(-(bad_rate + good_rate) * ms);
  const gdouble bad = loss + ((network->bad ? 1 : 0) - loss) * decay;
  network->bad = g_rand_double(network->chance) < bad;
  network->changed = now;
  return network->bad;
}

static gboolean loses(Network* network) {
  const CallOptions* const o = network->options;
  if (o->loss <= 0) return FALSE;
  if (o->burst > 0) return burst_loses(network);
  return g_rand_double(network->chance) < o->loss;
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

static gdouble capacity_at(const Network* network, gint64 now) {
  const CallOptions* const o = network->options;
  const gdouble part = (gdouble)(now - network->begin) / 1e6 / o->seconds * o->capacities;
  return o->capacity[MIN((guint)part, o->capacities - 1)];
}

/* All packets share one queue. A packet gets the time at which its last bit is on the link.
 * @return FALSE: the queue is too long, and the packet is lost */
static gboolean enqueue(Network* network, GstPadProbeInfo* info, gsize bytes) {
  const gint64 now = g_get_monotonic_time(), start = MAX(now, network->idle);
  if (start - now > network->options->queue * G_GINT64_CONSTANT(1000)) return FALSE;
  network->idle = start + (gint64)((gdouble)bytes * 8000 / capacity_at(network, now));
  GstBuffer* const packet = gst_buffer_make_writable(gst_pad_probe_info_get_buffer(info));
  GST_BUFFER_OFFSET(packet) = (guint64)network->idle;
  info->data = packet;
  return TRUE;
}

static GstPadProbeReturn on_departure(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  const gint64 wait = (gint64)GST_BUFFER_OFFSET(gst_pad_probe_info_get_buffer(info)) - g_get_monotonic_time();
  (void)pad;
  (void)user;
  if (wait > 0) g_usleep((gulong)wait);
  return GST_PAD_PROBE_OK;
}

static GstPadProbeReturn on_packet(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Network* const network = user;
  GstBuffer* const packet = gst_pad_probe_info_get_buffer(info);
  g_mutex_lock(&network->lock);
  const gsize bytes = gst_buffer_get_size(packet) + IP_AND_UDP;
  network->bytes[kind_of(pad, packet)] += bytes;
  ++network->packets;
  const gboolean lost =
      loses(network) || (network->options->capacities > 0 && !enqueue(network, info, bytes));
  network->lost += lost;
  g_mutex_unlock(&network->lock);
  return lost ? GST_PAD_PROBE_DROP : GST_PAD_PROBE_OK;
}

static void watch(GstElement* pipeline, const char* format, guint number, GstPadProbeCallback on_buffer,
                  Network* network) {
  char name[16];
  g_snprintf(name, sizeof name, format, number);
  GstElement* const element = gst_bin_get_by_name(GST_BIN(pipeline), name);
  if (element == NULL) return;
  GstPad* const pad = gst_element_get_static_pad(element, "src"); /* netsim has taken lists apart there */
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_buffer, network, NULL);
  gst_object_unref(pad);
  gst_object_unref(element);
}

void network_init(Network* network, const CallOptions* options, GstElement* pipeline) {
  *network = (Network){.options = options};
  g_mutex_init(&network->lock);
  network->chance = g_rand_new_with_seed((guint32)options->seed);
  network->changed = network->begin = g_get_monotonic_time();
  for (guint k = 0; k < 5; ++k) {
    watch(pipeline, "network%u", k, on_packet, network);
    if (options->capacities > 0) watch(pipeline, "bottleneck%u", k, on_departure, network);
  }
}

void network_clear(Network* network) {
  g_rand_free(network->chance);
  g_mutex_clear(&network->lock);
}
