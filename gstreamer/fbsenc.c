/**
 * SECTION:element-fbsenc
 * @title: fbsenc
 *
 * Encodes the video of a talking head with fbs.
 *
 * |[
 * gst-launch-1.0 v4l2src ! videoconvert ! video/x-raw,width=640,height=480 ! fbsenc bitrate=10000 ! filesink
 * location=me.fbs
 * ]|
 *
 * A buffer has all bytes that some pictures need, and the timestamp of the first of them. What comes out, one
 * buffer after the other, is a file.
 */
#include "fbsenc.h"

#include <gst/video/video.h>

#include "caps.h"
#include "elements.h"
#include "log.h"

GST_DEBUG_CATEGORY_STATIC(fbs_enc_debug);
#define GST_CAT_DEFAULT fbs_enc_debug

G_DEFINE_TYPE(GstFbsEnc, gst_fbs_enc, GST_TYPE_VIDEO_ENCODER)
GST_ELEMENT_REGISTER_DEFINE(fbsenc, "fbsenc", GST_RANK_PRIMARY, GST_TYPE_FBS_ENC)

#define LONGEST_SEGMENT 40.0 /* seconds: without `live` packets come so much later at most */

static GstStaticPadTemplate sink_template = GST_STATIC_PAD_TEMPLATE(
    "sink", GST_PAD_SINK, GST_PAD_ALWAYS,
    GST_STATIC_CAPS("video/x-raw, format = (string) I420, width = (int) [ 64, 8192 ], "
                    "height = (int) [ 64, 8192 ], framerate = (fraction) [ 0/1, 1000/1 ]"));
static GstStaticPadTemplate src_template = GST_STATIC_PAD_TEMPLATE(
    "src", GST_PAD_SRC, GST_PAD_ALWAYS,
    GST_STATIC_CAPS(GST_FBS_GROUP_CAPS ", width = (int) [ 64, 8192 ], height = (int) [ 64, 8192 ], "
                                       "framerate = (fraction) [ 0/1, 1000/1 ]"));

/* ---- from pictures to buffers ---- */

static GstFlowReturn fail(GstFbsEnc* self, fbs_status status) {
  GST_ELEMENT_ERROR(self, STREAM, ENCODE, (NULL),
                    ("%s: %s", fbs_status_text(status), fbs_encoder_error(self->stream.encoder)));
  return GST_FLOW_ERROR;
}

static GstVideoCodecFrame* next_frame(GstFbsEnc* self) {
  ++self->first_number;
  return g_queue_pop_head(&self->frames);
}

/* Lets go of frames whose pictures are in the buffers sent: pre_push() keeps what they have back. */
static void release_frames(GstFbsEnc* self, guint64 before) {
  while (self->first_number < before && !g_queue_is_empty(&self->frames)) {
    GstVideoCodecFrame* const frame = next_frame(self);
    frame->output_buffer = gst_buffer_new();
    gst_video_encoder_finish_frame(GST_VIDEO_ENCODER(self), frame);
  }
}

/* The number of the first picture behind a group. Where the next group is not known yet, it has all pictures
 * pushed, or so many as a live encoder groups. */
static guint64 number_behind(const GstFbsEnc* self, const GstFbsGroup* group) {
  const GstFbsGroup* const next = g_queue_peek_head(&((GstFbsEnc*)self)->stream.ready);
  const guint64 pushed = self->stream.pictures;
  const double rate = (double)self->settings.format.frame_rate_num / self->settings.format.frame_rate_den;
  const double delay = self->settings.live_delay;
  const int groups = (int)delay + (delay > (int)delay); /* none is longer than a second */
  const double grouped = group->key ? 1 : delay / groups * rate + 0.5;
  if (next != NULL) return next->number;
  if (!self->settings.live) return pushed;
  return MIN(pushed, group->number + (guint64)CLAMP(grouped, 1, 256));
}

static GstClockTime start_of(const GstFbsEnc* self, guint64 number) {
  const GstVideoCodecFrame* const frame =
      g_queue_peek_nth(&((GstFbsEnc*)self)->frames, (guint)(number - self->first_number));
  return frame != NULL ? frame->pts : self->end;
}

static GstBuffer* buffer_of(const GstFbsGroup* group) {
  return gst_buffer_new_memdup(group->bytes->data, group->bytes->len);
}

