#include "receiver.h"

#include <gst/video/video.h>

#define LONGER (150 * GST_MSECOND) /* a picture this much late is a freeze, as in WebRTC's statistics */

/* ---- when a packet was recorded: the jitter buffer knows from the sender's reports ---- */

static GstPadProbeReturn on_packet(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Stream* const stream = user;
  GstBuffer* const packet = gst_pad_probe_info_get_buffer(info);
  const GstReferenceTimestampMeta* const meta = gst_buffer_get_reference_timestamp_meta(packet, NULL);
  (void)pad;
  if (meta == NULL || !GST_BUFFER_PTS_IS_VALID(packet)) return GST_PAD_PROBE_OK;
  g_mutex_lock(&stream->receiver->lock);
  const guint at = stream->packets++ % RECEIVER_TIMES;
  stream->times[at].pts = GST_BUFFER_PTS(packet);
  stream->times[at].offset = GST_CLOCK_DIFF(GST_BUFFER_PTS(packet), meta->timestamp);
  g_mutex_unlock(&stream->receiver->lock);
  return GST_PAD_PROBE_OK;
}

/* @return 0: unknown */
static GstClockTime recorded_at(const Stream* stream, GstClockTime pts) {
  const guint known = MIN(stream->packets, RECEIVER_TIMES);
  for (guint k = 1; k <= known; ++k) {
    const guint at = (stream->packets - k) % RECEIVER_TIMES;
    if (stream->times[at].pts <= pts) return (GstClockTime)((GstClockTimeDiff)pts + stream->times[at].offset);
  }
  return 0;
}

/* ---- what is shown ---- */

static void count(Stream* stream, GstClockTime now, GstClockTime duration) {
  if (GST_CLOCK_TIME_IS_VALID(stream->last)) {
    const GstClockTime since = now - stream->last;
    const GstClockTime usual = GST_CLOCK_TIME_IS_VALID(duration) ? duration : 40 * GST_MSECOND;
    if (stream == &stream->receiver->pictures && since > MAX(3 * usual, usual + LONGER)) {
      ++stream->freezes;
      stream->frozen += since;
    }
  } else {
    stream->first = now;
  }
  stream->last = now;
  ++stream->shown;
}

static void write_samples(FILE* file, GstBuffer* buffer) {
  GstMapInfo map;
  if (!gst_buffer_map(buffer, &map, GST_MAP_READ)) return;
  fwrite(map.data, 1, map.size, file);
  gst_buffer_unmap(buffer, &map);
}

static void on_shown(GstElement* sink, GstBuffer* buffer, GstPad* pad, gpointer user) {
  Stream* const stream = user;
  Receiver* const receiver = stream->receiver;
  (void)sink;
  (void)pad;
  const GstClockTime now = (GstClockTime)g_get_monotonic_time() * 1000;
  g_mutex_lock(&receiver->lock);
  const GstClockTime recorded = recorded_at(stream, GST_BUFFER_PTS(buffer));
  count(stream, now, GST_BUFFER_DURATION(buffer));
  stream->delay = recorded > 0 ? GST_CLOCK_DIFF(recorded, now) : 0;
  if (receiver->times != NULL)
    fprintf(receiver->times, "%s,%" G_GUINT64_FORMAT ",%" G_GUINT64_FORMAT ",%zu\n",
            stream == &receiver->pictures ? "picture" : "voice", now, recorded, gst_buffer_get_size(buffer));
  g_mutex_unlock(&receiver->lock);
  if (stream->record != NULL) write_samples(stream->record, buffer);
}

/* The first picture and the first sound that are sent: with them what the other end records finds its source.
 */
static GstPadProbeReturn on_sent(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Stream* const stream = user;
  GstElement* const element = gst_pad_get_parent_element(pad);
  GstBuffer* const buffer = gst_pad_probe_info_get_buffer(info);
  g_mutex_lock(&stream->receiver->lock);
  fprintf(stream->receiver->times, "sent %s,%" G_GUINT64_FORMAT ",%" G_GUINT64_FORMAT ",%zu\n",
          stream == &stream->receiver->pictures ? "picture" : "voice", (guint64)g_get_monotonic_time() * 1000,
          (guint64)gst_element_get_base_time(element), gst_buffer_get_size(buffer));
  g_mutex_unlock(&stream->receiver->lock);
  gst_object_unref(element);
  return GST_PAD_PROBE_REMOVE;
}

