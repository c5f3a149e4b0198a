/* The network between the two ends: delays by GStreamer's netsim; losses by a chain of two states and a queue
 * before a link of limited rate, which netsim lacks; and counts of the packets sent. */
#ifndef FBS_CALL_NETWORK_H
#define FBS_CALL_NETWORK_H

#include <gst/gst.h>

#include "options.h"

/** What is sent, each packet with 28 bytes of IP and UDP. */
typedef enum { SENT_PICTURES, SENT_VOICE, SENT_REPAIR, SENT_RTCP, SENT_KINDS } SentKind;

typedef struct {
  const CallOptions* options;
  GMutex lock;
  GRand* chance;
  gboolean bad;   /**< the state in which everything is lost */
  gint64 changed; /**< monotonic time of its last change, us */
  gint64 begin;   /**< monotonic time at which the call began, us */
  gint64 idle;    /**< when the last packet will have left the queue */
  guint64 bytes[SENT_KINDS];
  guint64 packets, lost;
} Network;

/** Watches the elements netsim of the pipeline, "network0" to "network4", the last one of which has copies;
 * and "bottleneck0" to "bottleneck4", which hold what the queue does. */
void network_init(Network* network, const CallOptions* options, GstElement* pipeline);
void network_clear(Network* network);

#endif
