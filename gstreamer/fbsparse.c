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
  fbs_packet_reader* reader = NULL;
  fbs_packet_info packet;
  fbs_status status;
  gboolean has_scene = FALSE;
  guint64 last = 0, end = 0;
  if (fbs_packet_reader_open(&reader) != FBS_OK) return FALSE;
  fbs_packet_reader_feed(reader, data, size);
  fbs_packet_reader_finish(reader);
  while ((status = fbs_packet_reader_next(reader, &packet)) != FBS_END && status != FBS_ERROR_NO_MEMORY) {
    if (status != FBS_OK || packet.fault != NULL) continue;
    end = packet.shown_until;
    if (packet.type != FBS_PACKET_SETUP || !packet.key || (has_scene && packet.time <= last)) continue;
    gst_base_parse_add_index_entry(parse, packet.offset, gst_fbs_ticks_to_time(packet.time), TRUE, TRUE);
    has_scene = TRUE;
    last = packet.time;
  }
  fbs_packet_reader_close(&reader);
  if (has_scene) gst_base_parse_set_duration(parse, GST_FORMAT_TIME, (gint64)gst_fbs_ticks_to_time(end), 0);
  return has_scene;
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
  fbs_packet_reader_reset(self->packets);
  self->base = self->fed = 0;
  self->synced = self->searching = self->finished = self->has_next = FALSE;
  begin_group(self);
}

/* The first bytes of the buffer have been passed on, or over. */
static void forget(GstFbsParse* self, gsize size) {
  self->base += size;
  self->fed -= size;
  begin_group(self);
}

static void take_setup(GstFbsParse* self, gboolean key) {
  fbs_format format;
  if (fbs_packet_reader_get_format(self->packets, &format) != FBS_OK) return;
  gst_fbs_set_format(GST_BASE_PARSE_SRC_PAD(self), &format);
  self->has_scene = TRUE;
  self->key = key;
}

static GstFlowReturn send_group(GstFbsParse* self, GstBaseParseFrame* frame) {
  GstBuffer* const buffer = frame->buffer;
  const gsize size = self->scanned;
  if (!self->timed || !GST_BUFFER_PTS_IS_VALID(buffer))
    GST_BUFFER_PTS(buffer) = GST_CLOCK_TIME_IS_VALID(self->pts) ? self->pts : self->end;
  GST_BUFFER_DURATION(buffer) = GST_CLOCK_TIME_IS_VALID(self->pts) ? self->end - self->pts : 0;
  if (!self->key) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  forget(self, size);
  return gst_base_parse_finish_frame(GST_BASE_PARSE(self), frame, (gint)size);
}

typedef enum { PACKET_GOES_ON, PACKET_ENDS_GROUP, PACKET_IS_OF_NEXT_GROUP } PacketPlace;

static PacketPlace place_packet(GstFbsParse* self, const fbs_packet_info* packet) {
  const gboolean is_setup = packet->type == FBS_PACKET_SETUP, is_end = packet->type == FBS_PACKET_END;
  const gboolean begins = is_setup || packet->type == FBS_PACKET_RETURN || is_end;
  const gboolean has_packets = self->scanned > FBS_SIGNATURE_SIZE;
  if (begins && has_packets && self->has_scene) return PACKET_IS_OF_NEXT_GROUP;
  if (packet->fault != NULL) GST_ELEMENT_WARNING(self, STREAM, DECODE, (NULL), ("%s", packet->fault));
  if (is_setup && packet->fault == NULL) take_setup(self, packet->key != 0);
  self->synced = TRUE;
  self->scanned = (gsize)(packet->offset - self->base) + packet->size;
  if (packet->pictures > 0 || is_end) {
    if (packet->pictures > 0 && !GST_CLOCK_TIME_IS_VALID(self->pts))
      self->pts = gst_fbs_ticks_to_time(packet->shown_from);
    self->end = gst_fbs_ticks_to_time(packet->shown_until);
  }
  return packet->pictures > 0 || is_end ? PACKET_ENDS_GROUP : PACKET_GOES_ON;
}

/* What of the group was before the damage is of no use. The base class marks the next buffer as
 * discontinuous. */
