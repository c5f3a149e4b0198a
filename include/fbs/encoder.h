/* fbs, a video codec for talking heads: the encoder. fbs/fbs.h says what holds for all functions.
 *
 *     fbs_encoder_settings settings;
 *     fbs_encoder_default_settings(&settings, sizeof settings);
 *     settings.format.width = 352;
 *     settings.format.height = 288;
 *     settings.quality = 60;
 *     fbs_encoder* encoder = NULL;
 *     fbs_encoder_open(&encoder, &settings);
 *     do {
 *       if (more) fbs_encoder_push(encoder, &picture, 0);
 *       else fbs_encoder_finish(encoder);
 *       fbs_packet packet;
 *       while ((status = fbs_encoder_pull(encoder, &packet)) == FBS_OK) write(packet.data, packet.size);
 *     } while (status == FBS_NEED_DATA);
 *     fbs_encoder_close(&encoder);
 *
 * Without `live` the encoder looks ahead: packets come in bursts, up to forty seconds of video later. */
#ifndef FBS_ENCODER_H
#define FBS_ENCODER_H

#include <fbs/packet.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What bytes are spent for. */
typedef enum fbs_tune {
  FBS_TUNE_EYE, /**< mouth and eyes that look right, at some cost of the frame's PSNR */
  FBS_TUNE_PSNR /**< the PSNR of the whole frame */
} fbs_tune;

/** What a live stream does to survive lost packets. */
typedef enum fbs_resilience {
  FBS_RESILIENCE_NONE,   /**< nothing: fewest bytes */
  FBS_RESILIENCE_PACKET, /**< motion goes on without what is lost; patterns wait until it is sent again */
  FBS_RESILIENCE_STRONG  /**< patterns go on without it, too: for links without a way back */
} fbs_resilience;

/** Filled by fbs_encoder_default_settings(&settings, sizeof settings), after which width and height are 0 and
 * must be set. */
typedef struct fbs_encoder_settings {
  size_t struct_size;
  fbs_format format;   /**< for all pictures; default 25 pictures per second, square pixels */
  int quality;         /**< 0..100; default 50 */
  double bitrate;      /**< kbit/s in total, which determines quality; 0 (default): quality decides */
  double seconds;      /**< length of the video, for bitrate; 0 (default): unknown */
  int effort;          /**< 0..9; default 5. More takes longer and saves bits */
  int patterns;        /**< pictures of the person in a scene, 1..64; 0 (default): chosen by the encoder */
  int face;            /**< which face to follow, 0 (default) being the largest */
  int allow_no_face;   /**< 1: also code a video without any face; default 0 */
  double key_interval; /**< longest time between places to join, seconds; 0 (default): up to 40,
                            live 10, 20 with FBS_RESILIENCE_STRONG, 40 with `join` */
  int live;            /**< 1: no look-ahead; default 0 */
  double live_delay;   /**< live: seconds of pictures that are coded together; default 0.2 */
  double live_buffer;  /**< live, with bitrate: longest time that data waits to be sent, seconds; default 2 */
  int threads;         /**< that encode; the stream is the same for any number. 0 (default): as many as there
                            are cores */
  int tune;            /**< fbs_tune, of files; default FBS_TUNE_EYE. No effect with `live` */
  int resilience;      /**< fbs_resilience, with `live`; default FBS_RESILIENCE_NONE */
  double join;         /**< live: a viewer who comes in the middle of a scene can join it within so many
                            seconds, at the cost of parts of its head all along; 0 (default): only where a scene
                            begins */
  fbs_log log;         /**< null (default): nobody is told */
  fbs_thread_start thread_start; /**< null (default): nothing is done. Not called on the threads of libaom and
                                      OpenCV */
  void* user;                    /**< passed to both; lives as long as the encoder */
  double start; /**< with bitrate, seconds of it: the first picture is there after so long, coarse if need be,
                   and a finer one follows. 0: as fine as the rate as a whole allows; -1 (default): 1 live
                   without `join` and FBS_RESILIENCE_STRONG, with which it must be 0, otherwise 0 */
  char* open_error; /**< null (default), or FBS_ERROR_SIZE bytes: fbs_encoder_open() writes there why it
                       fails, in one line; "" if it does not. Not needed after the call */
} fbs_encoder_settings;

