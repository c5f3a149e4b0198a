#include "statistics.h"

#include <gst/video/video.h>
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
  out->heard = s->heard;
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

static void print_count(int width, guint64 now, guint64 before) {
  printf(" %*" G_GUINT64_FORMAT, width, now - before);
}

static void print_seconds(GstClockTime now, GstClockTime before) {
  printf(" %6.2f", (double)(now - before) / GST_SECOND);
}

static void print_sent(const Counts* now, const Counts* before, double seconds) {
  guint64 all = 0;
  for (guint k = 0; k < SENT_KINDS; ++k) {
    const guint64 bytes = now->sent[k] - before->sent[k];
    printf(" %6.1f", (double)bytes * 8 / 1000 / seconds);
    all += bytes;
  }
  const guint64 packets = now->packets - before->packets, dropped = now->dropped - before->dropped;
  printf(" %6.1f %5.1f", (double)all * 8 / 1000 / seconds,
         packets > 0 ? 100.0 * (double)dropped / (double)packets : 0);
}

/* In the order of the columns. */
static void print_counts(const Counts* now, const Counts* before, double seconds) {
  print_sent(now, before, seconds);
  print_count(7, now->missing, before->missing);
  print_count(8, now->repaired, before->repaired);
  print_count(6, now->requests, before->requests);
  print_count(5, now->heard, before->heard);
  print_count(5, now->scenes, before->scenes);
  print_count(6, now->shown, before->shown);
  print_count(7, now->freezes, before->freezes);
  print_seconds(now->frozen, before->frozen);
  print_count(6, now->breaks, before->breaks);
  print_seconds(now->broken, before->broken);
}

static void print_head(void) {
  puts(
      "                 sent, kbit/s         lost      packets           scenes            pictures          "
      " voice"
      "   delay, ms  trip   rate");
  puts(
      "   s  faces  voice repair   rtcp    all     % missing repaired  asked heard given  shown freezes      "
      "s"
      " breaks      s  face voice    ms kbit/s");
}

static void print_delays(Statistics* s) {
  g_mutex_lock(&s->receiver->lock);
  printf(" %5d %5d", (int)(s->receiver->pictures.delay / (GstClockTimeDiff)GST_MSECOND),
         (int)(s->receiver->voice.delay / (GstClockTimeDiff)GST_MSECOND));
  g_mutex_unlock(&s->receiver->lock);
}

static void print_link(Rate* rate) {
  guint bitrate = 0;
  g_object_get(rate->encoder, "bitrate", &bitrate, NULL);
  g_mutex_lock(&rate->lock);
  printf(" %5.0f %6.1f\n", 1000 * rate->round_trip, bitrate / 1000.0);
  g_mutex_unlock(&rate->lock);
  fflush(stdout);
}

void statistics_print(Statistics* s) {
  const Counts now = counts_of(s);
  if (s->seconds % 20 == 0) print_head();
  printf("%4u", ++s->seconds);
  print_counts(&now, &s->before, 1);
  print_delays(s);
  print_link(s->rate);
  s->before = now;
}

void statistics_print_total(Statistics* s) {
  const Counts now = counts_of(s), none = {0};
  if (s->seconds == 0) return;
  printf(" all");
  print_counts(&now, &none, s->seconds);
  print_delays(s);
  print_link(s->rate);
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

static GstPadProbeReturn on_heard(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Statistics* const s = user;
  (void)pad;
  if (!gst_video_event_is_force_key_unit(gst_pad_probe_info_get_event(info))) return GST_PAD_PROBE_OK;
  g_mutex_lock(&s->lock);
  ++s->heard;
  g_mutex_unlock(&s->lock);
  return GST_PAD_PROBE_OK;
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

void statistics_init(Statistics* s, GstElement* pipeline, Network* network, Rate* rate, Receiver* receiver) {
  *s = (Statistics){
      .pipeline = gst_object_ref(pipeline), .network = network, .rate = rate, .receiver = receiver};
  g_mutex_init(&s->lock);
  GstElement* const rtp = gst_bin_get_by_name(GST_BIN(pipeline), "rtp");
  g_signal_connect(rtp, "new-jitterbuffer", G_CALLBACK(on_jitter_buffer), s);
  gst_object_unref(rtp);
  GstElement* const encoder = gst_bin_get_by_name(GST_BIN(pipeline), "encoder");
  GstPad* const pad = gst_element_get_static_pad(encoder, "src");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_group, s, NULL);
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_EVENT_UPSTREAM, on_heard, s, NULL);
  gst_object_unref(pad);
  gst_object_unref(encoder);
}

void statistics_clear(Statistics* s) {
  g_list_free_full(s->jitter_buffers, gst_object_unref);
  gst_object_unref(s->pipeline);
  g_mutex_clear(&s->lock);
}
