#include "rate.h"

#include <math.h>

#include "pipeline.h"
#include "retransmission.h"

/* ---- what to do about a report ---- */

#define MEAN 4.0      /* s: enough of the voice's packets to know 10 % of loss to 2 % */
#define LONGER 0.005  /* s a second: how fast a longer way is learnt */
#define QUEUE 0.2     /* s: more than jitter, less than the jitter buffer holds */
#define FALLING 0.05  /* s a second: the queue empties, so wait */
#define DECREASE 0.8  /* share for each second of the queue */
#define MOST 0.5      /* share: the most at once */
#define INCREASE 0.04 /* share of the maximum a second */
#define LOSSY 0.1     /* share of packets: below, retransmission makes up for them */
#define CAUTION 2.5   /* share of `max` given up for each share of packets lost */

gdouble rate_control_report(RateControl* c, gdouble loss, gdouble round_trip, gdouble sent, gdouble elapsed) {
  const gdouble weight = c->base > 0 ? 1 - exp(-elapsed / MEAN) : 1;
  c->loss += (loss - c->loss) * weight;
  c->sent += (sent - c->sent) * weight;
  c->base = c->base > 0 ? fmin(round_trip, c->base + LONGER * elapsed) : round_trip;
  const gdouble queue = round_trip - c->base, growth = queue - c->queue;
  const gdouble ceiling = c->max * (1 - CAUTION * c->loss);
  c->queue = queue;
  if (queue > QUEUE) {
    if (growth > -FALLING * elapsed) c->rate = fmin(c->rate, c->sent) * fmax(1 - DECREASE * queue, 1 - MOST);
  } else if (c->rate < ceiling) {
    c->rate = fmin(ceiling, c->rate + INCREASE * c->max * elapsed);
  } else if (c->loss > LOSSY) {
    c->rate = fmax(ceiling, c->rate * (1 - c->loss / 2));
  }
  return c->rate = CLAMP(c->rate, c->min, c->max);
}

/* ---- reports ---- */

static void set_bitrate(GstElement* encoder, gpointer bitrate) {
  g_object_set(encoder, "bitrate", GPOINTER_TO_UINT(bitrate), NULL);
}

/* The encoder takes it when it has coded its picture: nothing else should wait for that. */
static void control(Rate* rate, gdouble loss, gdouble round_trip, gdouble sent, gdouble elapsed) {
  const gdouble bitrate = rate_control_report(&rate->control, loss, round_trip, sent, elapsed);
  if (!rate->follows) return;
  retransmission_wait(rate->rtp, rate->control.queue);
  gst_element_call_async(rate->encoder, set_bitrate, GUINT_TO_POINTER((guint)bitrate), NULL);
}

/* Losses are counted from the totals, since reports may be lost, too. */
static void take_report(Rate* rate, guint answered, guint highest, gint lost, gdouble round_trip) {
  const gint64 now = g_get_monotonic_time();
  const gdouble elapsed = (gdouble)(now - rate->at) / 1e6;
  const guint expected = highest - rate->highest;
  const gdouble loss = (gdouble)(lost - rate->lost) / expected;
  g_mutex_lock(&rate->lock);
  const gdouble sent = 8 * (gdouble)rate->bytes / elapsed;
  rate->bytes = 0;
  rate->round_trip = round_trip;
  g_mutex_unlock(&rate->lock);
  if (rate->at > 0 && expected > 0 && expected < 0x10000)
    control(rate, CLAMP(loss, 0, 1), round_trip, sent, elapsed);
  rate->at = now;
  rate->answered = answered;
  rate->highest = highest;
  rate->lost = lost;
}

/* The voice has ten packets for one of the pictures: its losses are known sooner. A report that answers the
 * same one as before, as those sent with requests do, knows nothing new of the queue. */
static void on_report(GstElement* rtp, guint session, guint source, gpointer user) {
  Rate* const rate = user;
  GObject *object = NULL, *peer = NULL;
  GstStructure* stats = NULL;
  guint answered = 0, highest = 0, round_trip = 0;
  gint lost = 0;
  if (session != SESSION_VOICE) return;
  g_signal_emit_by_name(rtp, "get-internal-session", session, &object);
  g_signal_emit_by_name(object, "get-source-by-ssrc", source, &peer);
  g_object_unref(object);
  if (peer == NULL) return;
  g_object_get(peer, "stats", &stats, NULL);
  g_object_unref(peer);
  if (gst_structure_get(stats, "rb-lsr", G_TYPE_UINT, &answered, "rb-exthighestseq", G_TYPE_UINT, &highest,
                        "rb-packetslost", G_TYPE_INT, &lost, "rb-round-trip", G_TYPE_UINT, &round_trip,
                        NULL) &&
      round_trip > 0 && answered != rate->answered)
    take_report(rate, answered, highest, lost, round_trip / 65536.0);
  gst_structure_free(stats);
}

static GstPadProbeReturn on_group(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Rate* const rate = user;
  (void)pad;
  g_mutex_lock(&rate->lock);
  rate->bytes += gst_buffer_get_size(gst_pad_probe_info_get_buffer(info));
  g_mutex_unlock(&rate->lock);
  return GST_PAD_PROBE_OK;
}

/* ---- life ---- */

void rate_init(Rate* rate, const CallOptions* options, GstElement* pipeline) {
  *rate =
      (Rate){.follows = options->max_bitrate > 0,
             .control = {.min = options->min_bitrate, .max = options->max_bitrate, .rate = options->bitrate}};
  g_mutex_init(&rate->lock);
  rate->encoder = gst_bin_get_by_name(GST_BIN(pipeline), "encoder");
  GstPad* const pad = gst_element_get_static_pad(rate->encoder, "src");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_group, rate, NULL);
  gst_object_unref(pad);
  rate->rtp = gst_bin_get_by_name(GST_BIN(pipeline), "rtp");
  g_signal_connect(rate->rtp, "on-ssrc-active", G_CALLBACK(on_report), rate);
}

void rate_clear(Rate* rate) {
  gst_object_unref(rate->rtp);
  gst_object_unref(rate->encoder);
  g_mutex_clear(&rate->lock);
}