/* The end packet shows no picture: it belongs to no frame. */
static GstFlowReturn send_end(GstFbsEnc* self, GstFbsGroup* group) {
  GstBuffer* const buffer = buffer_of(group);
  GST_BUFFER_PTS(buffer) = self->end;
  GST_BUFFER_DURATION(buffer) = 0;
  GST_BUFFER_FLAG_SET(buffer, GST_BUFFER_FLAG_DELTA_UNIT);
  return gst_pad_push(GST_VIDEO_ENCODER_SRC_PAD(self), buffer);
}

static GstFlowReturn send_group(GstFbsEnc* self, GstFbsGroup* group) {
  release_frames(self, group->number);
  if (group->end) return send_end(self, group);
  if (g_queue_is_empty(&self->frames)) return GST_FLOW_OK;
  const GstClockTime behind = start_of(self, number_behind(self, group));
  GstVideoCodecFrame* const frame = next_frame(self);
  frame->output_buffer = buffer_of(group);
  frame->duration = behind > frame->pts ? behind - frame->pts : GST_CLOCK_TIME_NONE;
  if (group->key) GST_VIDEO_CODEC_FRAME_SET_SYNC_POINT(frame);
  return gst_video_encoder_finish_frame(GST_VIDEO_ENCODER(self), frame);
}

static GstFlowReturn send_ready(GstFbsEnc* self) {
  GstFlowReturn flow = GST_FLOW_OK;
  GstFbsGroup* group;
  while (flow == GST_FLOW_OK && (group = g_queue_pop_head(&self->stream.ready)) != NULL) {
    flow = send_group(self, group);
    gst_fbs_group_free(group);
  }
  return flow;
}

/* Base class: what is neither GST_FLOW_OK nor an error lets go of the frame and sends nothing. */
static GstFlowReturn gst_fbs_enc_pre_push(GstVideoEncoder* encoder, GstVideoCodecFrame* frame) {
  (void)encoder;
  return gst_buffer_get_size(frame->output_buffer) > 0 ? GST_FLOW_OK : GST_VIDEO_ENCODER_FLOW_NEED_DATA;
}

/* ---- the stream ---- */

static void drop_frames(GstFbsEnc* self) {
  g_queue_clear_full(&self->frames, (GDestroyNotify)gst_video_codec_frame_unref);
  self->first_number = 0;
  self->origin = self->end = GST_CLOCK_TIME_NONE;
}

static void close_stream(GstFbsEnc* self) {
  gst_fbs_encoder_stream_close(&self->stream);
  drop_frames(self);
}

/* An fbs_log. */
static void log_line(void* self, int level, const char* text) {
  GST_CAT_LEVEL_LOG(GST_CAT_DEFAULT, gst_fbs_debug_level(level), GST_OBJECT(self), "%s", text);
}

static gboolean open_encoder(GstFbsEnc* self) {
  char why[FBS_ERROR_SIZE] = "";
  fbs_encoder_settings settings = self->settings;
  settings.log = log_line;
  settings.user = self;
  settings.open_error = why;
  if (gst_fbs_encoder_stream_open(&self->stream, &settings) == FBS_OK) return TRUE;
  GST_ELEMENT_ERROR(self, LIBRARY, SETTINGS, (NULL), ("the encoder does not take these settings: %s", why));
  return FALSE;
}

static GstFlowReturn finish_encoder(GstFbsEnc* self) {
  const fbs_status status = gst_fbs_encoder_stream_finish(&self->stream);
  const GstFlowReturn flow = send_ready(self);
  if (status != FBS_OK) return fail(self, status);
  release_frames(self, G_MAXUINT64);
  return flow;
}

static GstFlowReturn push_picture(GstFbsEnc* self, GstVideoCodecFrame* frame) {
  GstVideoFrame video;
  if (!gst_video_frame_map(&video, &self->input->info, frame->input_buffer, GST_MAP_READ))
    return GST_FLOW_ERROR;
  fbs_const_picture picture = {self->settings.format.width, self->settings.format.height, {NULL}, {0}};
  for (guint k = 0; k < 3; ++k) {
    picture.data[k] = GST_VIDEO_FRAME_PLANE_DATA(&video, k);
    picture.stride[k] = GST_VIDEO_FRAME_PLANE_STRIDE(&video, k);
  }
  const GstClockTimeDiff behind = GST_CLOCK_DIFF(self->origin, self->end);
  const guint64 end = gst_util_uint64_scale_round((guint64)MAX(behind, 0), FBS_TICKS_PER_SECOND, GST_SECOND);
  const fbs_status status = gst_fbs_encoder_stream_push(&self->stream, &picture, end);
  gst_video_frame_unmap(&video);
  return status == FBS_OK ? GST_FLOW_OK : fail(self, status);
}

