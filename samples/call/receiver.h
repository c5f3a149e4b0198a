/* What arrives at screen and ear: when, how long after it was recorded, and what is missing. */
#ifndef FBS_CALL_RECEIVER_H
#define FBS_CALL_RECEIVER_H

#include <gst/gst.h>
#include <stdio.h>

#define RECEIVER_TIMES 64

/** One of the two streams. Guarded by the receiver's lock. */
typedef struct {
  struct Receiver* receiver;
  struct {
    GstClockTime pts;
    GstClockTimeDiff offset; /**< from the timestamp to the time of the recording */
  } times[RECEIVER_TIMES];   /**< of the packets that came last, a ring */
  guint packets;
  guint64 shown;      /**< pictures, or buffers of sound */
  GstClockTime first; /**< when the first one was shown, monotonic; or none */
  GstClockTime last;
  GstClockTimeDiff delay;  /**< of the last one, ns; 0: unknown */
  guint64 freezes;         /**< pictures: gaps of 150 ms more than a picture lasts; voice: losses */
  GstClockTime frozen;     /**< their total duration */
  GstClockTime lost_until; /**< voice: the timestamp at which the last loss ends */
  FILE* record;            /**< samples; or null */
} Stream;

typedef struct Receiver {
  GMutex lock;
  Stream pictures, voice;
  guint64 requests; /**< for a scene */
  FILE* times;      /**< CSV: what, when shown, when recorded (ns, 0: unknown), bytes; or null */
} Receiver;

/** Watches "picture_in", "voice_in", "screen" and "ear" of the pipeline.
 * @param record  prefix of files that are written, or null
 * @return FALSE: one cannot be written, and a line on stderr says so */
gboolean receiver_init(Receiver* receiver, GstElement* pipeline, const char* record);
void receiver_clear(Receiver* receiver);

#endif
