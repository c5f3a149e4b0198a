#include "pipeline.h"

#include <stdio.h>

#include "repair.h"

/* The text of the pipeline, as gst-launch-1.0 would take it. Pictures leave `clocksync` when they would leave
 * a camera, sound when the 20 ms of a packet have been recorded. */

static char* sending(const CallOptions* o) {
  return g_strdup_printf(
      "filesrc name=picture_file ! decodebin ! videoconvert ! video/x-raw,format=I420 ! queue ! clocksync "
      " ! queue leaky=downstream max-size-buffers=2 ! fbsenc name=encoder bitrate=%d delay=%f ! rtpfbspay name=picture_out pt=%d "
      "filesrc name=sound_file ! decodebin ! audioconvert ! audioresample ! "
      "audio/x-raw,rate=48000,channels=1 "
      " ! audiobuffersplit output-buffer-duration=1/50 ! queue ! clocksync ts-offset=20000000 "
      " ! opusenc name=voice_encoder bitrate=%d audio-type=voice inband-fec=true packet-loss-percentage=%d "
      " ! rtpopuspay name=voice_out pt=%d ",
      o->bitrate, o->delay, PAYLOAD_PICTURES, o->sound_bitrate, o->loss > 0 ? 10 : 0, PAYLOAD_VOICE);
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

/* A session has two ports: of RTP and of RTCP. */
static char* network(const CallOptions* o, guint session) {
  const gint port = o->port + 2 * (gint)session, peer_port = o->peer_port + 2 * (gint)session;
  GString* const out = g_string_new(NULL);
  for (gint rtcp = 0; rtcp < 2; ++rtcp)
    g_string_append_printf(
        out,
        "netsim name=network%u delay-probability=1 min-delay=%d max-delay=%d allow-reordering=false "
        " ! udpsink host=%s port=%d sync=false async=false "
        "udpsrc name=socket%u port=%d caps=application/x-%s ",
        2 * session + (guint)rtcp, o->min_delay, o->max_delay, o->peer, peer_port + rtcp,
        2 * session + (guint)rtcp, port + rtcp, rtcp ? "rtcp" : "rtp");
  return g_string_free(out, FALSE);
}

static GstElement* elements_of(const CallOptions* o) {
  char* parts[] = {sending(o), receiving(o), network(o, SESSION_PICTURES), network(o, SESSION_VOICE), NULL};
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
  switch (payload) {
    case PAYLOAD_PICTURES:
      return gst_caps_from_string(
          "application/x-rtp,media=video,clock-rate=90000,encoding-name=FBS,rtcp-fb-nack-pli=(boolean)true");
    case PAYLOAD_VOICE:
      return gst_caps_from_string("application/x-rtp,media=audio,clock-rate=48000,encoding-name=OPUS");
    case PAYLOAD_FEC:
      return gst_caps_from_string("application/x-rtp,media=video,clock-rate=90000,encoding-name=ULPFEC");
    default:
      return gst_caps_new_simple("application/x-rtp", "encoding-name", G_TYPE_STRING, "RTX", "clock-rate",
                                 G_TYPE_INT, session == SESSION_VOICE ? 48000 : 90000, NULL);
  }
}

/* A stream of the peer begins; if it has called again, it takes the place of the one before. */
static void on_stream(GstElement* rtp, GstPad* pad, gpointer pipeline) {
  guint session = 0, source = 0, payload = 0;
  char* const name = gst_pad_get_name(pad);
  const gboolean received = sscanf(name, "recv_rtp_src_%u_%u_%u", &session, &source, &payload) == 3;
  g_free(name);
  (void)rtp;
  if (!received || (payload != PAYLOAD_PICTURES && payload != PAYLOAD_VOICE)) return;
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

/* The times of reports are those of the recording, so that picture and voice are shown in step. They are of
 * the clock of this machine, which tells the delay from end to end if the other end has the same. */
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
  g_signal_connect(rtp, "pad-added", G_CALLBACK(on_stream), pipeline);
  repair_connect(options->repair, rtp);
  gst_bin_add(GST_BIN(pipeline), rtp);
  return rtp;
}

/* Requests pads of rtpbin, for sending before those that appear then. */
static gboolean link_sessions(GstElement* pipeline) {
  static const char* const links[][4] = {
      {"picture_out", "src", "rtp", "send_rtp_sink_0"}, {"voice_out", "src", "rtp", "send_rtp_sink_1"},
      {"rtp", "send_rtp_src_0", "network0", "sink"},    {"rtp", "send_rtcp_src_0", "network1", "sink"},
      {"rtp", "send_rtp_src_1", "network2", "sink"},    {"rtp", "send_rtcp_src_1", "network3", "sink"},
      {"socket0", "src", "rtp", "recv_rtp_sink_0"},     {"socket1", "src", "rtp", "recv_rtcp_sink_0"},
      {"socket2", "src", "rtp", "recv_rtp_sink_1"},     {"socket3", "src", "rtp", "recv_rtcp_sink_1"}};
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
  GstElement* pipeline = elements_of(options);
  if (pipeline == NULL) return NULL;
  set_location(pipeline, "picture_file", options->pictures);
  set_location(pipeline, "sound_file", options->sound);
  if (sessions_of(options, pipeline) == NULL || !link_sessions(pipeline))
    g_clear_pointer(&pipeline, gst_object_unref);
  return pipeline;
}
