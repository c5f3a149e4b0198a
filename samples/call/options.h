/* Command line options of one end of a call. */
#ifndef FBS_CALL_OPTIONS_H
#define FBS_CALL_OPTIONS_H

#include <glib.h>

/** How lost packets are replaced; pictures lost nevertheless cost a scene. */
typedef enum {
  REPAIR_NONE = 0,
  REPAIR_RTX = 1,  /**< requested again: RFC 4588 */
  REPAIR_COPY = 2, /**< all packets of the pictures are sent again, a little later */
  REPAIR_BOTH = REPAIR_RTX | REPAIR_COPY,
} Repair;

#define MAX_CAPACITIES 16

typedef struct {
  char* pictures; /**< file with video */
  char* sound;    /**< file with sound; it may be the same */
  char* peer;     /**< host */
  gint port;      /**< first of four that this end listens on */
  gint peer_port; /**< and the peer */

  gint bitrate;     /**< pictures, bit/s; the first one where the rate follows the link */
  gint min_bitrate; /**< and its limits; 0: it does not follow */
  gint max_bitrate;
  gint sound_bitrate; /**< bit/s */
  gdouble delay;      /**< of a group of pictures, s */
  gint latency;       /**< of the jitter buffer, ms */
  Repair repair;

  gdouble loss;   /**< of packets sent, 0..1 */
  gdouble burst;  /**< mean length of a loss, ms; 0: packets are lost independently */
  gint min_delay; /**< of the network, ms */
  gint max_delay;
  gdouble capacity[MAX_CAPACITIES]; /**< kbit/s of the network, each for an equal part of the call */
  guint capacities;                 /**< 0: no limit */
  gint queue;                       /**< longest one before it, ms */
  gint seed;

  gdouble seconds; /**< how long the call lasts */
  gboolean show;   /**< in a window and a loudspeaker */
  char* record;    /**< prefix of files for what arrives; or null */
} CallOptions;

/** @return FALSE: they are invalid, and a line on stderr says why */
gboolean call_options_parse(CallOptions* out, int* argc, char*** argv);
void call_options_clear(CallOptions* options);

#endif
