#include "encoder_stream.h"

#include "caps.h"

void gst_fbs_group_free(GstFbsGroup* group) {
  g_byte_array_unref(group->bytes);
  g_free(group);
}

static void close_encoder(GstFbsEncoderStream* stream) {
  fbs_encoder_close(&stream->encoder);
  g_clear_pointer(&stream->group, gst_fbs_group_free);
}

void gst_fbs_encoder_stream_close(GstFbsEncoderStream* stream) {
  close_encoder(stream);
  g_queue_clear_full(&stream->ready, (GDestroyNotify)gst_fbs_group_free);
  stream->before = (GstFbsRejoin){0, 0, GST_FBS_FIRST_CHECK};
  stream->pictures = stream->time = 0;
}

guint64 gst_fbs_encoder_stream_pictures(const GstFbsEncoderStream* stream) {
  return stream->before.pictures + stream->pictures;
}

guint64 gst_fbs_encoder_stream_time(const GstFbsEncoderStream* stream) {
  return stream->before.time + stream->time;
}

fbs_status gst_fbs_encoder_stream_open(GstFbsEncoderStream* stream, const fbs_encoder_settings* settings) {
  const GstFbsRejoin before = {gst_fbs_encoder_stream_pictures(stream), gst_fbs_encoder_stream_time(stream),
                               GST_FBS_FIRST_CHECK};
  close_encoder(stream);
  stream->before = before;
  stream->pictures = stream->time = 0;
  stream->nominal = (guint32)gst_util_uint64_scale_round(
      FBS_TICKS_PER_SECOND, settings->format.frame_rate_den, settings->format.frame_rate_num);
  return fbs_encoder_open(&stream->encoder, settings);
}

/* Whether pictures are shown once the packet has arrived: SPEC 6. */
static gboolean releases(const GstFbsEncoderStream* stream, guint8 type) {
  return type == (stream->patterns > 1 ? GST_FBS_BLEND : GST_FBS_MOTION);
}

static GstFbsGroup* open_group(GstFbsEncoderStream* stream) {
  if (stream->group == NULL) {
    stream->group = g_new0(GstFbsGroup, 1);
    stream->group->bytes = g_byte_array_new();
  }
  return stream->group;
}

static void take_packet(GstFbsEncoderStream* stream, const fbs_packet* packet) {
  const gsize signature = gst_fbs_signature_at(packet->data, packet->size);
  GstFbsPacket view;
  GstFbsSetup setup;
  if (gst_fbs_packet_scan(packet->data + signature, packet->size - signature, &view, NULL) !=
      GST_FBS_SCAN_PACKET)
    return; /* the encoder gives out whole packets */
  GstFbsGroup* const group = open_group(stream);
  if (view.type == GST_FBS_SETUP && gst_fbs_setup_parse(view.payload, view.payload_size, &setup)) {
    stream->patterns = setup.patterns;
    group->key = TRUE;
  }
  gst_fbs_rejoin_append(&stream->before, packet->data, packet->size, group->bytes);
  group->end = view.type == GST_FBS_END;
  if (group->end || releases(stream, view.type)) {
    group->number = stream->before.pictures + packet->number;
    g_queue_push_tail(&stream->ready, g_steal_pointer(&stream->group));
  }
}

static void pull(GstFbsEncoderStream* stream, gboolean with_end) {
  fbs_packet packet;
  while (fbs_encoder_pull(stream->encoder, &packet) == FBS_OK)
    if (with_end || packet.data[0] != GST_FBS_END) take_packet(stream, &packet);
}

fbs_status gst_fbs_encoder_stream_push(GstFbsEncoderStream* stream, const fbs_const_picture* picture,
                                       guint64 end) {
  const guint64 now = gst_fbs_encoder_stream_time(stream);
  const guint64 longest = 60 * (guint64)FBS_TICKS_PER_SECOND;
  const guint64 wanted = CLAMP(end, now + 1, now + longest) - now;
  const guint64 off = MAX(wanted, stream->nominal) - MIN(wanted, stream->nominal);
  const guint32 duration = 2 * off <= stream->nominal ? stream->nominal : (guint32)wanted;
  const fbs_status status = fbs_encoder_push(stream->encoder, picture, duration);
  if (status != FBS_OK) return status;
  ++stream->pictures;
  stream->time += duration;
  pull(stream, TRUE);
  return FBS_OK;
}

fbs_status gst_fbs_encoder_stream_finish(GstFbsEncoderStream* stream, gboolean goes_on) {
  if (stream->encoder == NULL || stream->pictures == 0) return FBS_OK;
  const fbs_status status = fbs_encoder_finish(stream->encoder);
  pull(stream, !goes_on);
  return status;
}
