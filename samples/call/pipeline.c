#include "pipeline.h"

#include <gst/video/video.h>
#include <stdio.h>

#include "retransmission.h"

#define SESSION_BANDWIDTH 400000 /* bit/s */
#define FIRST_SCENE (2 * GST_SECOND)
#define REPORT_INTERVAL (1 * GST_SECOND)

/* The text of the pipeline, in the syntax of gst-launch-1.0. Pictures leave `clocksync` when they would leave
 * a camera, sound when the 20 ms of a packet have been recorded. */

static char* sending(const CallOptions* o) {
  return g_strdup_printf(
      "filesrc name=picture_file ! decodebin ! videoconvert ! video/x-raw,format=I420 ! queue ! clocksync "
      " ! queue leaky=downstream max-size-buffers=2 ! fbsenc name=encoder bitrate=%d delay=%f "
      "resilience=%s ! rtpfbspay "
      "name=picture_out pt=%d "
      "filesrc name=sound_file ! decodebin ! audioconvert ! audioresample ! "
      "audio/x-raw,rate=48000,channels=1 "
      " ! audiobuffersplit output-buffer-duration=1/50 ! queue ! clocksync ts-offset=20000000 "
      " ! opusenc name=voice_encoder bitrate=%d audio-type=voice inband-fec=true packet-loss-percentage=%d "
      " ! rtpopuspay name=voice_out pt=%d ",
      o->bitrate, o->delay, o->repair == REPAIR_NONE ? "strong" : "packet", PAYLOAD_PICTURES,
      o->sound_bitrate, o->loss > 0 ? 10 : 0, PAYLOAD_VOICE);
}

static char* receiving(const CallOptions* o) {
  return g_strdup_printf(
      "rtpfbsdepay name=picture_in ! fbsdec name=decoder ! tee name=seen "
      " ! queue ! fakesink name=screen sync=true signal-handoffs=true async=false "
      "rtpopusdepay name=voice_in ! opusdec name=voice_decoder plc=true use-inband-fec=true ! tee name=heard "
      " ! queue ! fakesink name=ear sync=true signal-handoffs=true async=false %s",
      o->show ? "seen. ! queue ! videoconvert ! autovideosink "
                "heard. ! queue ! audioconvert ! audioresample ! autoaudiosink "
              : "");
}

static const char* const caps[SESSIONS] = {
    "application/"
    "x-rtp,media=video,clock-rate=90000,encoding-name=FBS,payload=96,rtcp-fb-nack-pli=(boolean)true",
    "application/x-rtp,media=audio,clock-rate=48000,encoding-name=OPUS,payload=97"};

static char* netsim(const CallOptions* o, guint number) {
  return g_strdup_printf(
      "netsim name=network%u delay-probability=1 min-delay=%d max-delay=%d allow-reordering=false ! "
      "queue name=bottleneck%u max-size-buffers=0 max-size-bytes=0 max-size-time=0",
      number, o->min_delay, o->max_delay, number);
}

/* A session has two ports: for RTP and for RTCP. */
static char* network(const CallOptions* o, guint session) {
  const gint port = o->port + 2 * (gint)session, peer_port = o->peer_port + 2 * (gint)session;
  char* const rtp = netsim(o, 2 * session);
  char* const rtcp = netsim(o, 2 * session + 1);
  char* const out = g_strdup_printf(
      "tee name=send%u ! %s ! funnel name=out%u ! udpsink host=%s port=%d sync=false async=false "
      "identity name=report%u ! %s ! udpsink host=%s port=%d sync=false async=false "
      "udpsrc name=receive%u port=%d caps=%s udpsrc name=reports%u port=%d caps=application/x-rtcp ",
      session, rtp, session, o->peer, peer_port, session, rtcp, o->peer, peer_port + 1, session, port,
      caps[session], session, port + 1);
  g_free(rtp);
  g_free(rtcp);
  return out;
}

