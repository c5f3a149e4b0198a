/* Where the scenes of a whole stream begin: what seeking needs. */
#ifndef FBS_GSTREAMER_SCENE_INDEX_H
#define FBS_GSTREAMER_SCENE_INDEX_H

#include <gst/gst.h>

G_BEGIN_DECLS

typedef struct {
  guint64 offset;    /**< of the setup packet, bytes */
  GstClockTime time; /**< of the scene's first picture */
} GstFbsSceneEntry;

/** Walks through the packets of a stream. Damaged parts are passed over.
 * @param duration  of the stream, out of the last scene's pictures, none of which is drawn; none if there is
 * no scene
 * @return GstFbsSceneEntry in the order of the stream, with times that rise */
GArray* gst_fbs_scene_index(const guint8* data, gsize size, GstClockTime* duration);

G_END_DECLS

#endif
