/* What one end of a call is told on the command line. */
#ifndef FBS_CALL_OPTIONS_H
#define FBS_CALL_OPTIONS_H

#include <glib.h>

/** How packets that the network loses are made up for; what of the pictures is lost nevertheless costs a
 * scene. */
typedef enum {
  REPAIR_NONE = 0,
  REPAIR_RTX = 1,  /**< they are asked for once more: RFC 4588 */
  REPAIR_COPY = 2, /**< all of the pictures' are sent once more, a little later */
  REPAIR_BOTH = REPAIR_RTX | REPAIR_COPY,
} Repair;

typedef struct {
  char* pictures; /**< file with video */
  char* sound;    /**< file with sound; it may be the same */
  char* peer;     /**< host */
  gint port;      /**< first of four that this end listens at */
  gint peer_port; /**< and the peer */

  gint bitrate;       /**< pictures, bit/s */
  gint sound_bitrate; /**< bit/s */
  gdouble delay;      /**< of a group of pictures, s */
  gint latency;       /**< of the jitter buffer, ms */
  Repair repair;

  gdouble loss;   /**< of packets sent, 0..1 */
  gdouble burst;  /**< mean length of a loss, ms; 0: each packet has its own luck */
  gint min_delay; /**< of the network, ms */
  gint max_delay;
  gint seed;

  gdouble seconds; /**< how long the call lasts */
  gboolean show;   /**< in a window and a loudspeaker */
  char* record;    /**< prefix of files of what arrives; or null */
} CallOptions;

/** @return FALSE: they make no sense, and a line on stderr says why */
gboolean call_options_parse(CallOptions* out, int* argc, char*** argv);
void call_options_clear(CallOptions* options);

#endif
