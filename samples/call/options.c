#include "options.h"

#include <glib/gstdio.h>
#include <stdio.h>
#include <unistd.h>

static gboolean parse_repair(const char* name, Repair* out) {
  static const char* const names[] = {"none", "rtx", "copy", "both"};
  for (guint k = 0; k < G_N_ELEMENTS(names); ++k)
    if (g_strcmp0(name, names[k]) == 0) {
      *out = (Repair)k;
      return TRUE;
    }
  return FALSE;
}

static gboolean parse_capacity(const char* text, CallOptions* out) {
  char** const parts = g_strsplit(text, ",", MAX_CAPACITIES + 1);
  gboolean valid = g_strv_length(parts) <= MAX_CAPACITIES;
  for (guint k = 0; valid && parts[k] != NULL; ++k) {
    char* end = NULL;
    out->capacity[k] = g_ascii_strtod(parts[k], &end);
    valid = end != parts[k] && *end == 0 && out->capacity[k] >= 1 && out->capacity[k] <= 1e6;
    out->capacities = k + 1;
  }
  g_strfreev(parts);
  return valid && out->capacities > 0;
}

static gboolean readable(const char* file) {
  if (g_access(file, R_OK) == 0) return TRUE;
  fprintf(stderr, "call: cannot read %s\n", file);
  return FALSE;
}

static const char* fault_of(const CallOptions* o) {
  if (o->pictures == NULL || o->sound == NULL) return "--pictures and --sound name the files that are sent";
  if (o->port < 1 || o->port > 65532 || o->peer_port < 1 || o->peer_port > 65532)
    return "ports are 1 to 65532";
  if (o->loss < 0 || o->loss >= 1 || o->burst < 0) return "--loss is 0 to 1, --burst milliseconds";
  if (o->min_delay < 0 || o->max_delay < o->min_delay)
    return "--max-delay is at least --min-delay, and that 0";
  if (o->queue < 1 || o->queue > 10000) return "--queue is 1 to 10000 ms";
  if ((o->min_bitrate != 0 || o->max_bitrate != 0) &&
      (o->min_bitrate < 1 || o->min_bitrate > o->bitrate || o->max_bitrate < o->bitrate))
    return "--bitrate lies between --min-bitrate and --max-bitrate, and both are given";
  if (o->bitrate < 1 || o->sound_bitrate < 1 || o->delay <= 0 || o->latency < 0 || o->seconds <= 0)
    return "rates, times and lengths are positive";
  return NULL;
}

gboolean call_options_parse(CallOptions* out, int* argc, char*** argv) {
  char *repair = NULL, *capacity = NULL;
  *out = (CallOptions){.port = 5000,
                       .peer_port = 5010,
                       .bitrate = 10000,
                       .sound_bitrate = 12000,
                       .delay = 0.2,
                       .latency = 400,
                       .queue = 1000,
                       .seconds = 20};
  const GOptionEntry entries[] = {
      {"pictures", 0, 0, G_OPTION_ARG_FILENAME, &out->pictures, "Video that is sent", "FILE"},
      {"sound", 0, 0, G_OPTION_ARG_FILENAME, &out->sound, "Voice that is sent, perhaps of the same file",
       "FILE"},
      {"peer", 0, 0, G_OPTION_ARG_STRING, &out->peer, "Host of the other end (127.0.0.1)", "HOST"},
      {"port", 0, 0, G_OPTION_ARG_INT, &out->port, "First of four ports of this end (5000)", "N"},
      {"peer-port", 0, 0, G_OPTION_ARG_INT, &out->peer_port, "And of the other end (5010)", "N"},
      {"bitrate", 0, 0, G_OPTION_ARG_INT, &out->bitrate, "Pictures, bit/s (10000)", "N"},
      {"min-bitrate", 0, 0, G_OPTION_ARG_INT, &out->min_bitrate, "Their rate follows the link down to this",
       "N"},
      {"max-bitrate", 0, 0, G_OPTION_ARG_INT, &out->max_bitrate, "And up to this (it does not)", "N"},
      {"sound-bitrate", 0, 0, G_OPTION_ARG_INT, &out->sound_bitrate, "Voice, bit/s (12000)", "N"},
      {"delay", 0, 0, G_OPTION_ARG_DOUBLE, &out->delay, "Pictures are coded in groups of so long (0.2)", "S"},
      {"latency", 0, 0, G_OPTION_ARG_INT, &out->latency, "Of the jitter buffer (400)", "MS"},
      {"repair", 0, 0, G_OPTION_ARG_STRING, &repair, "Of lost packets: none, rtx, copy or both (none)",
       "HOW"},
      {"loss", 0, 0, G_OPTION_ARG_DOUBLE, &out->loss, "Share of the packets sent that is lost (0)", "0..1"},
      {"burst", 0, 0, G_OPTION_ARG_DOUBLE, &out->burst, "Losses last so long on average (0: one packet)",
       "MS"},
      {"min-delay", 0, 0, G_OPTION_ARG_INT, &out->min_delay, "Of the network (0)", "MS"},
      {"max-delay", 0, 0, G_OPTION_ARG_INT, &out->max_delay, "Of the network (0)", "MS"},
      {"capacity", 0, 0, G_OPTION_ARG_STRING, &capacity,
       "Of the network, kbit/s, each for an equal part of the call (no limit)", "N,N,..."},
      {"queue", 0, 0, G_OPTION_ARG_INT, &out->queue, "What would wait longer for it is lost (1000)", "MS"},
      {"seed", 0, 0, G_OPTION_ARG_INT, &out->seed, "Of the losses (0)", "N"},
      {"seconds", 0, 0, G_OPTION_ARG_DOUBLE, &out->seconds, "How long the call lasts (20)", "S"},
      {"show", 0, 0, G_OPTION_ARG_NONE, &out->show, "In a window and a loudspeaker", NULL},
      {"record", 0, 0, G_OPTION_ARG_FILENAME, &out->record, "Write what arrives: .csv, .yuv, .pcm", "PREFIX"},
      {NULL, 0, 0, G_OPTION_ARG_NONE, NULL, NULL, NULL}};
  GOptionContext* const context = g_option_context_new("- one end of a call");
  g_option_context_add_main_entries(context, entries, NULL);
  GError* error = NULL;
  const char* fault = NULL;
  if (!g_option_context_parse(context, argc, argv, &error))
    fault = error->message;
  else if (repair != NULL && !parse_repair(repair, &out->repair))
    fault = "--repair is none, rtx, copy or both";
  else if (capacity != NULL && !parse_capacity(capacity, out))
    fault = "--capacity is up to 16 rates of 1 to 1000000 kbit/s";
  else
    fault = fault_of(out);
  if (out->peer == NULL) out->peer = g_strdup("127.0.0.1");
  if (fault != NULL) fprintf(stderr, "call: %s\n", fault);
  g_clear_error(&error);
  g_free(repair);
  g_free(capacity);
  g_option_context_free(context);
  return fault == NULL && readable(out->pictures) && readable(out->sound);
}

void call_options_clear(CallOptions* options) {
  g_free(options->pictures);
  g_free(options->sound);
  g_free(options->peer);
  g_free(options->record);
}
