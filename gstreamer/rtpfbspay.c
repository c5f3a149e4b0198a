/**
 * SECTION:element-rtpfbspay
 * @title: rtpfbspay
 *
 * Puts fbs into RTP packets, as docs/rtp.md says.
 *
 * |[
 * gst-launch-1.0 v4l2src ! videoconvert ! fbsenc bitrate=10000 ! rtpfbspay ! udpsink host=127.0.0.1 port=5004
 * ]|
 */
#include <gst/rtp/gstrtpbasepayload.h>
#include <gst/rtp/gstrtpbuffer.h>

#include "caps.h"
#include "elements.h"
#include "rtp_payload.h"

typedef struct {
  GstRTPBasePayload parent;
} GstRtpFbsPay;

typedef struct {
  GstRTPBasePayloadClass parent;
} GstRtpFbsPayClass;

GType gst_rtp_fbs_pay_get_type(void);
G_DEFINE_TYPE(GstRtpFbsPay, gst_rtp_fbs_pay, GST_TYPE_RTP_BASE_PAYLOAD)
GST_ELEMENT_REGISTER_DEFINE(rtpfbspay, "rtpfbspay", GST_RANK_SECONDARY, gst_rtp_fbs_pay_get_type())

static GstStaticPadTemplate sink_template =
    GST_STATIC_PAD_TEMPLATE("sink", GST_PAD_SINK, GST_PAD_ALWAYS, GST_STATIC_CAPS(GST_FBS_GROUP_CAPS));
static GstStaticPadTemplate src_template = GST_STATIC_PAD_TEMPLATE(
    "src", GST_PAD_SRC, GST_PAD_ALWAYS,
    GST_STATIC_CAPS("application/x-rtp, payload = (int) " GST_RTP_PAYLOAD_DYNAMIC_STRING
                    ", " GST_FBS_RTP_CAPS_FIELDS));

static gboolean gst_rtp_fbs_pay_set_caps(GstRTPBasePayload* pay, GstCaps* caps) {
  gchar version[12];
  (void)caps;
  g_snprintf(version, sizeof version, "%u", fbs_format_version());
  gst_rtp_base_payload_set_options(pay, "video", TRUE, "FBS", FBS_TICKS_PER_SECOND);
  return gst_rtp_base_payload_set_outcaps(pay, "version", G_TYPE_STRING, version, NULL);
}

/* Bytes at..at + size of the group. */
static GstBuffer* rtp_packet(GstRTPBasePayload* pay, GstBuffer* group, gsize at, gsize size, guint8 header,
                             gboolean last) {
  GstBuffer* const out = gst_rtp_base_payload_allocate_output_buffer(pay, GST_FBS_RTP_HEADER, 0, 0);
  GstRTPBuffer rtp = GST_RTP_BUFFER_INIT;
  gst_rtp_buffer_map(out, GST_MAP_READWRITE, &rtp);
  *(guint8*)gst_rtp_buffer_get_payload(&rtp) = header;
  gst_rtp_buffer_set_marker(&rtp, last);
  gst_rtp_buffer_unmap(&rtp);
  if (last) GST_BUFFER_FLAG_SET(out, GST_BUFFER_FLAG_MARKER);
  gst_buffer_copy_into(out, group, GST_BUFFER_COPY_MEMORY, at, size);
  GST_BUFFER_PTS(out) = GST_BUFFER_PTS(group);
  return out;
}

static GstFlowReturn gst_rtp_fbs_pay_handle_buffer(GstRTPBasePayload* pay, GstBuffer* group) {
  guint8 begin[FBS_SIGNATURE_SIZE + 1] = {0};
  const gsize looked_at = gst_buffer_extract(group, 0, begin, sizeof begin);
  const gsize signature = gst_fbs_signature_at(begin, looked_at), size = gst_buffer_get_size(group);
  const guint8 key = GST_BUFFER_FLAG_IS_SET(group, GST_BUFFER_FLAG_DELTA_UNIT) ? 0 : GST_FBS_RTP_KEY;
  const guint room = gst_rtp_buffer_calc_payload_len(GST_RTP_BASE_PAYLOAD_MTU(pay), 0, 0);
  const gsize most = MAX(room, GST_FBS_RTP_HEADER + 1) - GST_FBS_RTP_HEADER;
  GstBufferList* const list = gst_buffer_list_new();
  for (gsize at = signature; at < size; at += most) {
    const gsize piece = MIN(most, size - at);
    const guint8 header = at == signature ? GST_FBS_RTP_START | key : key;
    gst_buffer_list_add(list, rtp_packet(pay, group, at, piece, header, at + piece == size));
  }
  gst_buffer_unref(group);
  if (gst_buffer_list_length(list) > 0) return gst_rtp_base_payload_push_list(pay, list);
  gst_buffer_list_unref(list);
  return GST_FLOW_OK;
}

static void gst_rtp_fbs_pay_class_init(GstRtpFbsPayClass* type) {
  GstElementClass* const element = GST_ELEMENT_CLASS(type);
  GstRTPBasePayloadClass* const pay = GST_RTP_BASE_PAYLOAD_CLASS(type);
  gst_element_class_add_static_pad_template(element, &sink_template);
  gst_element_class_add_static_pad_template(element, &src_template);
  gst_element_class_set_static_metadata(element, "RTP fbs payloader", "Codec/Payloader/Network/RTP",
                                        "Puts fbs, the video of a talking head, into RTP packets",
                                        "The fbs authors");
  pay->set_caps = gst_rtp_fbs_pay_set_caps;
  pay->handle_buffer = gst_rtp_fbs_pay_handle_buffer;
}

static void gst_rtp_fbs_pay_init(GstRtpFbsPay* self) {
  (void)self;
}
