/* What makes up for lost packets: elements that rtpbin asks for. */
#ifndef FBS_CALL_REPAIR_H
#define FBS_CALL_REPAIR_H

#include <gst/gst.h>

#include "options.h"

/** Before rtpbin has any pads. */
void repair_connect(Repair repair, GstElement* rtp);

#endif
