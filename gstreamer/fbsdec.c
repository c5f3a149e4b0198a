/**
 * SECTION:element-fbsdec
 * @title: fbsdec
 *
 * Decodes fbs, the video of a talking head.
 *
 * |[
 * gst-launch-1.0 filesrc location=talk.fbs ! fbsparse ! fbsdec ! videoconvert ! autovideosink
 * ]|
 *
 * Behind damage it goes on at the next scene, and asks upstream for one.
 */
#include "fbsdec.h"

#include <gst/video/video.h>
#include <string.h>

#include "caps.h"
#include "elements.h"
#include "log.h"

GST_DEBUG_CATEGORY_STATIC(fbs_dec_debug);
#define GST_CAT_DEFAULT fbs_dec_debug

G_DEFINE_TYPE(GstFbsDec, gst_fbs_dec, GST_TYPE_VIDEO_DECODER)
GST_ELEMENT_REGISTER_DEFINE(fbsdec, "fbsdec", GST_RANK_PRIMARY, GST_TYPE_FBS_DEC)

enum { PROP_0, PROP_THREADS };

static GstStaticPadTemplate sink_template =
    GST_STATIC_PAD_TEMPLATE("sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS(GST_FBS_GROUP_CAPS));
static GstStaticPadTemplate src_template = GST_STATIC_PAD_TEMPLATE(
    "src", GST_PAD_SRC, GST_PAD_ALWAYS,
    GST_STATIC_CAPS("video/x-raw, format = (string) I420, width = (int) [ 64, 8192 ], "
                    "height = (int) [ 64, 8192 ], framerate = (fraction) [ 0/1, 1000/1 ]"));

/* ---- from groups to pictures ---- */

/* The base class has one picture in a buffer, and fbs several. So a group is fed to the library here, and the
 * base class gets an empty buffer for each picture that the library announces, with its timestamp;
 * handle_frame() draws that one, or drops it when it is late. */

static GstClockTime timestamp(GstFbsDec* self, const fbs_picture_info* info) {
  const GstClockTime time = gst_fbs_ticks_to_time(info->time);
  if (!info->held && GST_CLOCK_TIME_IS_VALID(self->group)) { /* held ones are of the time before the group */
    self->offset = GST_CLOCK_DIFF(time, self->group);
    self->group = GST_CLOCK_TIME_NONE;
  }
  const GstClockTimeDiff at = (GstClockTimeDiff)time + self->offset;
  return at >= 0 ? (GstClockTime)at : 0;
}

static GstFlowReturn announce(GstFbsDec* self, const fbs_picture_info* info) {
  GstBuffer* const buffer = gst_buffer_new();
  GST_BUFFER_PTS(buffer) = timestamp(self, info);
  GST_BUFFER_DURATION(buffer) = gst_fbs_ticks_to_time(info->duration);
  if (!info->new_scene) GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  return self->decode_picture(GST_VIDEO_DECODER_SINK_PAD(self), GST_OBJECT(self), buffer);
}

/* Goes on, unless the property max-errors says otherwise. */
static GstFlowReturn tell_of_damage(GstFbsDec* self, fbs_status status) {
  GstFlowReturn flow = GST_FLOW_OK;
  const char* const text = fbs_decoder_error(self->decoder);
  GST_VIDEO_DECODER_ERROR(self, 1, STREAM, DECODE, (NULL), ("%s: %s", fbs_status_text(status), text), flow);
  if (flow != GST_FLOW_OK) return flow;
  GST_ELEMENT_WARNING(self, STREAM, DECODE, (NULL), ("%s: %s", fbs_status_text(status), text));
  gst_pad_push_event(GST_VIDEO_DECODER_SINK_PAD(self),
                     gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
  return GST_FLOW_OK;
}

/* Shows all pictures that have arrived. */
static GstFlowReturn show(GstFbsDec* self) {
  GstFlowReturn flow = GST_FLOW_OK;
  while (flow == GST_FLOW_OK) {
    fbs_picture_info info;
    const fbs_status status = fbs_decoder_next(self->decoder, &info);
    if (status == FBS_NEED_DATA || status == FBS_END) break;
    flow = status == FBS_OK ? announce(self, &info) : tell_of_damage(self, status);
  }
  return flow;
}

/* A stream may begin with any scene, without its signature. */
static void join(GstFbsDec* self) {
  if (self->decoder != NULL) fbs_decoder_reset(self->decoder);
  self->finished = FALSE;
  self->offset = 0;
  self->group = GST_CLOCK_TIME_NONE;
}

/* Whether a group has nothing to do with what came before: after a seek or a loss, or of another stream. */
static gboolean begins_anew(const GstFbsDec* self, GstBuffer* group, const GstMapInfo* map) {
  const gboolean jumps =
      GST_BUFFER_IS_DISCONT(group) && !GST_BUFFER_FLAG_IS_SET(group, GST_BUFFER_FLAG_DELTA_UNIT);
  return self->finished || jumps || gst_fbs_signature_at(map->data, map->size) > 0;
}

static GstFlowReturn feed(GstFbsDec* self, GstBuffer* group) {
  GstMapInfo map;
  if (self->decoder == NULL) return GST_FLOW_FLUSHING;
  if (!gst_buffer_map(group, &map, GST_MAP_READ)) return GST_FLOW_ERROR;
  if (begins_anew(self, group, &map)) join(self);
  self->has_input = TRUE;
  const fbs_status status = fbs_decoder_feed(self->decoder, map.data, map.size);
  gst_buffer_unmap(group, &map);
  if (status != FBS_OK) {
    GST_ELEMENT_ERROR(self, STREAM, DECODE, (NULL), ("%s", fbs_status_text(status)));
    return GST_FLOW_ERROR;
  }
  self->group = GST_BUFFER_PTS(group);
  return show(self);
}

static GstFlowReturn gst_fbs_dec_chain(GstPad* pad, GstObject* parent, GstBuffer* group) {
  GstFbsDec* const self = GST_FBS_DEC(parent);
  (void)pad;
  const GstFlowReturn flow = feed(self, group);
  gst_buffer_unref(group);
  return flow;
}

/* What the end of the stream gives out has to come before the event. */
static gboolean gst_fbs_dec_sink_event(GstVideoDecoder* decoder, GstEvent* event) {
  GstFbsDec* const self = GST_FBS_DEC(decoder);
  if (GST_EVENT_TYPE(event) == GST_EVENT_EOS && self->decoder != NULL && !self->finished) {
    self->finished = TRUE;
    self->group = GST_CLOCK_TIME_NONE;
    fbs_decoder_finish(self->decoder);
    show(self);
    if (self->has_input && self->format.width == 0)
      GST_ELEMENT_ERROR(self, STREAM, DECODE, (NULL), ("no picture could be decoded"));
  }
  return GST_VIDEO_DECODER_CLASS(gst_fbs_dec_parent_class)->sink_event(decoder, event);
}

/* ---- one picture ---- */

static void set_colours(GstVideoInfo* info, const fbs_format* format) {
  GstVideoColorimetry* const colours = &info->colorimetry;
  colours->range = format->full_range ? GST_VIDEO_COLOR_RANGE_0_255 : GST_VIDEO_COLOR_RANGE_16_235;
  if (format->matrix == FBS_MATRIX_BT601) colours->matrix = GST_VIDEO_COLOR_MATRIX_BT601;
  if (format->matrix == FBS_MATRIX_BT709) colours->matrix = GST_VIDEO_COLOR_MATRIX_BT709;
  info->chroma_site = GST_VIDEO_CHROMA_SITE_JPEG;
}

/* Scenes of a stream have one size, but may differ in the rest. */
static gboolean negotiate(GstFbsDec* self) {
  fbs_format format = {0};
  if (fbs_decoder_get_format(self->decoder, &format) != FBS_OK) return FALSE;
  if (memcmp(&format, &self->format, sizeof format) == 0) return TRUE;
  GstVideoDecoder* const decoder = GST_VIDEO_DECODER(self);
  GstVideoCodecState* const output =
      gst_video_decoder_set_output_state(decoder, GST_VIDEO_FORMAT_I420, format.width, format.height, NULL);
  if (format.frame_rate_num <= G_MAXINT && format.frame_rate_den <= G_MAXINT) {
    GST_VIDEO_INFO_FPS_N(&output->info) = (gint)format.frame_rate_num;
    GST_VIDEO_INFO_FPS_D(&output->info) = (gint)format.frame_rate_den;
  }
  if (format.pixel_aspect_num > 0 && format.pixel_aspect_num <= G_MAXINT &&
      format.pixel_aspect_den <= G_MAXINT) {
    GST_VIDEO_INFO_PAR_N(&output->info) = (gint)format.pixel_aspect_num;
    GST_VIDEO_INFO_PAR_D(&output->info) = (gint)format.pixel_aspect_den;
  }
  set_colours(&output->info, &format);
  gst_video_codec_state_unref(output);
  self->format = format;
  return gst_video_decoder_negotiate(decoder);
}

static fbs_status draw(GstFbsDec* self, GstBuffer* buffer, const GstVideoInfo* info) {
  GstVideoFrame video;
  if (!gst_video_frame_map(&video, info, buffer, GST_MAP_WRITE)) return FBS_ERROR_NO_MEMORY;
  fbs_picture picture = {self->format.width, self->format.height, {NULL}, {0}};
  for (guint k = 0; k < 3; ++k) {
    picture.data[k] = GST_VIDEO_FRAME_PLANE_DATA(&video, k);
    picture.stride[k] = GST_VIDEO_FRAME_PLANE_STRIDE(&video, k);
  }
  const fbs_status status = fbs_decoder_draw(self->decoder, &picture);
  gst_video_frame_unmap(&video);
  return status;
}

static GstFlowReturn draw_frame(GstFbsDec* self, GstVideoCodecFrame* frame) {
  GstVideoDecoder* const decoder = GST_VIDEO_DECODER(self);
  const GstFlowReturn flow = gst_video_decoder_allocate_output_frame(decoder, frame);
  if (flow != GST_FLOW_OK) {
    gst_video_decoder_release_frame(decoder, frame);
    return flow;
  }
  GstVideoCodecState* const output = gst_video_decoder_get_output_state(decoder);
  const fbs_status status = draw(self, frame->output_buffer, &output->info);
  gst_video_codec_state_unref(output);
  if (status == FBS_OK) return gst_video_decoder_finish_frame(decoder, frame);
  GST_ELEMENT_ERROR(self, STREAM, DECODE, (NULL), ("%s", fbs_decoder_error(self->decoder)));
  gst_video_decoder_drop_frame(decoder, frame);
  return GST_FLOW_ERROR;
}

/* After a seek decoding begins with the scene, and what is before the segment is not to be shown. */
static gboolean is_before_segment(GstVideoDecoder* decoder, const GstVideoCodecFrame* frame) {
  const GstSegment* const segment = &decoder->output_segment;
  return segment->format == GST_FORMAT_TIME && frame->pts + frame->duration <= segment->start;
}

static GstFlowReturn gst_fbs_dec_handle_frame(GstVideoDecoder* decoder, GstVideoCodecFrame* frame) {
  GstFbsDec* const self = GST_FBS_DEC(decoder);
  if (!negotiate(self)) {
    gst_video_decoder_release_frame(decoder, frame);
    return GST_FLOW_NOT_NEGOTIATED;
  }
  if (is_before_segment(decoder, frame)) {
    gst_video_decoder_release_frame(decoder, frame);
    return GST_FLOW_OK;
  }
  if (gst_video_decoder_get_max_decode_time(decoder, frame) < 0)
    return gst_video_decoder_drop_frame(decoder, frame);
  return draw_frame(self, frame);
}

/* ---- life ---- */

/* An fbs_log. */
static void log_line(void* self, int level, const char* text) {
  GST_CAT_LEVEL_LOG(GST_CAT_DEFAULT, gst_fbs_debug_level(level), GST_OBJECT(self), "%s", text);
}

static gboolean gst_fbs_dec_start(GstVideoDecoder* decoder) {
  GstFbsDec* const self = GST_FBS_DEC(decoder);
  fbs_decoder_settings settings;
  fbs_decoder_default_settings(&settings, sizeof settings);
  settings.threads = self->threads;
  settings.log = log_line;
  settings.user = self;
  char why[FBS_ERROR_SIZE] = "";
  settings.open_error = why;
  if (fbs_decoder_open(&self->decoder, &settings) != FBS_OK) {
    GST_ELEMENT_ERROR(self, LIBRARY, INIT, (NULL), ("%s", why));
    return FALSE;
  }
  self->format = (fbs_format){0};
  self->has_input = FALSE;
  join(self);
  return TRUE;
}

static gboolean gst_fbs_dec_stop(GstVideoDecoder* decoder) {
  fbs_decoder_close(&GST_FBS_DEC(decoder)->decoder);
  return TRUE;
}

static gboolean gst_fbs_dec_flush(GstVideoDecoder* decoder) {
  join(GST_FBS_DEC(decoder));
  return TRUE;
}

static void gst_fbs_dec_set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  if (id == PROP_THREADS)
    GST_FBS_DEC(object)->threads = g_value_get_int(value);
  else
    G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void gst_fbs_dec_get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  if (id == PROP_THREADS)
    g_value_set_int(value, GST_FBS_DEC(object)->threads);
  else
    G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void gst_fbs_dec_class_init(GstFbsDecClass* type) {
  GObjectClass* const object = G_OBJECT_CLASS(type);
  GstElementClass* const element = GST_ELEMENT_CLASS(type);
  GstVideoDecoderClass* const decoder = GST_VIDEO_DECODER_CLASS(type);
  GST_DEBUG_CATEGORY_INIT(fbs_dec_debug, "fbsdec", 0, "fbs decoder");

  object->set_property = gst_fbs_dec_set_property;
  object->get_property = gst_fbs_dec_get_property;
  g_object_class_install_property(
      object, PROP_THREADS,
      g_param_spec_int(
          "threads", "Threads", "Threads that draw pictures side by side (0 = as many as there are cores)", 0,
          FBS_MAX_THREADS, 1, G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS | GST_PARAM_MUTABLE_READY));
  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  gst_element_class_set_static_metadata(element, "fbs talking-head decoder", "Codec/Decoder/Video",
                                        "Decodes fbs, the video of a talking head", "The fbs authors");

  decoder->start = gst_fbs_dec_start;
  decoder->stop = gst_fbs_dec_stop;
  decoder->flush = gst_fbs_dec_flush;
  decoder->handle_frame = gst_fbs_dec_handle_frame;
  decoder->sink_event = gst_fbs_dec_sink_event;
}

static void gst_fbs_dec_init(GstFbsDec* self) {
  GstPad* const sink = GST_VIDEO_DECODER_SINK_PAD(self);
  self->threads = 1;
  self->decode_picture = GST_PAD_CHAINFUNC(sink);
  gst_pad_set_chain_function(sink, gst_fbs_dec_chain);
  gst_video_decoder_set_packetized(GST_VIDEO_DECODER(self), TRUE);
}
