/**
 * SECTION:element-fbsparse
 * @title: fbsparse
 *
 * Cuts a stream of fbs into groups of packets with timestamps, and finds scenes when a file is sought in.
 *
 * |[
 * gst-launch-1.0 filesrc location=talk.fbs ! fbsparse ! fbsdec ! videoconvert ! autovideosink
 * ]|
 */
#include "fbsparse.h"

#include "caps.h"
#include "elements.h"
#include "scene_index.h"

GST_DEBUG_CATEGORY_STATIC(fbs_parse_debug);
#define GST_CAT_DEFAULT fbs_parse_debug

G_DEFINE_TYPE(GstFbsParse, gst_fbs_parse, GST_TYPE_BASE_PARSE)
GST_ELEMENT_REGISTER_DEFINE(fbsparse, "fbsparse", GST_RANK_PRIMARY + 1, GST_TYPE_FBS_PARSE)

#define SMALLEST_PACKET 4
#define MAX_INDEXED_FILE (256u << 20) /* bytes; hours of the finest quality */

static GstStaticPadTemplate sink_template =
    GST_STATIC_PAD_TEMPLATE("sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS(GST_FBS_MEDIA_TYPE));
static GstStaticPadTemplate src_template =
    GST_STATIC_PAD_TEMPLATE("src", GST_PAD_SRC, GST_PAD_ALWAYS, GST_STATIC_CAPS(GST_FBS_GROUP_CAPS));

/* ---- scenes of a file ---- */

static gboolean index_bytes(GstFbsParse* self, const guint8* data, gsize size) {
  GstBaseParse* const parse = GST_BASE_PARSE(self);
  GstClockTime duration;
  GArray* const scenes = gst_fbs_scene_index(data, size, &duration);
  for (guint k = 0; k < scenes->len; ++k) {
    const GstFbsSceneEntry* const scene = &g_array_index(scenes, GstFbsSceneEntry, k);
    gst_base_parse_add_index_entry(parse, scene->offset, scene->time, TRUE, TRUE);
  }
  g_array_unref(scenes);
  if (!GST_CLOCK_TIME_IS_VALID(duration)) return FALSE;
  gst_base_parse_set_duration(parse, GST_FORMAT_TIME, (gint64)duration, 0);
  return TRUE;
}

/* Streams are small: all of a file is read once. */
static void index_file(GstFbsParse* self) {
  GstPad* const pad = GST_BASE_PARSE_SINK_PAD(self);
  GstBuffer* file = NULL;
  GstMapInfo map;
  gint64 size = 0;
  self->has_index = TRUE;
  if (GST_PAD_MODE(pad) != GST_PAD_MODE_PULL) return;
  if (!gst_pad_peer_query_duration(pad, GST_FORMAT_BYTES, &size) || size <= 0 || size > MAX_INDEXED_FILE)
    return;
  if (gst_pad_pull_range(pad, 0, (guint)size, &file) != GST_FLOW_OK) return;
  if (gst_buffer_map(file, &map, GST_MAP_READ)) {
    if (!index_bytes(self, map.data, map.size)) GST_WARNING_OBJECT(self, "the file has no scene");
    gst_buffer_unmap(file, &map);
  }
  gst_buffer_unref(file);
}

/* Only the index leads to scenes; the base class uses it alone where a seek is to be accurate. */
static gboolean gst_fbs_parse_src_event(GstBaseParse* parse, GstEvent* event) {
  if (GST_EVENT_TYPE(event) == GST_EVENT_SEEK) {
    gdouble rate;
    GstFormat format;
    GstSeekFlags flags;
    GstSeekType start_type, stop_type;
    gint64 start, stop;
    gst_event_parse_seek(event, &rate, &format, &flags, &start_type, &start, &stop_type, &stop);
    if (rate < 0) {
      GST_WARNING_OBJECT(parse, "a face is not played backwards");
      gst_event_unref(event);
      return FALSE;
    }
    GstEvent* const accurate =
        gst_event_new_seek(rate, format, flags | GST_SEEK_FLAG_ACCURATE, start_type, start, stop_type, stop);
    gst_event_set_seqnum(accurate, gst_event_get_seqnum(event));
    gst_event_unref(event);
    event = accurate;
  }
  return GST_BASE_PARSE_CLASS(gst_fbs_parse_parent_class)->src_event(parse, event);
}

/* ---- groups ---- */

static void begin_group(GstFbsParse* self) {
  self->scanned = 0;
  self->key = FALSE;
  self->pts = GST_CLOCK_TIME_NONE;
}

/* What follows need not follow what was. */
static void lose_sync(GstFbsParse* self) {
  self->synced = FALSE;
  self->chain = GST_FBS_FIRST_CHECK;
  if (self->clock != NULL) fbs_decoder_reset(self->clock);
  begin_group(self);
}

static void take_setup(GstFbsParse* self, const GstFbsPacket* packet) {
  GstFbsSetup setup;
  if (!gst_fbs_setup_parse(packet->payload, packet->payload_size, &setup)) return;
  GstPad* const pad = GST_BASE_PARSE_SRC_PAD(self);
  GstCaps* const caps = gst_fbs_caps_of_setup(&setup);
  GstCaps* const current = gst_pad_get_current_caps(pad);
  if (current == NULL || !gst_caps_is_equal(caps, current)) gst_pad_set_caps(pad, caps);
  if (current != NULL) gst_caps_unref(current);
  gst_caps_unref(caps);
  self->has_scene = self->key = TRUE;
}

/* @return whether pictures are shown once the packet has arrived */
static gboolean take_packet(GstFbsParse* self, const guint8* data, gsize size) {
  gboolean shows = FALSE;
  fbs_picture_info info;
  fbs_status status;
  fbs_decoder_feed(self->clock, data, size);
  while ((status = fbs_decoder_next(self->clock, &info)) != FBS_NEED_DATA && status != FBS_END) {
    if (status != FBS_OK) {
      GST_ELEMENT_WARNING(self, STREAM, DECODE, (NULL), ("%s", fbs_decoder_error(self->clock)));
      continue;
    }
    shows = TRUE;
    if (!info.held && !GST_CLOCK_TIME_IS_VALID(self->pts)) self->pts = gst_fbs_ticks_to_time(info.time);
    self->end = gst_fbs_ticks_to_time(info.time + info.duration);
  }
  return shows;
}

static GstFlowReturn send_group(GstFbsParse* self, GstBaseParseFrame* frame) {
  GstBuffer* const buffer = frame->buffer;
  const gsize size = self->scanned;
  if (!self->timed || !GST_BUFFER_PTS_IS_VALID(buffer))
    GST_BUFFER_PTS(buffer) = GST_CLOCK_TIME_IS_VALID(self->pts) ? self->pts : self->end;
  GST_BUFFER_DURATION(buffer) = GST_CLOCK_TIME_IS_VALID(self->pts) ? self->end - self->pts : 0;
  if (!self->key) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  begin_group(self);
  return gst_base_parse_finish_frame(GST_BASE_PARSE(self), frame, (gint)size);
}

/* Passes over damage, from `at` on: SPEC 3.2. What of the group was before it is of no use. The base class
 * marks the next buffer as discontinuous. */
static void pass_damage(GstFbsParse* self, const guint8* data, gsize size, gsize at, gint* skip) {
  if (self->synced)
    GST_ELEMENT_WARNING(self, STREAM, DECODE, (NULL), ("a damaged packet: the rest of its scene is lost"));
  lose_sync(self);
  const gsize next = MIN(at + 1, size);
  *skip = (gint)(next + gst_fbs_find_restart(data + next, size - next));
}

typedef enum { PACKET_GOES_ON, PACKET_ENDS_GROUP, PACKET_IS_OF_NEXT_GROUP } PacketPlace;

/* A whole packet, whose check is right. */
static PacketPlace place_packet(GstFbsParse* self, const GstFbsPacket* packet, const guint8* begin) {
  const gboolean is_setup = packet->type == GST_FBS_SETUP, is_end = packet->type == GST_FBS_END;
  const gboolean has_packets = self->scanned > GST_FBS_SIGNATURE_SIZE;
  if ((is_setup || is_end) && has_packets && self->has_scene) return PACKET_IS_OF_NEXT_GROUP;
  if (is_setup) take_setup(self, packet);
  self->synced = TRUE;
  self->scanned += packet->size;
  return take_packet(self, begin, packet->size) || is_end ? PACKET_ENDS_GROUP : PACKET_GOES_ON;
}

/* @return TRUE when self->scanned bytes are a group */
static gboolean scan(GstFbsParse* self, const guint8* data, gsize size, gint* skip) {
  GstBaseParse* const parse = GST_BASE_PARSE(self);
  if (self->scanned == 0 && !self->synced) self->scanned = gst_fbs_signature_at(data, size);
  for (;;) {
    GstFbsPacket packet;
    gsize needed = 0;
    guint16 chain = self->chain;
    const gsize at = self->scanned;
    const GstFbsScan found = gst_fbs_packet_scan(data + at, size - at, &packet, &needed);
    if (found == GST_FBS_SCAN_SHORT && !GST_BASE_PARSE_DRAINING(parse)) {
      gst_base_parse_set_min_frame_size(parse, (guint)(at + needed));
      return FALSE;
    }
    if (found == GST_FBS_SCAN_SHORT && at == size && at > GST_FBS_SIGNATURE_SIZE) return TRUE;
    if (found != GST_FBS_SCAN_PACKET || !gst_fbs_packet_check(&packet, &chain)) {
      pass_damage(self, data, size, at, skip);
      return FALSE;
    }
    const PacketPlace place = place_packet(self, &packet, data + at);
    if (place == PACKET_IS_OF_NEXT_GROUP) return TRUE;
    self->chain = chain;
    if (place == PACKET_ENDS_GROUP) return TRUE;
  }
}

static GstFlowReturn gst_fbs_parse_handle_frame(GstBaseParse* parse, GstBaseParseFrame* frame, gint* skip) {
  GstFbsParse* const self = GST_FBS_PARSE(parse);
  GstMapInfo map;
  if (!self->has_index) index_file(self);
  if (GST_BUFFER_IS_DISCONT(frame->buffer) && (self->scanned == 0 || frame->offset != self->offset))
    lose_sync(self);
  self->offset = frame->offset;
  if (!gst_buffer_map(frame->buffer, &map, GST_MAP_READ)) return GST_FLOW_ERROR;
  *skip = 0;
  const gboolean whole = scan(self, map.data, map.size, skip);
  gst_buffer_unmap(frame->buffer, &map);
  if (!whole) return GST_FLOW_OK;
  gst_base_parse_set_min_frame_size(parse, SMALLEST_PACKET);
  if (self->has_scene) return send_group(self, frame);
  *skip = (gint)self->scanned; /* shows nothing */
  begin_group(self);
  return GST_FLOW_OK;
}

/* ---- life ---- */

static gboolean gst_fbs_parse_sink_event(GstBaseParse* parse, GstEvent* event) {
  GstFbsParse* const self = GST_FBS_PARSE(parse);
  if (GST_EVENT_TYPE(event) == GST_EVENT_FLUSH_STOP || GST_EVENT_TYPE(event) == GST_EVENT_STREAM_START)
    lose_sync(self);
  if (GST_EVENT_TYPE(event) == GST_EVENT_SEGMENT) {
    const GstSegment* segment;
    gst_event_parse_segment(event, &segment);
    self->timed = segment->format == GST_FORMAT_TIME;
  }
  return GST_BASE_PARSE_CLASS(gst_fbs_parse_parent_class)->sink_event(parse, event);
}

static gboolean gst_fbs_parse_start(GstBaseParse* parse) {
  GstFbsParse* const self = GST_FBS_PARSE(parse);
  if (fbs_decoder_open(&self->clock, NULL) != FBS_OK) return FALSE;
  self->has_index = self->timed = self->has_scene = FALSE;
  self->end = 0;
  lose_sync(self);
  gst_base_parse_set_min_frame_size(parse, SMALLEST_PACKET);
  gst_base_parse_set_has_timing_info(parse, TRUE);
  gst_base_parse_set_pts_interpolation(parse, FALSE);
  return TRUE;
}

static gboolean gst_fbs_parse_stop(GstBaseParse* parse) {
  fbs_decoder_close(&GST_FBS_PARSE(parse)->clock);
  return TRUE;
}

static void gst_fbs_parse_class_init(GstFbsParseClass* type) {
  GstElementClass* const element = GST_ELEMENT_CLASS(type);
  GstBaseParseClass* const parse = GST_BASE_PARSE_CLASS(type);
  GST_DEBUG_CATEGORY_INIT(fbs_parse_debug, "fbsparse", 0, "fbs parser");

  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  gst_element_class_set_static_metadata(element, "fbs parser", "Codec/Parser/Video",
                                        "Cuts a stream of fbs into groups of packets with timestamps",
                                        "The fbs authors");
  parse->start = gst_fbs_parse_start;
  parse->stop = gst_fbs_parse_stop;
  parse->handle_frame = gst_fbs_parse_handle_frame;
  parse->sink_event = gst_fbs_parse_sink_event;
  parse->src_event = gst_fbs_parse_src_event;
}

static void gst_fbs_parse_init(GstFbsParse* self) {
  GST_PAD_SET_ACCEPT_INTERSECT(GST_BASE_PARSE_SINK_PAD(self));
  GST_PAD_SET_ACCEPT_TEMPLATE(GST_BASE_PARSE_SINK_PAD(self));
}
