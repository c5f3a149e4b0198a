/* The payload format of docs/rtp.md. */
#ifndef FBS_GSTREAMER_RTP_PAYLOAD_H
#define FBS_GSTREAMER_RTP_PAYLOAD_H

#include <fbs/fbs.h>

/** Bytes before the group's: one, with these bits. */
#define GST_FBS_RTP_HEADER 1
#define GST_FBS_RTP_START 0x80 /**< the first of a group */
#define GST_FBS_RTP_KEY 0x40   /**< the group begins a scene where decoding can begin */

#define GST_FBS_RTP_CAPS_FIELDS \
  "media = (string) video, clock-rate = (int) 90000, encoding-name = (string) FBS"

#endif