static void pass_damage(GstFbsParse* self, fbs_status status) {
  if (self->synced && status != FBS_ERROR_NOT_FBS)
    GST_ELEMENT_WARNING(self, STREAM, DECODE, (NULL), ("a damaged packet: the rest of its scene is lost"));
  self->synced = FALSE;
  self->searching = TRUE;
  begin_group(self);
}

static void feed(GstFbsParse* self, const guint8* data, gsize size) {
  if (size > self->fed) fbs_packet_reader_feed(self->packets, data + self->fed, size - self->fed);
  self->fed = MAX(self->fed, size);
  if (!GST_BASE_PARSE_DRAINING(GST_BASE_PARSE(self))) return;
  fbs_packet_reader_finish(self->packets);
  self->finished = TRUE;
}

/* What has been searched through is passed over, but for what may be the beginning of a packet. */
static gboolean wait_for(GstFbsParse* self, gsize size, gsize wanted, gint* skip) {
  gst_base_parse_set_min_frame_size(GST_BASE_PARSE(self), (guint)wanted);
  if (self->searching && size > FBS_MAX_FOUND_PACKET) *skip = (gint)(size - FBS_MAX_FOUND_PACKET);
  return FALSE;
}

/* @return TRUE when self->scanned bytes are a group */
static gboolean scan(GstFbsParse* self, const guint8* data, gsize size, gint* skip) {
  feed(self, data, size);
  for (;;) {
    fbs_packet_info* const packet = &self->next;
    const fbs_status status = self->has_next ? FBS_OK : fbs_packet_reader_next(self->packets, packet);
    if (status == FBS_NEED_DATA) return wait_for(self, size, self->fed + 1, skip);
    if (status == FBS_END && self->scanned > FBS_SIGNATURE_SIZE) return TRUE;
    if (status == FBS_END) {
      *skip = (gint)size;
      return FALSE;
    }
    if (status != FBS_OK) {
      pass_damage(self, status);
      continue;
    }
    const gsize at = (gsize)(packet->offset - self->base);
    self->has_next = TRUE;
    self->searching = FALSE;
    if (at + packet->size > size) return wait_for(self, size, at + packet->size, skip);
    if (at != self->scanned && !(self->scanned == 0 && at == gst_fbs_signature_at(data, size))) {
      *skip = (gint)at;
      return FALSE;
    }
    const PacketPlace place = place_packet(self, packet);
    self->has_next = place == PACKET_IS_OF_NEXT_GROUP;
    if (place != PACKET_GOES_ON) return TRUE;
  }
}

static GstFlowReturn gst_fbs_parse_handle_frame(GstBaseParse* parse, GstBaseParseFrame* frame, gint* skip) {
  GstFbsParse* const self = GST_FBS_PARSE(parse);
  GstMapInfo map;
  if (!self->has_index) index_file(self);
  const gboolean is_apart =
      GST_BUFFER_IS_DISCONT(frame->buffer) && (self->scanned == 0 || frame->offset != self->offset);
  if (is_apart || (self->finished && !GST_BASE_PARSE_DRAINING(parse))) lose_sync(self);
  self->offset = frame->offset;
  if (!gst_buffer_map(frame->buffer, &map, GST_MAP_READ)) return GST_FLOW_ERROR;
  *skip = 0;
  const gboolean whole = scan(self, map.data, map.size, skip);
  gst_buffer_unmap(frame->buffer, &map);
  if (!whole) {
    if (*skip > 0) forget(self, (gsize)*skip);
    return GST_FLOW_OK;
  }
  gst_base_parse_set_min_frame_size(parse, SMALLEST_PACKET);
  if (self->has_scene) return send_group(self, frame);
  *skip = (gint)self->scanned; /* shows nothing */
  forget(self, self->scanned);
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
  if (fbs_packet_reader_open(&self->packets) != FBS_OK) return FALSE;
  self->has_index = self->timed = self->has_scene = FALSE;
  self->end = 0;
  lose_sync(self);
  gst_base_parse_set_min_frame_size(parse, SMALLEST_PACKET);
  gst_base_parse_set_has_timing_info(parse, TRUE);
  gst_base_parse_set_pts_interpolation(parse, FALSE);
  return TRUE;
}

static gboolean gst_fbs_parse_stop(GstBaseParse* parse) {
  fbs_packet_reader_close(&GST_FBS_PARSE(parse)->packets);
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
