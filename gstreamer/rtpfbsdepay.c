/**
 * SECTION:element-rtpfbsdepay
 * @title: rtpfbsdepay
 *
 * Takes fbs out of RTP packets, as docs/rtp.md says. When the loss of a packet is felt beyond its own group
 * it asks the sender for a scene.
 */
#include <gst/rtp/gstrtpbasedepayload.h>
#include <gst/rtp/gstrtpbuffer.h>
#include <gst/video/video.h>

#include "caps.h"
#include "elements.h"
#include "rtp_payload.h"

GST_DEBUG_CATEGORY_STATIC(rtp_fbs_depay_debug);
#define GST_CAT_DEFAULT rtp_fbs_depay_debug

#define DEFAULT_REQUEST_KEYFRAME TRUE
#define REQUEST_INTERVAL (500 * GST_MSECOND) /* of requests, while no scene comes that may be on its way */
#define MAX_GROUP (64u << 20)                /* bytes; none that an encoder sends has a thousandth of that */
#define MAX_PARTS (1u << 20)                 /* bytes of groups that are kept for the parts of a head */

typedef struct {
  GstRTPBaseDepayload parent;

  gboolean request_keyframe; /* property */

  GstAdapter* group;   /* payloads since the last start */
  gboolean in_group;   /* its start has come, and all since */
  gboolean key;        /* it begins a scene where decoding can begin */
  gboolean enters;     /* it begins a scene, or returns to one */
  gboolean waiting;    /* for a scene: of what comes before only parts of its head are of use */
  GstAdapter* parts;   /* groups with such parts */
  gboolean goes_on;    /* groups are of use without those before them */
  gboolean incomplete; /* what is missing is felt up to the next scene */
  fbs_packet_reader* reader;
  guint64 number;         /* of the first picture of the last scene */
  gboolean restarted;     /* the group's scene is of a stream that has begun again */
  gboolean begun;         /* the signature has been sent */
  GstClockTime requested; /* when a scene was asked for the last time; or none */
} GstRtpFbsDepay;

typedef struct {
  GstRTPBaseDepayloadClass parent;
} GstRtpFbsDepayClass;

GType gst_rtp_fbs_depay_get_type(void);
#define GST_RTP_FBS_DEPAY(object) \
  (G_TYPE_CHECK_INSTANCE_CAST(object, gst_rtp_fbs_depay_get_type(), GstRtpFbsDepay))
G_DEFINE_TYPE(GstRtpFbsDepay, gst_rtp_fbs_depay, GST_TYPE_RTP_BASE_DEPAYLOAD)
GST_ELEMENT_REGISTER_DEFINE(rtpfbsdepay, "rtpfbsdepay", GST_RANK_SECONDARY, gst_rtp_fbs_depay_get_type())

enum { PROP_0, PROP_REQUEST_KEYFRAME };

