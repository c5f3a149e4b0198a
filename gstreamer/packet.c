#include "packet.h"

#define MAX_PAYLOAD (1u << 24)
#define CHECK_SIZE 2
#define MAX_VARINT 10
#define MAX_RESTART_PAYLOAD 127 /* of a packet that ends a search: SPEC 3.2 */
#define STEPS 5
#define MOUTH_COLOURS 6

gboolean gst_fbs_read_varint(const guint8* data, gsize size, gsize* at, guint64* value) {
  *value = 0;
  for (guint k = 0; k < MAX_VARINT && *at < size; ++k) {
    const guint8 byte = data[(*at)++];
    if (k == MAX_VARINT - 1 && byte > 1) return FALSE; /* more than 64 bits */
    *value |= (guint64)(byte & 127) << (7 * k);
    if (byte < 128) return byte != 0 || k == 0; /* the shortest form */
  }
  return FALSE;
}

guint16 gst_fbs_crc16(guint16 initial, const guint8* data, gsize size) {
  guint crc = initial;
  for (gsize k = 0; k < size; ++k) {
    crc ^= (guint)data[k] << 8;
    for (guint bit = 0; bit < 8; ++bit) crc = (crc & 0x8000) != 0 ? (crc << 1) ^ 0x1021 : crc << 1;
  }
  return (guint16)crc;
}

static GstFbsScan too_short(gsize at_least, gsize* needed) {
  if (needed != NULL) *needed = at_least;
  return GST_FBS_SCAN_SHORT;
}

GstFbsScan gst_fbs_packet_scan(const guint8* data, gsize size, GstFbsPacket* out, gsize* needed) {
  const gsize smallest = 1 + 1 + CHECK_SIZE;
  gsize at = 1;
  guint64 length = 0;
  if (size < smallest) return too_short(smallest, needed);
  if (!gst_fbs_read_varint(data, size, &at, &length))
    return size < 1 + MAX_VARINT && data[size - 1] > 127 && at == size ? too_short(size + 1, needed)
                                                                       : GST_FBS_SCAN_DAMAGED;
  if (length > MAX_PAYLOAD) return GST_FBS_SCAN_DAMAGED;
  out->type = data[0];
  out->payload = data + at;
  out->payload_size = (gsize)length;
  out->size = at + (gsize)length + CHECK_SIZE;
  return size < out->size ? too_short(out->size, needed) : GST_FBS_SCAN_PACKET;
}

gboolean gst_fbs_packet_check(const GstFbsPacket* packet, guint16* chain) {
  const guint8* const check = packet->payload + packet->payload_size;
  const guint8* const begin = check + CHECK_SIZE - packet->size;
  const gboolean restarts = packet->type == GST_FBS_SETUP || packet->type == GST_FBS_END;
  const guint16 right = gst_fbs_crc16(restarts ? GST_FBS_FIRST_CHECK : *chain, begin, (gsize)(check - begin));
  if (right != (check[0] << 8 | check[1])) return FALSE; /* at any address */
  *chain = right;
  return TRUE;
}

gsize gst_fbs_find_restart(const guint8* data, gsize size) {
  gsize cut = size; /* the first packet that may be one and is not there yet */
  for (gsize at = 0; at < size; ++at) {
    GstFbsPacket packet;
    guint16 chain = GST_FBS_FIRST_CHECK;
    if (data[at] != GST_FBS_SETUP && data[at] != GST_FBS_END) continue;
    if (at + 1 < size && data[at + 1] > MAX_RESTART_PAYLOAD) continue;
    const GstFbsScan scan = gst_fbs_packet_scan(data + at, size - at, &packet, NULL);
    if (scan == GST_FBS_SCAN_PACKET && gst_fbs_packet_check(&packet, &chain)) return at;
    if (scan == GST_FBS_SCAN_SHORT) cut = MIN(cut, at);
  }
  return cut;
}

gboolean gst_fbs_setup_parse(const guint8* payload, gsize size, GstFbsSetup* out) {
  gsize at = 0;
  guint64 ignored = 0;
  guint64* const position[] = {&out->pictures_before, &out->time_before};
  guint64* const format[] = {&out->width,    &out->height,     &out->rate_num,
                             &out->rate_den, &out->aspect_num, &out->aspect_den};
  out->patterns = 1;
  if (!gst_fbs_read_varint(payload, size, &at, &out->version)) return FALSE;
  ++at; /* generic head */
  for (gsize k = 0; k < G_N_ELEMENTS(position); ++k)
    if (!gst_fbs_read_varint(payload, size, &at, position[k])) return FALSE;
  for (gsize k = 0; k < G_N_ELEMENTS(format); ++k)
    if (!gst_fbs_read_varint(payload, size, &at, format[k])) return FALSE;
  ++at;                                 /* colour */
  for (guint k = 0; k < STEPS + 1; ++k) /* and the parts of the state */
    if (!gst_fbs_read_varint(payload, size, &at, &ignored)) return FALSE;
  at += MOUTH_COLOURS;
  if (at > size) return FALSE;
  if (at == size) return TRUE;
  if (!gst_fbs_read_varint(payload, size, &at, &ignored) || ignored == 0 || ignored > 64) return FALSE;
  out->patterns = (guint8)ignored;
  return TRUE;
}

gboolean gst_fbs_find_setup(const guint8* data, gsize size, GstFbsSetup* out) {
  GstFbsPacket packet;
  for (gsize at = 0; gst_fbs_packet_scan(data + at, size - at, &packet, NULL) == GST_FBS_SCAN_PACKET;
       at += packet.size)
    if (packet.type == GST_FBS_SETUP) return gst_fbs_setup_parse(packet.payload, packet.payload_size, out);
  return FALSE;
}
