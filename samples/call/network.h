/* The network between the two ends: delays by GStreamer's netsim, losses by a chain of two states, which
 * netsim lacks; and counts of the packets sent. */
#ifndef FBS_CALL_NETWORK_H
#define FBS_CALL_NETWORK_H

#include <gst/gst.h>

#include "options.h"

/** What is sent, each packet with 28 bytes of IP and UDP. */
typedef enum { SENT_PICTURES, SENT_VOICE, SENT_REPAIR, SENT_RTCP, SENT_KINDS } SentKind;

typedef struct {
  gdouble loss, burst; /**< from CallOptions */
  GMutex lock;
  GRand* chance;
  gboolean bad;   /**< the state in which everything is lost */
  gint64 changed; /**< monotonic time of its last change, us */
  guint64 bytes[SENT_KINDS];
  guint64 packets, lost;
} Network;

/** Watches the elements netsim of the pipeline, "network0" to "network4", the last one of which has copies.
 */
void network_init(Network* network, const CallOptions* options, GstElement* pipeline);
void network_clear(Network* network);

#endif