static GstStaticPadTemplate sink_template = GST_STATIC_PAD_TEMPLATE(
    "sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS("application/x-rtp, " GST_FBS_RTP_CAPS_FIELDS));
static GstStaticPadTemplate src_template =
    GST_STATIC_PAD_TEMPLATE("src", GST_PAD_SRC, GST_PAD_ALWAYS, GST_STATIC_CAPS(GST_FBS_GROUP_CAPS));

static void drop_group(GstRtpFbsDepay* self) {
  gst_adapter_clear(self->group);
  self->in_group = FALSE;
}

static void join(GstRtpFbsDepay* self) {
  drop_group(self);
  gst_adapter_clear(self->parts);
  self->waiting = TRUE;
  self->goes_on = self->incomplete = FALSE;
  self->requested = GST_CLOCK_TIME_NONE;
}

/* ---- after a loss ---- */

/* What has arrived waits so long in the jitter buffer before it comes here. */
static GstClockTime time_in_jitter_buffer(GstRtpFbsDepay* self) {
  GstQuery* const query = gst_query_new_latency();
  GstClockTime out = 0;
  if (gst_pad_peer_query(GST_RTP_BASE_DEPAYLOAD_SINKPAD(self), query))
    gst_query_parse_latency(query, NULL, &out, NULL);
  gst_query_unref(query);
  return out;
}

static void ask_for_scene(GstRtpFbsDepay* self, GstClockTime now) {
  if (!self->request_keyframe) return;
  if (GST_CLOCK_TIME_IS_VALID(self->requested) && GST_CLOCK_TIME_IS_VALID(now) &&
      now < self->requested + REQUEST_INTERVAL + time_in_jitter_buffer(self))
    return;
  GST_DEBUG_OBJECT(self, "asks for a scene");
  self->requested = now;
  gst_pad_push_event(GST_RTP_BASE_DEPAYLOAD_SINKPAD(self),
                     gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
}

static void wait_for_scene(GstRtpFbsDepay* self) {
  if (!self->waiting) GST_INFO_OBJECT(self, "a packet is lost, and with it the rest of its scene");
  drop_group(self);
  self->waiting = TRUE;
}

/* A packet is missing. If groups stand alone only its own is lost, unless that begins a scene: then the next
 * one is found damaged. */
static void lose(GstRtpFbsDepay* self) {
  if (!self->goes_on || (self->in_group && self->key)) {
    wait_for_scene(self);
    return;
  }
  GST_DEBUG_OBJECT(self, "a packet is lost, and with it its group");
  drop_group(self);
}

/* ---- groups ---- */

/* Reads the packets of a group, as a decoder would.
 * @return FALSE: they are damaged, or the beginning of their scene, or all of it, is missing */
static gboolean read_packets(GstRtpFbsDepay* self, const guint8* data, gsize size) {
  fbs_packet_info packet;
  fbs_status status;
  gboolean begins = !self->key, of_setup = self->key;
  if (self->key) {
    fbs_packet_reader_reset(self->reader);
    fbs_packet_reader_feed(self->reader, (const guint8*)FBS_SIGNATURE, FBS_SIGNATURE_SIZE);
    self->incomplete = FALSE;
  }
  fbs_packet_reader_feed(self->reader, data, size);
  while ((status = fbs_packet_reader_next(self->reader, &packet)) == FBS_OK) {
    if (packet.fault != NULL || packet.skipped) self->incomplete = TRUE;
    if (packet.type == FBS_PACKET_SETUP && packet.fault == NULL) {
      begins = of_setup = TRUE;
      self->restarted = packet.number < self->number || (packet.number == 0 && self->begun);
      self->number = packet.number;
    }
    if (packet.type == FBS_PACKET_RETURN && (packet.fault != NULL || packet.skipped)) begins = FALSE;
    if (!of_setup && (packet.type == FBS_PACKET_MOTION || packet.type == FBS_PACKET_UNIT))
      self->goes_on = packet.key != 0;
  }
  return begins && status == FBS_NEED_DATA;
}

/* Reads a group that comes while a scene is waited for, and keeps it if it has parts of the head.
 * @return whether the head is whole, so that the scene can be joined */
static gboolean join_with(GstRtpFbsDepay* self, const guint8* data, gsize size) {
  fbs_packet_info packet;
  fbs_status status;
  gboolean has_part = FALSE, joins = FALSE;
  fbs_packet_reader_feed(self->reader, data, size);
  while ((status = fbs_packet_reader_next(self->reader, &packet)) != FBS_NEED_DATA && status != FBS_END) {
    if (status != FBS_OK || packet.type != FBS_PACKET_HEAD_PART || packet.fault != NULL) continue;
    has_part = TRUE;
    joins = joins || packet.key;
  }
  if (gst_adapter_available(self->parts) > MAX_PARTS) gst_adapter_clear(self->parts);
  if (has_part) gst_adapter_push(self->parts, gst_buffer_new_memdup(data, size));
  return joins;
}

/* Reads a group, and tells the format of one that begins a scene.
 * @return FALSE: it is of no use */
static gboolean read_group(GstRtpFbsDepay* self) {
  const gsize size = gst_adapter_available(self->group);
  fbs_format format;
  const guint8* const data = gst_adapter_map(self->group, size);
  self->enters = self->key || data[0] == FBS_PACKET_SETUP || data[0] == FBS_PACKET_RETURN;
  const gboolean read =
      self->waiting && !self->enters ? join_with(self, data, size) : read_packets(self, data, size);
  gst_adapter_unmap(self->group);
  if (read && (self->key || self->waiting)) {
    if (fbs_packet_reader_get_format(self->reader, &format) != FBS_OK) return FALSE;
    gst_fbs_set_format(GST_RTP_BASE_DEPAYLOAD_SRCPAD(self), &format);
  }
  return read;
}

/* @return null: it is none */
static GstBuffer* whole_group(GstRtpFbsDepay* self) {
  if (!read_group(self)) {
    wait_for_scene(self);
    return NULL;
  }
  const gboolean joins = self->waiting && !self->enters;
  GstAdapter* const groups = joins ? self->parts : self->group; /* the group is the last of the parts */
  GstBuffer* out = gst_buffer_make_writable(gst_adapter_take_buffer(groups, gst_adapter_available(groups)));
  drop_group(self);
  if (joins) GST_INFO_OBJECT(self, "joins a scene by the parts of its head");
  self->waiting = FALSE;
  gst_adapter_clear(self->parts);
  if (!self->begun) {
    GstBuffer* const signature = gst_buffer_new_memdup(FBS_SIGNATURE, FBS_SIGNATURE_SIZE);
    out = gst_buffer_append(signature, out);
  }
  self->begun = TRUE;
  if (self->key || joins)
    GST_BUFFER_FLAG_UNSET(out, GST_BUFFER_FLAG_DELTA_UNIT);
  else
    GST_BUFFER_FLAG_SET(out, GST_BUFFER_FLAG_DELTA_UNIT);
  if (self->restarted) GST_BUFFER_FLAG_SET(out, GST_BUFFER_FLAG_DISCONT);
  self->restarted = FALSE;
  return out;
}

static void begin_group(GstRtpFbsDepay* self, guint8 header) {
  if (self->in_group) lose(self); /* its last packet did not come */
  self->in_group = TRUE;
  self->key = (header & GST_FBS_RTP_KEY) != 0;
  if (!self->key) return;
  self->waiting = FALSE;
  gst_adapter_clear(self->parts);
  self->requested = GST_CLOCK_TIME_NONE;
}

static GstBuffer* gst_rtp_fbs_depay_process(GstRTPBaseDepayload* depay, GstRTPBuffer* rtp) {
  GstRtpFbsDepay* const self = GST_RTP_FBS_DEPAY(depay);
  const guint size = gst_rtp_buffer_get_payload_len(rtp);
  const GstClockTime now = GST_BUFFER_PTS(rtp->buffer);
  if (GST_BUFFER_IS_DISCONT(rtp->buffer)) lose(self);
  if (size <= GST_FBS_RTP_HEADER) {
    lose(self);
    ask_for_scene(self, now);
    return NULL;
  }
  const guint8 header = *(const guint8*)gst_rtp_buffer_get_payload(rtp);
  if ((header & GST_FBS_RTP_START) != 0)
    begin_group(self, header);
  else if (!self->in_group || gst_adapter_available(self->group) > MAX_GROUP)
    lose(self);
  GstBuffer* out = NULL;
  if (self->in_group) {
    gst_adapter_push(self->group, gst_rtp_buffer_get_payload_subbuffer(rtp, GST_FBS_RTP_HEADER, (guint)-1));
    if (gst_rtp_buffer_get_marker(rtp)) out = whole_group(self);
  }
  if (self->waiting || self->incomplete) ask_for_scene(self, now);
  return out;
}

/* The jitter buffer (do-lost) says so when the packet should have been there, a group before the next one
 * comes. */
static gboolean gst_rtp_fbs_depay_packet_lost(GstRTPBaseDepayload* depay, GstEvent* event) {
  GstRtpFbsDepay* const self = GST_RTP_FBS_DEPAY(depay);
  const GstStructure* const lost = gst_event_get_structure(event);
  guint64 now = GST_CLOCK_TIME_NONE;
  gboolean may_be_parity = FALSE;
  gst_structure_get_boolean(lost, "might-have-been-fec", &may_be_parity);
  gst_structure_get_uint64(lost, "timestamp", &now);
  if (may_be_parity) return TRUE;
  lose(self);
  if (self->waiting) ask_for_scene(self, now);
  return TRUE; /* no gap: the picture is held */
}

static gboolean gst_rtp_fbs_depay_set_caps(GstRTPBaseDepayload* depay, GstCaps* caps) {
  gint rate = FBS_TICKS_PER_SECOND;
  gst_structure_get_int(gst_caps_get_structure(caps, 0), "clock-rate", &rate);
  depay->clock_rate = (guint)rate;
  return TRUE; /* the scene says the rest */
}

/* ---- life ---- */

static gboolean gst_rtp_fbs_depay_handle_event(GstRTPBaseDepayload* depay, GstEvent* event) {
  if (GST_EVENT_TYPE(event) == GST_EVENT_FLUSH_STOP) join(GST_RTP_FBS_DEPAY(depay));
  return GST_RTP_BASE_DEPAYLOAD_CLASS(gst_rtp_fbs_depay_parent_class)->handle_event(depay, event);
}

static GstStateChangeReturn gst_rtp_fbs_depay_change_state(GstElement* element, GstStateChange change) {
  GstRtpFbsDepay* const self = GST_RTP_FBS_DEPAY(element);
  if (change == GST_STATE_CHANGE_READY_TO_PAUSED) {
    join(self);
    self->begun = self->restarted = FALSE;
    self->number = 0;
  }
  return GST_ELEMENT_CLASS(gst_rtp_fbs_depay_parent_class)->change_state(element, change);
}

static void gst_rtp_fbs_depay_set_property(GObject* object, guint id, const GValue* value, GParamSpec* spec) {
  if (id == PROP_REQUEST_KEYFRAME)
    GST_RTP_FBS_DEPAY(object)->request_keyframe = g_value_get_boolean(value);
  else
    G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void gst_rtp_fbs_depay_get_property(GObject* object, guint id, GValue* value, GParamSpec* spec) {
  if (id == PROP_REQUEST_KEYFRAME)
    g_value_set_boolean(value, GST_RTP_FBS_DEPAY(object)->request_keyframe);
  else
    G_OBJECT_WARN_INVALID_PROPERTY_ID(object, id, spec);
}

static void gst_rtp_fbs_depay_finalize(GObject* object) {
  g_object_unref(GST_RTP_FBS_DEPAY(object)->group);
  g_object_unref(GST_RTP_FBS_DEPAY(object)->parts);
  fbs_packet_reader_close(&GST_RTP_FBS_DEPAY(object)->reader);
  G_OBJECT_CLASS(gst_rtp_fbs_depay_parent_class)->finalize(object);
}

static void gst_rtp_fbs_depay_class_init(GstRtpFbsDepayClass* type) {
  GObjectClass* const object = G_OBJECT_CLASS(type);
  GstElementClass* const element = GST_ELEMENT_CLASS(type);
  GstRTPBaseDepayloadClass* const depay = GST_RTP_BASE_DEPAYLOAD_CLASS(type);
  GST_DEBUG_CATEGORY_INIT(rtp_fbs_depay_debug, "rtpfbsdepay", 0, "RTP fbs depayloader");

  object->set_property = gst_rtp_fbs_depay_set_property;
  object->get_property = gst_rtp_fbs_depay_get_property;
  object->finalize = gst_rtp_fbs_depay_finalize;
  g_object_class_install_property(
      object, PROP_REQUEST_KEYFRAME,
      g_param_spec_boolean("request-keyframe", "Request keyframe",
                           "Ask the sender for a scene (GstForceKeyUnit) when packets are lost",
                           DEFAULT_REQUEST_KEYFRAME, G_PARAM_READWRITE | G_PARAM_STATIC_STRINGS));
  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  gst_element_class_set_static_metadata(element, "RTP fbs depayloader", "Codec/Depayloader/Network/RTP",
                                        "Takes fbs, the video of a talking head, out of RTP packets",
                                        "The fbs authors");
  element->change_state = gst_rtp_fbs_depay_change_state;
  depay->set_caps = gst_rtp_fbs_depay_set_caps;
  depay->process_rtp_packet = gst_rtp_fbs_depay_process;
  depay->packet_lost = gst_rtp_fbs_depay_packet_lost;
  depay->handle_event = gst_rtp_fbs_depay_handle_event;
}

static void gst_rtp_fbs_depay_init(GstRtpFbsDepay* self) {
  self->group = gst_adapter_new();
  self->parts = gst_adapter_new();
  fbs_packet_reader_open(&self->reader); /* null without memory: no group is read */
  self->request_keyframe = DEFAULT_REQUEST_KEYFRAME;
  join(self);
}