/* Sends the same packets again, so much later that a burst of losses takes only one of the two. The jitter
 * buffer drops the second one by its number; RFC 7198 gives copies a source of their own, for the sake of
 * statistics. They leave from the same port: rtpbin takes another one for a collision of sources. */
static char* copies(const CallOptions* o) {
  if ((o->repair & REPAIR_COPY) == 0) return g_strdup("");
  char* const rtp = netsim(o, 4);
  char* const out =
      g_strdup_printf("send0. ! netsim delay-probability=1 min-delay=%d max-delay=%d ! %s ! out0. ",
                      COPY_DELAY, COPY_DELAY, rtp);
  g_free(rtp);
  return out;
}

static GstElement* elements_of(const CallOptions* o) {
  char* parts[] = {sending(o), receiving(o), network(o, SESSION_PICTURES), network(o, SESSION_VOICE),
                   copies(o),  NULL};
  char* const text = g_strjoinv(NULL, parts);
  GError* error = NULL;
  GstElement* const out = gst_parse_launch_full(text, NULL, GST_PARSE_FLAG_FATAL_ERRORS, &error);
  if (out == NULL) fprintf(stderr, "call: %s\n", error->message);
  g_clear_error(&error);
  g_free(text);
  for (guint k = 0; parts[k] != NULL; ++k) g_free(parts[k]);
  return out;
}

/* ---- the sessions ---- */

static GstCaps* caps_of(GstElement* rtp, guint session, guint payload, gpointer user) {
  (void)rtp;
  (void)user;
  if (payload == PAYLOAD_PICTURES || payload == PAYLOAD_VOICE) return gst_caps_from_string(caps[session]);
  return gst_caps_new_simple("application/x-rtp", "clock-rate", G_TYPE_INT,
                             session == SESSION_VOICE ? 48000 : 90000, NULL);
}

/* A new viewer need not ask for a scene. Not at the beginning of the call: a second scene so soon after the
 * first one has little of the rate left. */
static void on_source(GstElement* rtp, guint session, guint source, gpointer pipeline) {
  (void)rtp;
  (void)source;
  if (session != SESSION_PICTURES || gst_element_get_current_running_time(pipeline) < FIRST_SCENE) return;
  GstElement* const encoder = gst_bin_get_by_name(pipeline, "encoder");
  GstPad* const pad = gst_element_get_static_pad(encoder, "src");
  gst_pad_send_event(pad, gst_video_event_new_upstream_force_key_unit(GST_CLOCK_TIME_NONE, TRUE, 0));
  gst_object_unref(pad);
  gst_object_unref(encoder);
}

/* A stream of the peer begins; after another call of the peer, it replaces the previous one. */
static void on_stream(GstElement* rtp, GstPad* pad, gpointer pipeline) {
  guint session = 0, source = 0, payload = 0;
  char* const name = gst_pad_get_name(pad);
  const gboolean received = sscanf(name, "recv_rtp_src_%u_%u_%u", &session, &source, &payload) == 3;
  g_free(name);
  (void)rtp;
  if (!received) return;
  GstElement* const depay =
      gst_bin_get_by_name(pipeline, session == SESSION_PICTURES ? "picture_in" : "voice_in");
  GstPad* const sink = gst_element_get_static_pad(depay, "sink");
  GstPad* const before = gst_pad_get_peer(sink);
  if (before != NULL) {
    gst_pad_unlink(before, sink);
    gst_object_unref(before);
  }
  gst_pad_link(pad, sink);
  gst_object_unref(sink);
  gst_object_unref(depay);
}

/* Report times are recording times, so that picture and voice are shown in step. They use this machine's
 * clock, which gives the delay from end to end if the other end has the same. */