typedef struct fbs_encoder fbs_encoder;

/** A piece of the stream, which is all packets in sequence; the first begins with the signature, and the last
 * gives the number of pictures. */
typedef struct fbs_packet {
  const uint8_t* data; /**< valid until the next call for this encoder */
  size_t size;         /**< bytes, at least 1 */
  int type;            /**< fbs_packet_type */
  int key;             /**< 1: a setup packet where decoding can begin */
  uint32_t pictures;   /**< that can be shown once it has arrived */
  uint64_t number;     /**< of the first picture that needs the packet; of the last packet: pictures in all */
  uint64_t time;       /**< of that picture, ticks; of the last packet: the length of the video */
} fbs_packet;

/** In place of a time: none. */
#define FBS_NO_TIME INT64_MIN

/** What a caller says of a picture, and gets back with its packets. Begins as {sizeof stamp, time}; all
 * others may be 0. */
typedef struct fbs_stamp {
  size_t struct_size;
  int64_t time;      /**< at which the picture begins, ticks of any clock, within +-2^61; FBS_NO_TIME: where
                          the one before ends */
  uint64_t user;     /**< a number or a pointer of the caller's */
  uint32_t duration; /**< ticks, at most a minute; 0: with a time until the next one, otherwise the frame
                          rate's */
} fbs_stamp;

/** Statistics so far. */
typedef struct fbs_encoder_report {
  uint64_t pictures;     /**< pushed */
  uint64_t without_face; /**< of those, pictures in which no face was followed */
  uint64_t cuts;
  uint64_t scenes; /**< begun for a person or a shot */
} fbs_encoder_report;

/** As fbs_decoder_default_settings(). */
FBS_API void fbs_encoder_default_settings(fbs_encoder_settings* settings, size_t struct_size);

/** @param out  set to the encoder, to be freed by fbs_encoder_close(); to null on failure
 * @return FBS_OK; FBS_ERROR_ARGUMENT: a setting is out of its range; FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_encoder_open(fbs_encoder** out, const fbs_encoder_settings* settings);

/** Frees the encoder and sets *encoder to null. Packets not yet pulled are lost. Null is allowed. */
FBS_API void fbs_encoder_close(fbs_encoder** encoder);

/** Copies and encodes the next picture.
 * @param picture   of the format's size
 * @param duration  ticks, at most a minute; 0: the frame rate's
 * @return FBS_OK; FBS_ERROR_ARGUMENT, with nothing taken: another size, a stride that is too small, a
 *         duration that is too long, or a call after the end. Any other error ends the encoding: only pulling
 *         and closing remain. FBS_ERROR_NO_FACE: fewer faces than the setting `face` asks for;
 *         FBS_ERROR_IO, FBS_ERROR_NO_MEMORY, FBS_ERROR_INTERNAL */
FBS_API fbs_status fbs_encoder_push(fbs_encoder* encoder, const fbs_const_picture* picture,
                                    uint32_t duration);

/** The same with a stamp, for cameras, whose pictures come when they come.
 * In the stream a picture begins at its stamp's time minus the first one's, to a tick: fbs_picture_info.time.
 * Only the first picture of a group can be off. The picture before it was coded with the group before, when
 * nobody knew how long it lasts, so it got the `duration` of its stamp or, if that is 0, the shorter one of
 * the two durations before (at first the frame rate's). By what that was wrong, the next picture begins too
 * early or too late; those after it are right again, as far as each lasts at least a tick. So nothing is
 * delayed, times do not drift, and a steady camera is exact from its third picture on, at any rate. A group
 * is the first picture of a scene, and then as many as the frame rate has in `live_delay`, or without `live`
 * in a second. More than a minute between two pictures counts as a minute.
 * What a caller keeps of a picture is found by fbs_picture_info.number: that of the first one pushed is 0.
 * @param stamp  null: as fbs_encoder_push() with a duration of 0
 * @return as fbs_encoder_push(); FBS_ERROR_ARGUMENT, with nothing taken, also when a time is not later than
 *         the last one, or out of range */
