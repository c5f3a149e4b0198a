/* Packets of a stream as its container sees them: bitstream/SPEC.md sections 3 and 4.1. Nothing here decodes.
 */
#ifndef FBS_GSTREAMER_PACKET_H
#define FBS_GSTREAMER_PACKET_H

#include <gst/gst.h>

G_BEGIN_DECLS

#define GST_FBS_SIGNATURE \
  "\x89"                  \
  "fbs"
#define GST_FBS_SIGNATURE_SIZE 4

/** What the first packet of a scene and the end packet are checked from. */
#define GST_FBS_FIRST_CHECK 0xFFFF

enum {
  GST_FBS_SETUP = 1,
  GST_FBS_MOTION = 5,
  GST_FBS_END = 6,
  GST_FBS_BLEND = 7,
};

typedef struct {
  guint8 type;
  const guint8* payload;
  gsize payload_size;
  gsize size; /**< bytes of the packet, from its type to its check */
} GstFbsPacket;

typedef enum {
  GST_FBS_SCAN_PACKET,  /**< there is a whole one; its check has not been looked at */
  GST_FBS_SCAN_SHORT,   /**< more bytes are needed */
  GST_FBS_SCAN_DAMAGED, /**< its length is no varint, or too large */
} GstFbsScan;

/** Looks at the packet that begins with the first byte.
 * @param needed  of GST_FBS_SCAN_SHORT: the bytes from the first on without which there is no use in another
 *                look; may be null */
GstFbsScan gst_fbs_packet_scan(const guint8* data, gsize size, GstFbsPacket* out, gsize* needed);

/** Whether the packet's check is right, SPEC 3.1.
 * @param chain  the check of the packet before; it is set to that of this packet if that is right */
gboolean gst_fbs_packet_check(const GstFbsPacket* packet, guint16* chain);

/** CRC-16/CCITT-FALSE. */
guint16 gst_fbs_crc16(guint16 initial, const guint8* data, gsize size);

/** Where decoding can go on after damage: SPEC 3.2.
 * @return the offset of the first setup or end packet with a right check; of the first byte that may begin
 * one if there were more bytes; `size` if there is none */
gsize gst_fbs_find_restart(const guint8* data, gsize size);

/** The fields of a setup packet that a container wants. */
typedef struct {
  guint64 version;
  guint64 pictures_before;
  guint64 time_before; /**< 1/90000 s */
  guint64 width, height;
  guint64 rate_num, rate_den;
  guint64 aspect_num, aspect_den; /**< 0/1: unknown */
  guint8 patterns; /**< slots; 1: motion packets release pictures, otherwise blend packets do */
} GstFbsSetup;

/** @return FALSE if the payload ends early; fields of a version that the library does not read are those that
 *          this version has there */
gboolean gst_fbs_setup_parse(const guint8* payload, gsize size, GstFbsSetup* out);

/** The first setup packet among whole packets. FALSE: there is none. */
gboolean gst_fbs_find_setup(const guint8* data, gsize size, GstFbsSetup* out);

/** Reads an unsigned number and moves *at behind it. FALSE: it is malformed, or the bytes end in it. */
gboolean gst_fbs_read_varint(const guint8* data, gsize size, gsize* at, guint64* value);

G_END_DECLS

#endif
