/* Retransmission: RFC 4588. */
#ifndef FBS_CALL_RETRANSMISSION_H
#define FBS_CALL_RETRANSMISSION_H

#include <gst/gst.h>

#include "options.h"

/** For both sessions of rtpbin, before it has any pads. */
void retransmission_connect(GstElement* rtp, const CallOptions* options);

/** What waits in a queue of so many seconds is not lost: it is not requested, which would make the queue
 * longer. */
void retransmission_wait(GstElement* rtp, gdouble queue);

#endif
