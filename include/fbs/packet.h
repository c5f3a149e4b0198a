/* fbs, a video codec for talking heads: the packets of a stream, for those who carry, cut or index it.
 * Nothing is drawn, and no pattern is decoded. fbs/fbs.h says what holds for all functions.
 *
 *     fbs_packet_reader* reader = NULL;
 *     fbs_packet_reader_open(&reader);
 *     fbs_packet_reader_feed(reader, bytes, size);
 *     fbs_packet_info packet;
 *     while ((status = fbs_packet_reader_next(reader, &packet)) != FBS_NEED_DATA && status != FBS_END)
 *       if (status == FBS_OK) use(bytes + packet.offset, packet.size);
 *     fbs_packet_reader_close(&reader); */
#ifndef FBS_PACKET_H
#define FBS_PACKET_H

#include <fbs/fbs.h>

#ifdef __cplusplus
extern "C" {
#endif

/** The first four bytes of every stream, which belong to no packet. */
#define FBS_SIGNATURE_SIZE 4
#define FBS_SIGNATURE \
  "\x89"              \
  "fbs"

/** Most bytes of a packet with which reading goes on behind damage. */
#define FBS_MAX_FOUND_PACKET 2053

/** Kinds of packets, numbered as in the stream: bitstream/SPEC.md section 3.1. Other numbers are unknown, and
 * are passed over by decoders. */
typedef enum fbs_packet_type {
  FBS_PACKET_SETUP = 1, /**< begins a scene */
  FBS_PACKET_GEOMETRY = 2,
  FBS_PACKET_SURROUND = 3,
  FBS_PACKET_PATTERN = 4,
  FBS_PACKET_MOTION = 5,
  FBS_PACKET_END = 6, /**< ends the stream */
  FBS_PACKET_BLEND = 7,
  FBS_PACKET_WIRE_FRAME = 8,
  FBS_PACKET_SOUND_SETUP = 9,
  FBS_PACKET_SOUND = 10,
  FBS_PACKET_UNIT = 11,
  FBS_PACKET_HEAD_PART = 12,
  FBS_PACKET_RETURN = 13 /**< goes on with an earlier scene */
} fbs_packet_type;

/** A whole packet whose check is right. */
typedef struct fbs_packet_info {
  int type;        /**< fbs_packet_type, or an unknown number up to 255 */
  uint64_t offset; /**< of its first byte, from the first byte fed */
  size_t size;     /**< bytes, from its type to its check */
  int key; /**< 1: coded without an earlier packet of its type; of setup packets those where decoding can
              begin */
  uint64_t number; /**< of the first picture that needs it, as if the stream stayed in the scene up to there;
                        of an end packet: pictures in all */
  uint64_t time;   /**< of that picture, ticks; of an end packet: the length of the video */
  /** Pictures that can be shown once it has arrived, and when the first of them begins and the last one ends,
   * ticks. Pictures that a setup, return or end packet says are missing are not among them. */
  uint32_t pictures;
  uint64_t shown_from, shown_until;
  /** Why a decoder leaves it out: its payload is damaged, or it may not stand where it does. Null: it does
   * not, unless something before it was lost. Valid until the next call. */
  const char* fault;
  int skipped; /**< 1: a decoder leaves it out since it needs what was lost, or has come before */
} fbs_packet_info;

typedef struct fbs_packet_reader fbs_packet_reader;

/** @param out  set to the reader, which is freed by fbs_packet_reader_close(); to null on failure
 * @return FBS_OK, FBS_ERROR_ARGUMENT, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_packet_reader_open(fbs_packet_reader** out);

/** Frees the reader, and sets *reader to null. Null is fine. */
FBS_API void fbs_packet_reader_close(fbs_packet_reader** reader);

/** Takes the next bytes of the stream, in pieces of any size. They are copied.
 * @return FBS_OK; FBS_ERROR_ARGUMENT after fbs_packet_reader_finish(), or when bytes is null and size is not
 * 0; FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_packet_reader_feed(fbs_packet_reader* reader, const uint8_t* bytes, size_t size);

/** Says that no more bytes will come. Once more does nothing.
 * @return FBS_OK */
FBS_API fbs_status fbs_packet_reader_finish(fbs_packet_reader* reader);

/** Forgets everything: the reader is as new.
 * @return FBS_OK; FBS_ERROR_NO_MEMORY, and nothing has changed */
FBS_API fbs_status fbs_packet_reader_reset(fbs_packet_reader* reader);

/** Goes on to the next packet.
 * @return FBS_OK; FBS_NEED_DATA, FBS_END: there is none;
 *         FBS_ERROR_NOT_FBS: the stream does not begin with the signature, as where it is joined in its
 * middle; FBS_ERROR_DAMAGED, FBS_ERROR_TRUNCATED, FBS_ERROR_TOO_LARGE: bytes that are no packet, or not the
 * one that follows. Each is reported once; the next call goes on with the next setup or end packet */
FBS_API fbs_status fbs_packet_reader_next(fbs_packet_reader* reader, fbs_packet_info* info);

/** @return FBS_OK; FBS_NEED_DATA until a setup packet has arrived */
FBS_API fbs_status fbs_packet_reader_get_format(const fbs_packet_reader* reader, fbs_format* out);

/** As fbs_decoder_error() and fbs_decoder_error_offset(). */
FBS_API const char* fbs_packet_reader_error(const fbs_packet_reader* reader);
FBS_API uint64_t fbs_packet_reader_error_offset(const fbs_packet_reader* reader);

#ifdef __cplusplus
}
#endif

#endif