static GstPadProbeReturn on_request(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Receiver* const receiver = user;
  (void)pad;
  if (!gst_video_event_is_force_key_unit(gst_pad_probe_info_get_event(info))) return GST_PAD_PROBE_OK;
  g_mutex_lock(&receiver->lock);
  ++receiver->requests;
  g_mutex_unlock(&receiver->lock);
  return GST_PAD_PROBE_OK;
}

/* ---- life ---- */

/* Counts losses of the voice; the decoder conceals them, or finds the data in the next packet. */
static GstPadProbeReturn on_lost(GstPad* pad, GstPadProbeInfo* info, gpointer user) {
  Stream* const stream = user;
  const GstStructure* const lost = gst_event_get_structure(gst_pad_probe_info_get_event(info));
  guint64 begin = 0, duration = 0;
  (void)pad;
  if (lost == NULL || !gst_structure_has_name(lost, "GstRTPPacketLost") ||
      !gst_structure_get_uint64(lost, "timestamp", &begin) ||
      !gst_structure_get_uint64(lost, "duration", &duration))
    return GST_PAD_PROBE_OK;
  g_mutex_lock(&stream->receiver->lock);
  if (stream->freezes == 0 || begin > stream->lost_until + 5 * GST_MSECOND) ++stream->freezes;
  stream->lost_until = begin + duration;
  stream->frozen += duration;
  g_mutex_unlock(&stream->receiver->lock);
  return GST_PAD_PROBE_OK;
}

static void watch(GstElement* pipeline, const char* from, const char* to, Stream* stream) {
  GstElement* const depay = gst_bin_get_by_name(GST_BIN(pipeline), from);
  GstElement* const sink = gst_bin_get_by_name(GST_BIN(pipeline), to);
  GstPad* const pad = gst_element_get_static_pad(depay, "sink");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_packet, stream, NULL);
  if (stream == &stream->receiver->pictures)
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_EVENT_UPSTREAM, on_request, stream->receiver, NULL);
  else
    gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_EVENT_DOWNSTREAM, on_lost, stream, NULL);
  g_signal_connect(sink, "handoff", G_CALLBACK(on_shown), stream);
  gst_object_unref(pad);
  gst_object_unref(sink);
  gst_object_unref(depay);
}

static void watch_sent(GstElement* pipeline, const char* name, Stream* stream) {
  GstElement* const encoder = gst_bin_get_by_name(GST_BIN(pipeline), name);
  GstPad* const pad = gst_element_get_static_pad(encoder, "sink");
  gst_pad_add_probe(pad, GST_PAD_PROBE_TYPE_BUFFER, on_sent, stream, NULL);
  gst_object_unref(pad);
  gst_object_unref(encoder);
}

static gboolean open_record(const char* prefix, const char* suffix, FILE** out) {
  char* const name = g_strconcat(prefix, suffix, NULL);
  *out = fopen(name, "wb");
  if (*out == NULL) fprintf(stderr, "call: cannot write %s\n", name);
  g_free(name);
  return *out != NULL;
}

gboolean receiver_init(Receiver* receiver, GstElement* pipeline, const char* record) {
  *receiver = (Receiver){0};
  g_mutex_init(&receiver->lock);
  Stream* const streams[] = {&receiver->pictures, &receiver->voice};
  for (guint k = 0; k < G_N_ELEMENTS(streams); ++k) {
    streams[k]->receiver = receiver;
    streams[k]->first = streams[k]->last = GST_CLOCK_TIME_NONE;
  }
  watch(pipeline, "picture_in", "screen", &receiver->pictures);
  watch(pipeline, "voice_in", "ear", &receiver->voice);
  if (record == NULL) return TRUE;
  if (!open_record(record, ".csv", &receiver->times) ||
      !open_record(record, ".yuv", &receiver->pictures.record) ||
      !open_record(record, ".pcm", &receiver->voice.record))
    return FALSE;
  watch_sent(pipeline, "encoder", &receiver->pictures);
  watch_sent(pipeline, "voice_encoder", &receiver->voice);
  return TRUE;
}

void receiver_clear(Receiver* receiver) {
  FILE* const files[] = {receiver->times, receiver->pictures.record, receiver->voice.record};
  for (guint k = 0; k < G_N_ELEMENTS(files); ++k)
    if (files[k] != NULL) fclose(files[k]);
  g_mutex_clear(&receiver->lock);
}
