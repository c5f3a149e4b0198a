#include "encoder_stream.h"

#include "caps.h"

void gst_fbs_group_free(GstFbsGroup* group) {
  g_byte_array_unref(group->bytes);
  g_free(group);
}

void gst_fbs_encoder_stream_close(GstFbsEncoderStream* stream) {
  fbs_encoder_close(&stream->encoder);
  g_clear_pointer(&stream->group, gst_fbs_group_free);
  g_queue_clear_full(&stream->ready, (GDestroyNotify)gst_fbs_group_free);
  stream->pictures = stream->time = 0;
}

fbs_status gst_fbs_encoder_stream_open(GstFbsEncoderStream* stream, const fbs_encoder_settings* settings) {
  gst_fbs_encoder_stream_close(stream);
  stream->nominal = (guint32)gst_util_uint64_scale_round(
      FBS_TICKS_PER_SECOND, settings->format.frame_rate_den, settings->format.frame_rate_num);
  return fbs_encoder_open(&stream->encoder, settings);
}

static GstFbsGroup* open_group(GstFbsEncoderStream* stream) {
  if (stream->group == NULL) {
    stream->group = g_new0(GstFbsGroup, 1);
    stream->group->bytes = g_byte_array_new();
  }
  return stream->group;
}

static void take_packet(GstFbsEncoderStream* stream, const fbs_packet* packet) {
  GstFbsGroup* const group = open_group(stream);
  group->key = group->key || packet->key;
  group->end = packet->type == FBS_PACKET_END;
  g_byte_array_append(group->bytes, packet->data, (guint)packet->size);
  if (!group->end && packet->pictures == 0) return;
  group->number = packet->number;
  g_queue_push_tail(&stream->ready, g_steal_pointer(&stream->group));
}

static void pull(GstFbsEncoderStream* stream) {
  fbs_packet packet;
  while (fbs_encoder_pull(stream->encoder, &packet) == FBS_OK) take_packet(stream, &packet);
}

fbs_status gst_fbs_encoder_stream_push(GstFbsEncoderStream* stream, const fbs_const_picture* picture,
                                       guint64 end) {
  const guint64 now = stream->time;
  const guint64 longest = 60 * (guint64)FBS_TICKS_PER_SECOND;
  const guint64 wanted = CLAMP(end, now + 1, now + longest) - now;
  const guint64 off = MAX(wanted, stream->nominal) - MIN(wanted, stream->nominal);
  const guint32 duration = 2 * off <= stream->nominal ? stream->nominal : (guint32)wanted;
  const fbs_status status = fbs_encoder_push(stream->encoder, picture, duration);
  if (status != FBS_OK) return status;
  ++stream->pictures;
  stream->time += duration;
  pull(stream);
  return FBS_OK;
}

fbs_status gst_fbs_encoder_stream_finish(GstFbsEncoderStream* stream) {
  if (stream->encoder == NULL || stream->pictures == 0) return FBS_OK;
  const fbs_status status = fbs_encoder_finish(stream->encoder);
  pull(stream);
  return status;
}
