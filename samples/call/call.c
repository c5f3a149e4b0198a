/* One end of a call: sends face and voice from files as if they came from a camera and a microphone, and
 * receives those of the other end. README.md shows how two of them talk to each other.
 *
 *   options     the command line
 *   pipeline    the elements, and how rtpbin connects them
 *   retransmission  retransmission of lost packets
 *   network     loses, delays and queues packets
 *   rate        the bit rate of the pictures follows the link
 *   receiver    when pictures and sound are seen and heard
 *   statistics  one line per second */
#include <glib-unix.h>
#include <gst/gst.h>
#include <stdio.h>

#include "network.h"
#include "options.h"
#include "pipeline.h"
#include "rate.h"
#include "receiver.h"
#include "statistics.h"

typedef struct {
  GMainLoop* loop;
  Statistics statistics;
  gdouble seconds_left;
  int result;
} Call;

static gboolean on_second(gpointer user) {
  Call* const call = user;
  statistics_print(&call->statistics);
  call->seconds_left -= 1;
  if (call->seconds_left <= 0) g_main_loop_quit(call->loop);
  return G_SOURCE_CONTINUE;
}

static gboolean on_signal(gpointer user) {
  g_main_loop_quit(((Call*)user)->loop);
  return G_SOURCE_CONTINUE;
}

static gboolean on_message(GstBus* bus, GstMessage* message, gpointer user) {
  Call* const call = user;
  GError* error = NULL;
  (void)bus;
  if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_LATENCY) {
    gst_bin_recalculate_latency(GST_BIN(call->statistics.pipeline));
  } else if (GST_MESSAGE_TYPE(message) == GST_MESSAGE_ERROR) {
    gst_message_parse_error(message, &error, NULL);
    fprintf(stderr, "call: %s: %s\n", GST_MESSAGE_SRC_NAME(message), error->message);
    g_clear_error(&error);
    call->result = 1;
    g_main_loop_quit(call->loop);
  }
  return G_SOURCE_CONTINUE;
}

static void talk(Call* call, GstElement* pipeline) {
  GstBus* const bus = gst_pipeline_get_bus(GST_PIPELINE(pipeline));
  gst_bus_add_watch(bus, on_message, call);
  const guint sources[] = {g_timeout_add(1000, on_second, call), g_unix_signal_add(2, on_signal, call),
                           g_unix_signal_add(15, on_signal, call)};
  gst_element_set_state(pipeline, GST_STATE_PLAYING);
  g_main_loop_run(call->loop);
  statistics_print_total(&call->statistics);
  gst_element_set_state(pipeline, GST_STATE_NULL);
  for (guint k = 0; k < G_N_ELEMENTS(sources); ++k) g_source_remove(sources[k]);
  gst_bus_remove_watch(bus);
  gst_object_unref(bus);
}

static int run(const CallOptions* options) {
  GstElement* const pipeline = pipeline_new(options);
  if (pipeline == NULL) return 1;
  Call call = {.loop = g_main_loop_new(NULL, FALSE), .seconds_left = options->seconds};
  Network network;
  Rate rate;
  Receiver receiver;
  network_init(&network, options, pipeline);
  rate_init(&rate, options, pipeline);
  if (receiver_init(&receiver, pipeline, options->record)) {
    statistics_init(&call.statistics, pipeline, &network, &rate, &receiver);
    talk(&call, pipeline);
    statistics_clear(&call.statistics);
  } else {
    call.result = 1;
  }
  gst_object_unref(pipeline);
  receiver_clear(&receiver);
  rate_clear(&rate);
  network_clear(&network);
  g_main_loop_unref(call.loop);
  return call.result;
}

int main(int argc, char** argv) {
  CallOptions options;
  gst_init(&argc, &argv);
  const int result = call_options_parse(&options, &argc, &argv) ? run(&options) : 2;
  call_options_clear(&options);
  gst_deinit();
  return result;
}
