#include "statistics.h"

#include <stdio.h>

/* ---- counts ---- */

static guint64 field(const GstStructure* stats, const char* name) {
  guint64 value = 0;
  gst_structure_get_uint64(stats, name, &value);
  return value;
}

static void add_jitter_buffers(Statistics* s, Counts* out) {
  g_mutex_lock(&s->lock);
  for (GList* at = s->jitter_buffers; at != NULL; at = at->next) {
    GstStructure* stats = NULL;
    g_object_get(at->data, "stats", &stats, NULL);
    out->missing += field(stats, "num-lost");
    out->repaired += field(stats, "rtx-success-count");
    gst_structure_free(stats);
  }
  out->scenes = s->scenes;
  g_mutex_unlock(&s->lock);
}

static Counts counts_of(Statistics* s) {
  Counts out = {0};
  g_mutex_lock(&s->network->lock);
  for (guint k = 0; k < SENT_KINDS; ++k) out.sent[k] = s->network->bytes[k];
  out.packets = s->network->packets;
  out.dropped = s->network->lost;
  g_mutex_unlock(&s->network->lock);
  g_mutex_lock(&s->receiver->lock);
  out.shown = s->receiver->pictures.shown;
  out.freezes = s->receiver->pictures.freezes;
  out.frozen = s->receiver->pictures.frozen;
  out.breaks = s->receiver->voice.freezes;
  out.broken = s->receiver->voice.frozen;
  out.requests = s->receiver->requests;
  g_mutex_unlock(&s->receiver->lock);
  add_jitter_buffers(s, &out);
  return out;
}

/* ---- lines ---- */

/* In the same order as the columns. */
static void print_counts(const Counts* now, const Counts* before, double seconds) {
  guint64 bytes = 0;
  for (guint k = 0; k < SENT_KINDS; ++k) {
    const guint64 sent = now->sent[k] - before->sent[k];
    printf("%7.1f", (double)sent * 8 / 1000 / seconds);
    bytes += sent;
  }
  const guint64 packets = now->packets - before->packets;
  printf("%7.1f %5.1f", (double)bytes * 8 / 1000 / seconds,
         packets > 0 ? 100.0 * (double)(now->dropped - before->dropped) / (double)packets : 0);
  printf(" %7" G_GUINT64_FORMAT " %8" G_GUINT64_FORMAT, now->missing - before->missing,
         now->repaired - before->repaired);
  printf(" %5" G_GUINT64_FORMAT " %6" G_GUINT64_FORMAT " %8" G_GUINT64_FORMAT " %7" G_GUINT64_FORMAT " %6.2f",
         now->requests - before->requests, now->scenes - before->scenes, now->shown - before->shown,
         now->freezes - before->freezes, (double)(now->frozen - before->frozen) / GST_SECOND);
  printf(" %6" G_GUINT64_FORMAT " %6.2f", now->breaks - before->breaks,
         (double)(now->broken - before->broken) / GST_SECOND);
}

static void print_head(void) {
  puts(
      "                 sent, kbit/s         lost      packets         scenes         pictures         voice "
      "     delay, ms");
  puts(
      "   s  faces  voice repair   rtcp    all     % missing repaired asked  given    shown freezes      s "
      "breaks      s    face voice");
}

static void print_delays(Statistics* s) {
  g_mutex_lock(&s->receiver->lock);
  printf(" %7d %5d\n", (int)(s->receiver->pictures.delay / (GstClockTimeDiff)GST_MSECOND),
         (int)(s->receiver->voice.delay / (GstClockTimeDiff)GST_MSECOND));
  g_mutex_unlock(&s->receiver->lock);
  fflush(stdout);
}

void statistics_print(Statistics* s) {
  const Counts now = counts_of(s);
  if (s->seconds % 20 == 0) print_head();
  printf("%4u", ++s->seconds);
  print_counts(&now, &s->before, 1);
  print_delays(s);
  s->before = now;
}

void statistics_print_total(Statistics* s) {
  const Counts now = counts_of(s), none = {0};
  if (s->seconds == 0) return;
  printf(" all");
  print_counts(&now, &none, s->seconds);
  print_delays(s);
}

/* ---- life ---- */

static void on_jitter_buffer(GstElement* rtp, GstElement* buffer, guint session, guint source,
                             gpointer user) {
  Statistics* const s = user;
  (void)rtp;
  (void)session;
  (void)source;
  g_mutex_lock(&s->lock);
  s->jitter_buffers = g_list_prepend(s->jitter_buffers, gst_object_ref(buffer));
  g_mutex_unlock(&s->lock);
}

static GstPadProbeReturn on_group(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Statistics* const s = user;
  (void)pad;
  if (GST_BUFFER_FLAG_IS_SET(gst_pad_probe_info_get_buffer(info), GST_BUFFER_FLAG_DELTA_UNIT))
    return GST_PAD_PROBE_OK;
  g_mutex_lock(&s->lock);
  ++s->scenes;
  g_mutex_unlock(&s->lock);
  return GST_PAD_PROBE_OK;
}

void statistics_init(Statistics* s, GstElement* pipeline, Network* network, Receiver* receiver) {
  *s = (Statistics){.pipeline = gst_object_ref(pipeline), .network = network, .receiver = receiver};
  g_mutex_init(&s->lock);
  GstElement* const rtp = gst_bin_get_by_name(GST_BIN(pipeline), "rtp");
  g_signal_connect(rtp, "new-jitterbuffer", G_CALLBACK(on_jitter_buffer), s);
  gst_object_unref(rtp);
  GstElement* const encoder = gst_bin_get_by_name(GST_BIN(pipeline), "encoder");
  GstPad* const pad = gst_element_get_static_pad(encoder, "src");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_group, s, NULL);
  gst_object_unref(pad);
  gst_object_unref(encoder);
}

void statistics_clear(Statistics* s) {
  g_list_free_full(s->jitter_buffers, gst_object_unref);
  gst_object_unref(s->pipeline);
  g_mutex_clear(&s->lock);
}
