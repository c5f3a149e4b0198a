/* One line per second: README.md explains the columns. */
#ifndef FBS_CALL_STATISTICS_H
#define FBS_CALL_STATISTICS_H

#include <gst/gst.h>

#include "network.h"
#include "rate.h"
#include "receiver.h"

/** Counts since the call began. */
typedef struct {
  guint64 sent[SENT_KINDS]; /**< bytes */
  guint64 packets, dropped;
  guint64 missing, repaired; /**< packets that the jitter buffers gave up on, or that came by RTX */
  guint64 shown;
  guint64 requests, heard, scenes; /**< requests for a scene by this end and by the other, and scenes sent */
  guint64 freezes, breaks;         /**< of pictures and voice */
  GstClockTime frozen, broken;     /**< their durations */
} Counts;

typedef struct {
  GstElement* pipeline;
  Network* network;
  Rate* rate;
  Receiver* receiver;
  GMutex lock;
  GList* jitter_buffers; /**< owned elements */
  guint64 scenes, heard; /**< of Counts */
  guint seconds;
  Counts before; /**< at the last line */
} Statistics;

void statistics_init(Statistics* statistics, GstElement* pipeline, Network* network, Rate* rate,
                     Receiver* receiver);
void statistics_clear(Statistics* statistics);

/** Prints a line; called every second. */
void statistics_print(Statistics* statistics);
/** Prints the totals when the call has ended. */
void statistics_print_total(Statistics* statistics);

#endif
