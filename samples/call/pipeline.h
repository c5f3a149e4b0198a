/* The elements of one end of a call. */
#ifndef FBS_CALL_PIPELINE_H
#define FBS_CALL_PIPELINE_H

#include <gst/gst.h>

#include "options.h"

#define COPY_DELAY 120 /* ms */

enum { SESSION_PICTURES, SESSION_VOICE, SESSIONS };

enum {
  PAYLOAD_PICTURES = 96,
  PAYLOAD_VOICE = 97,
  PAYLOAD_RTX = 98, /**< and 99 for the voice */
};

/** Both directions in one pipeline: what is sent, "picture_in" and "voice_in", to which rtpbin's pads are
 * linked as streams come, and "screen" and "ear", where they end. "encoder", "voice_encoder",
 * "voice_decoder", "rtp" (rtpbin) and "network0" to "network4" are names, too.
 * @return null: an element is missing, and a line on stderr says which */
GstElement* pipeline_new(const CallOptions* options);

#endif