/* The scene begins with this picture or one that comes up to `delay` later. The base class keeps the request,
 * and answers it downstream with the first buffer that is a sync point. */
static void request_scene(GstFbsEnc* self) {
  if (!self->settings.live)
    GST_INFO_OBJECT(self, "scenes come on request with `live` only");
  else if (self->stream.pictures > 0)
    fbs_encoder_request_scene(self->stream.encoder);
}

static GstClockTime duration_of(const GstFbsEnc* self, const GstVideoCodecFrame* frame) {
  if (GST_CLOCK_TIME_IS_VALID(frame->duration) && frame->duration > 0) return frame->duration;
  return gst_util_uint64_scale(GST_SECOND, self->settings.format.frame_rate_den,
                               self->settings.format.frame_rate_num);
}

static GstFlowReturn gst_fbs_enc_handle_frame(GstVideoEncoder* encoder, GstVideoCodecFrame* frame) {
  GstFbsEnc* const self = GST_FBS_ENC(encoder);
  if (gst_video_encoder_get_max_encode_time(encoder, frame) < 0) {
    GST_LOG_OBJECT(self, "late: picture %u is dropped", frame->system_frame_number);
    return gst_video_encoder_finish_frame(encoder, frame); /* without a buffer: tells of it, too */
  }
  if (self->stream.encoder == NULL && !open_encoder(self)) {
    gst_video_codec_frame_unref(frame);
    return GST_FLOW_ERROR;
  }
  if (GST_VIDEO_CODEC_FRAME_IS_FORCE_KEYFRAME(frame)) request_scene(self);
  if (!GST_CLOCK_TIME_IS_VALID(self->origin)) self->origin = frame->pts;
  self->end = frame->pts + duration_of(self, frame);
  g_queue_push_tail(&self->frames, frame);
  const GstFlowReturn flow = push_picture(self, frame);
  gst_buffer_replace(&frame->input_buffer, NULL); /* forty seconds of pictures may wait */
  return flow == GST_FLOW_OK ? send_ready(self) : flow;
}

static GstFlowReturn gst_fbs_enc_finish(GstVideoEncoder* encoder) {
  GstFbsEnc* const self = GST_FBS_ENC(encoder);
  const GstFlowReturn flow = finish_encoder(self);
  close_stream(self);
  return flow;
}

static gboolean gst_fbs_enc_flush(GstVideoEncoder* encoder) {
  close_stream(GST_FBS_ENC(encoder));
  return TRUE;
}

static gboolean gst_fbs_enc_stop(GstVideoEncoder* encoder) {
  GstFbsEnc* const self = GST_FBS_ENC(encoder);
  close_stream(self);
  g_clear_pointer(&self->input, gst_video_codec_state_unref);
  return TRUE;
}

/* ---- caps and latency ---- */

static void report_latency(GstFbsEnc* self) {
  const fbs_encoder_settings* const s = &self->settings;
  const double segment = s->key_interval > 0 ? MIN(s->key_interval, LONGEST_SEGMENT) : LONGEST_SEGMENT;
  const double pictures = s->live && s->threads != 1 ? 2 : 1; /* coded while the next one is analysed */
  const double seconds =
      (s->live ? s->live_delay : segment) + pictures * s->format.frame_rate_den / s->format.frame_rate_num;
  const GstClockTime latency = (GstClockTime)(seconds * (double)GST_SECOND);
  gst_video_encoder_set_latency(GST_VIDEO_ENCODER(self), latency, latency);
}

static fbs_matrix matrix_of(const GstVideoInfo* info) {
  switch (info->colorimetry.matrix) {
    case GST_VIDEO_COLOR_MATRIX_BT601:
      return FBS_MATRIX_BT601;
    case GST_VIDEO_COLOR_MATRIX_BT709:
      return FBS_MATRIX_BT709;
    default:
      return FBS_MATRIX_UNSPECIFIED;
  }
}

