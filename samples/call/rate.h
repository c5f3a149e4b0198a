/* How many bits the pictures have: as many as the link takes, by what the other end reports. */
#ifndef FBS_CALL_RATE_H
#define FBS_CALL_RATE_H

#include <gst/gst.h>

#include "options.h"

/** A small relative of Google's congestion control (draft-ietf-rmcat-gcc-02, sections 5 and 6); README.md
 * says what it does. All zeros but the first three in the beginning. */
typedef struct {
  gdouble min, max; /**< bit/s */
  gdouble rate;     /**< bit/s */
  gdouble sent;     /**< bit/s, mean of some seconds */
  gdouble loss;     /**< 0..1, mean of some seconds */
  gdouble base;     /**< round trip without a queue, s */
  gdouble queue;    /**< what the last one had more, s */
} RateControl;

/** Takes a report.
 * @param loss        share of the packets lost since the report before, 0..1
 * @param round_trip  s, more than 0
 * @param sent        bit/s of the pictures since the report before
 * @param elapsed     s since then
 * @return the new rate */
gdouble rate_control_report(RateControl* control, gdouble loss, gdouble round_trip, gdouble sent,
                            gdouble elapsed);

/** Reads the reports. */
typedef struct {
  GstElement *rtp, *encoder; /**< owned */
  gboolean follows;
  RateControl control;
  gint64 at;          /**< when the last report came, monotonic, us; 0: none has */
  guint answered;     /**< which of ours it answers: the middle of its NTP time */
  guint highest;      /**< its number of the last packet */
  gint lost;          /**< packets, its count */
  GMutex lock;        /**< for the rest */
  guint64 bytes;      /**< of pictures sent since the last report */
  gdouble round_trip; /**< s; 0: unknown */
} Rate;

/** Sets the bit rate of "encoder" from now on, if the options say so. */
void rate_init(Rate* rate, const CallOptions* options, GstElement* pipeline);
void rate_clear(Rate* rate);

#endif
