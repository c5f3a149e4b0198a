#include "scene_index.h"

#include "caps.h"

static void add_scene(GArray* scenes, const GstFbsPacket* packet, guint64 offset) {
  GstFbsSetup setup;
  if (!gst_fbs_setup_parse(packet->payload, packet->payload_size, &setup)) return;
  const GstFbsSceneEntry entry = {offset, gst_fbs_ticks_to_time(setup.time_before)};
  if (scenes->len > 0 && g_array_index(scenes, GstFbsSceneEntry, scenes->len - 1).time >= entry.time) return;
  g_array_append_val(scenes, entry);
}

static GArray* scenes_of(const guint8* data, gsize size) {
  GArray* const scenes = g_array_new(FALSE, FALSE, sizeof(GstFbsSceneEntry));
  guint16 chain = GST_FBS_FIRST_CHECK;
  gsize at = gst_fbs_signature_at(data, size);
  while (at < size) {
    GstFbsPacket packet;
    if (gst_fbs_packet_scan(data + at, size - at, &packet, NULL) != GST_FBS_SCAN_PACKET ||
        !gst_fbs_packet_check(&packet, &chain)) {
      ++at;
      at += gst_fbs_find_restart(data + at, size - at);
      continue;
    }
    if (packet.type == GST_FBS_SETUP) add_scene(scenes, &packet, at);
    at += packet.size;
  }
  return scenes;
}

static GstClockTime end_of(const guint8* data, gsize size) {
  GstClockTime end = GST_CLOCK_TIME_NONE;
  fbs_decoder* decoder = NULL;
  fbs_picture_info info;
  fbs_status status;
  if (fbs_decoder_open(&decoder, NULL) != FBS_OK) return end;
  fbs_decoder_reset(decoder); /* its bytes begin with a scene */
  fbs_decoder_feed(decoder, data, size);
  fbs_decoder_finish(decoder);
  while ((status = fbs_decoder_next(decoder, &info)) != FBS_END)
    if (status == FBS_OK) end = gst_fbs_ticks_to_time(info.time + info.duration);
  fbs_decoder_close(&decoder);
  return end;
}

GArray* gst_fbs_scene_index(const guint8* data, gsize size, GstClockTime* duration) {
  GArray* const scenes = scenes_of(data, size);
  *duration = GST_CLOCK_TIME_NONE;
  if (scenes->len > 0) {
    const GstFbsSceneEntry* const last = &g_array_index(scenes, GstFbsSceneEntry, scenes->len - 1);
    *duration = end_of(data + last->offset, size - last->offset);
  }
  return scenes;
}