static GstElement* sessions_of(const CallOptions* options, GstElement* pipeline) {
  GstElement* const rtp = gst_element_factory_make("rtpbin", "rtp");
  if (rtp == NULL) {
    fputs("call: no element \"rtpbin\"\n", stderr);
    return NULL;
  }
  gst_util_set_object_arg(G_OBJECT(rtp), "rtp-profile", "avpf");
  gst_util_set_object_arg(G_OBJECT(rtp), "ntp-time-source", "clock-time");
  g_object_set(rtp, "latency", options->latency, "do-lost", TRUE, "rtcp-sync-send-time", FALSE,
               "add-reference-timestamp-meta", TRUE, NULL);
  g_signal_connect(rtp, "request-pt-map", G_CALLBACK(caps_of), NULL);
  g_signal_connect(rtp, "on-new-ssrc", G_CALLBACK(on_source), pipeline);
  g_signal_connect(rtp, "pad-added", G_CALLBACK(on_stream), pipeline);
  if ((options->repair & REPAIR_RTX) != 0) retransmission_connect(rtp, options);
  gst_bin_add(GST_BIN(pipeline), rtp);
  return rtp;
}

/* Lets requests go out at once. RTCP may use a twentieth of this, far more than reports need: regular ones
 * keep to REPORT_INTERVAL. */
static void hurry_feedback(GstElement* pipeline) {
  GstElement* const rtp = gst_bin_get_by_name(GST_BIN(pipeline), "rtp");
  for (guint k = 0; k < SESSIONS; ++k) {
    GObject* session = NULL;
    g_signal_emit_by_name(rtp, "get-internal-session", k, &session);
    g_object_set(session, "bandwidth", (gdouble)SESSION_BANDWIDTH, "rtcp-min-interval",
                 (guint64)REPORT_INTERVAL, "rtcp-reduced-size", TRUE, NULL);
    g_object_unref(session);
  }
  gst_object_unref(rtp);
}

/* Requests pads of rtpbin, for sending before those that appear later. */
static gboolean link_sessions(GstElement* pipeline) {
  static const char* const links[][4] = {
      {"picture_out", "src", "rtp", "send_rtp_sink_0"}, {"voice_out", "src", "rtp", "send_rtp_sink_1"},
      {"rtp", "send_rtp_src_0", "send0", "sink"},       {"rtp", "send_rtcp_src_0", "report0", "sink"},
      {"rtp", "send_rtp_src_1", "send1", "sink"},       {"rtp", "send_rtcp_src_1", "report1", "sink"},
      {"receive0", "src", "rtp", "recv_rtp_sink_0"},    {"reports0", "src", "rtp", "recv_rtcp_sink_0"},
      {"receive1", "src", "rtp", "recv_rtp_sink_1"},    {"reports1", "src", "rtp", "recv_rtcp_sink_1"}};
  gboolean linked = TRUE;
  for (guint k = 0; k < G_N_ELEMENTS(links); ++k) {
    GstElement* const from = gst_bin_get_by_name(GST_BIN(pipeline), links[k][0]);
    GstElement* const to = gst_bin_get_by_name(GST_BIN(pipeline), links[k][2]);
    linked = linked && gst_element_link_pads(from, links[k][1], to, links[k][3]);
    gst_object_unref(from);
    gst_object_unref(to);
  }
  return linked;
}

static void set_location(GstElement* pipeline, const char* name, const char* file) {
  GstElement* const source = gst_bin_get_by_name(GST_BIN(pipeline), name);
  g_object_set(source, "location", file, NULL);
  gst_object_unref(source);
}

GstElement* pipeline_new(const CallOptions* options) {
  GstElement* const pipeline = elements_of(options);
  if (pipeline == NULL) return NULL;
  set_location(pipeline, "picture_file", options->pictures);
  set_location(pipeline, "sound_file", options->sound);
  if (sessions_of(options, pipeline) == NULL || !link_sessions(pipeline)) {
    gst_object_unref(pipeline);
    return NULL;
  }
  hurry_feedback(pipeline);
  return pipeline;
}
