#include "rejoin.h"

#include "caps.h"

/* The payload with what has gone before added to it. FALSE: the packet is malformed. */
static gboolean shift_payload(const GstFbsRejoin* rejoin, const GstFbsPacket* packet, GByteArray* out) {
  GstFbsSetup setup;
  guint64 pictures = 0;
  gsize at = 0;
  switch (packet->type) {
    case GST_FBS_SETUP:
      if (!gst_fbs_setup_parse(packet->payload, packet->payload_size, &setup)) return FALSE;
      g_byte_array_append(out, packet->payload, (guint)setup.before);
      gst_fbs_write_varint(out, rejoin->pictures + setup.pictures_before);
      gst_fbs_write_varint(out, rejoin->time + setup.time_before);
      at = setup.behind;
      break;
    case GST_FBS_END:
      if (!gst_fbs_read_varint(packet->payload, packet->payload_size, &at, &pictures)) return FALSE;
      gst_fbs_write_varint(out, rejoin->pictures + pictures);
      break;
    default:
      break;
  }
  g_byte_array_append(out, packet->payload + at, (guint)(packet->payload_size - at));
  return TRUE;
}

static void append_packet(GstFbsRejoin* rejoin, guint8 type, const GByteArray* payload, GByteArray* out) {
  const guint begin = out->len;
  const gboolean restarts = type == GST_FBS_SETUP || type == GST_FBS_END;
  g_byte_array_append(out, &type, 1);
  gst_fbs_write_varint(out, payload->len);
  g_byte_array_append(out, payload->data, payload->len);
  rejoin->chain =
      gst_fbs_crc16(restarts ? GST_FBS_FIRST_CHECK : rejoin->chain, out->data + begin, out->len - begin);
  const guint8 check[] = {(guint8)(rejoin->chain >> 8), (guint8)rejoin->chain};
  g_byte_array_append(out, check, sizeof check);
}

gboolean gst_fbs_rejoin_append(GstFbsRejoin* rejoin, const guint8* data, gsize size, GByteArray* out) {
  const gsize signature = gst_fbs_signature_at(data, size);
  GstFbsPacket packet;
  if (gst_fbs_packet_scan(data + signature, size - signature, &packet, NULL) != GST_FBS_SCAN_PACKET)
    return FALSE;
  if (rejoin->pictures == 0) {
    g_byte_array_append(out, data, (guint)size);
    return TRUE;
  }
  GByteArray* const payload = g_byte_array_new();
  const gboolean whole = shift_payload(rejoin, &packet, payload);
  if (whole) append_packet(rejoin, packet.type, payload, out);
  g_byte_array_unref(payload);
  return whole;
}