static void take_format(GstFbsEnc* self, const GstVideoInfo* info) {
  fbs_format* const format = &self->settings.format;
  format->width = (guint32)GST_VIDEO_INFO_WIDTH(info);
  format->height = (guint32)GST_VIDEO_INFO_HEIGHT(info);
  format->frame_rate_num = (guint32)GST_VIDEO_INFO_FPS_N(info);
  format->frame_rate_den = (guint32)GST_VIDEO_INFO_FPS_D(info);
  if (format->frame_rate_num == 0) { /* variable */
    format->frame_rate_num = 25;
    format->frame_rate_den = 1;
  }
  format->pixel_aspect_num = (guint32)GST_VIDEO_INFO_PAR_N(info);
  format->pixel_aspect_den = (guint32)GST_VIDEO_INFO_PAR_D(info);
  format->matrix = matrix_of(info);
  format->full_range = info->colorimetry.range == GST_VIDEO_COLOR_RANGE_0_255;
}

static void send_tags(GstFbsEnc* self) {
  GstTagList* const tags = gst_tag_list_new(GST_TAG_VIDEO_CODEC, "fbs", GST_TAG_ENCODER, "fbs", NULL);
  if (self->settings.bitrate > 0)
    gst_tag_list_add(tags, GST_TAG_MERGE_REPLACE, GST_TAG_NOMINAL_BITRATE,
                     (guint)(self->settings.bitrate * 1000 + 0.5), NULL);
  gst_video_encoder_merge_tags(GST_VIDEO_ENCODER(self), tags, GST_TAG_MERGE_REPLACE);
  gst_tag_list_unref(tags);
}

/* Pictures of another size are another stream. */
static gboolean gst_fbs_enc_set_format(GstVideoEncoder* encoder, GstVideoCodecState* state) {
  GstFbsEnc* const self = GST_FBS_ENC(encoder);
  if (self->stream.encoder != NULL && gst_fbs_enc_finish(encoder) != GST_FLOW_OK) return FALSE;
  g_clear_pointer(&self->input, gst_video_codec_state_unref);
  self->input = gst_video_codec_state_ref(state);
  take_format(self, &state->info);
  if (!open_encoder(self)) return FALSE;
  GstVideoCodecState* const output =
      gst_video_encoder_set_output_state(encoder, gst_caps_from_string(GST_FBS_GROUP_CAPS), state);
  gst_video_codec_state_unref(output);
  report_latency(self);
  send_tags(self);
  return gst_video_encoder_negotiate(encoder);
}

static gboolean gst_fbs_enc_propose_allocation(GstVideoEncoder* encoder, GstQuery* query) {
  gst_query_add_allocation_meta(query, GST_VIDEO_META_API_TYPE, NULL);
  return GST_VIDEO_ENCODER_CLASS(gst_fbs_enc_parent_class)->propose_allocation(encoder, query);
}

static void gst_fbs_enc_finalize(GObject* object) {
  GstFbsEnc* const self = GST_FBS_ENC(object);
  close_stream(self);
  g_clear_pointer(&self->input, gst_video_codec_state_unref);
  G_OBJECT_CLASS(gst_fbs_enc_parent_class)->finalize(object);
}

static void gst_fbs_enc_class_init(GstFbsEncClass* type) {
  GObjectClass* const object = G_OBJECT_CLASS(type);
  GstElementClass* const element = GST_ELEMENT_CLASS(type);
  GstVideoEncoderClass* const encoder = GST_VIDEO_ENCODER_CLASS(type);
  GST_DEBUG_CATEGORY_INIT(fbs_enc_debug, "fbsenc", 0, "fbs encoder");

  object->finalize = gst_fbs_enc_finalize;
  gst_fbs_enc_install_properties(object);
  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  gst_element_class_set_static_metadata(element, "fbs talking-head encoder", "Codec/Encoder/Video",
                                        "Encodes the video of a talking head at a few kbit/s",
                                        "The fbs authors");

  encoder->stop = gst_fbs_enc_stop;
  encoder->set_format = gst_fbs_enc_set_format;
  encoder->handle_frame = gst_fbs_enc_handle_frame;
  encoder->pre_push = gst_fbs_enc_pre_push;
  encoder->transform_meta = NULL; /* what describes one picture says nothing of a group */
  encoder->finish = gst_fbs_enc_finish;
  encoder->flush = gst_fbs_enc_flush;
  encoder->propose_allocation = gst_fbs_enc_propose_allocation;
}

static void gst_fbs_enc_init(GstFbsEnc* self) {
  fbs_encoder_default_settings(&self->settings, sizeof self->settings);
  self->settings.live = TRUE;
  self->settings.allow_no_face = TRUE;
  gst_fbs_encoder_stream_close(&self->stream);
  drop_frames(self);
}