FBS_API fbs_status fbs_encoder_push_stamped(fbs_encoder* encoder, const fbs_const_picture* picture,
                                            const fbs_stamp* stamp);

/** Requests a place where a viewer can join, for instance after a loss: a scene begins with the next picture
 * that can begin one, after `delay` at the latest. With `live` only. Repeating the request before then has no
 * effect. An unchanged picture, shown while there is no face and only one pattern, is not sent again.
 * @return FBS_OK; FBS_ERROR_ARGUMENT without `live`, or after the end */
FBS_API fbs_status fbs_encoder_request_scene(fbs_encoder* encoder);

/** Says that a viewer has lost a pattern of the present scene for good, as when it was sent again in vain.
 * Later ones are then coded so that they need the head of the scene alone: cheaper than another scene, for
 * viewers who have the head. With `live` only.
 * @return FBS_OK; FBS_ERROR_ARGUMENT without `live`, or after the end; any other error ends the encoding, as
 * in fbs_encoder_push() */
FBS_API fbs_status fbs_encoder_lose_patterns(fbs_encoder* encoder);

/** Changes the bitrate of a live encoding that has one, as the link does. It holds from the next group on;
 * motion stays as fine as it is, and the last `live_buffer` seconds may still be of the rate before.
 * @param kbps  kbit/s in total, above 0
 * @return FBS_OK; FBS_ERROR_ARGUMENT without `live` or `bitrate`, for another number, or after the end; any
 * other error ends the encoding, as in fbs_encoder_push() */
FBS_API fbs_status fbs_encoder_set_bitrate(fbs_encoder* encoder, double kbps);

/** Ends the video, and codes what is held back.
 * @return FBS_OK; FBS_ERROR_NO_FACE when no picture showed a face; FBS_ERROR_ARGUMENT when there was no
 *         picture or this is the second call; other errors as for fbs_encoder_push(). In any case the
 *         encoding has ended */
FBS_API fbs_status fbs_encoder_finish(fbs_encoder* encoder);

/** Returns the next packet.
 * @return FBS_OK; FBS_NEED_DATA: push more, or finish. With `live` and `threads` other than 1 packets may
 *         become ready a little later, without another push: fbs_encoder_wait(); FBS_END: the encoding has
 *         ended, and all packets have been returned */
FBS_API fbs_status fbs_encoder_pull(fbs_encoder* encoder, fbs_packet* out);

/** Waits until fbs_encoder_pull() has a packet, while other threads code what has been pushed. They do with
 * `threads` other than 1; without them the answer comes at once.
 * @param milliseconds  how long at most
 * @return FBS_OK: a packet is ready; FBS_NEED_DATA: the time has passed, or the next packet takes another
 *         push; FBS_END and errors as fbs_encoder_pull() */
FBS_API fbs_status fbs_encoder_wait(fbs_encoder* encoder, uint32_t milliseconds);

/** The stamp that the picture fbs_packet.number was pushed with, for the packet pulled last. Pictures without
 * a stamp have FBS_NO_TIME and their duration.
 * @param out  its struct_size is set by the caller
 * @return FBS_OK; FBS_ERROR_ARGUMENT before the first packet, and for the last one, which has no picture */
FBS_API fbs_status fbs_encoder_get_stamp(const fbs_encoder* encoder, fbs_stamp* out);

FBS_API fbs_status fbs_encoder_get_report(const fbs_encoder* encoder, fbs_encoder_report* out);

/** The landmarks in the picture pushed last, as tracked, without coding loss; `confidence` is the same for
 * all, 0 where the face is not followed.
 * @param out  FBS_LANDMARKS points
 * @return FBS_OK; FBS_ERROR_NO_FACE; FBS_ERROR_ARGUMENT before the first picture */
FBS_API fbs_status fbs_encoder_get_landmarks(const fbs_encoder* encoder, fbs_landmark* out);

/** Like fbs_decoder_error(). */
FBS_API const char* fbs_encoder_error(const fbs_encoder* encoder);

#ifdef __cplusplus
}
#endif

#endif
