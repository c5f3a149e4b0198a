/* fbs, a video codec for talking heads: the decoder and what it shares with the encoder (fbs/encoder.h).
 *
 *     fbs_decoder* decoder = NULL;
 *     fbs_decoder_open(&decoder, NULL);
 *     for (;;) {
 *       fbs_status status = fbs_decoder_next(decoder, NULL);
 *       if (status == FBS_OK) {
 *         fbs_const_picture picture;
 *         fbs_decoder_get_picture(decoder, &picture);
 *         show(&picture);
 *       } else if (status == FBS_NEED_DATA) {
 *         if (read(bytes, &size)) fbs_decoder_feed(decoder, bytes, size);
 *         else fbs_decoder_finish(decoder);
 *       } else if (status == FBS_END) {
 *         break;
 *       } else {
 *         report(fbs_decoder_error(decoder));  // and go on: what follows the damage is decoded
 *       }
 *     }
 *     fbs_decoder_close(&decoder);
 *
 * Every function may be called in any order and with null pointers: a call that makes no sense is answered by
 * FBS_ERROR_ARGUMENT and changes nothing, except for the error text. What a function gives out through a
 * pointer is set on FBS_OK only. An object belongs to one thread at a time; several may be used side by side.
 * Only a decoder may also be fed by another thread while a picture is drawn: fbs_decoder_feed().
 * Nothing is printed. Exceptions of C++ do not leave the library.
 *
 * A struct of settings begins with its size as the caller knows it, so that later versions can add members:
 * it is filled by the function named at the struct. A member that the library does not know has to stay 0. */
#ifndef FBS_FBS_H
#define FBS_FBS_H

#include <stddef.h>
#include <stdint.h>

#if defined(FBS_STATIC) || !defined(__GNUC__)
#define FBS_API
#else
#define FBS_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- version ---- */

/** Version of this header. The library's soname changes with the first number, or while that is 0 with the
 * second. */
#define FBS_VERSION_MAJOR 0
#define FBS_VERSION_MINOR 2
#define FBS_VERSION_PATCH 0

/** Version of the running library: "0.2.0". */
FBS_API const char* fbs_version_string(void);
/** Version of the running library: major << 16 | minor << 8 | patch. */
FBS_API uint32_t fbs_version_number(void);
/** The newest version of the stream format that the library reads; the encoder writes that or the one before.
 */
FBS_API uint32_t fbs_format_version(void);

/* ---- answers ---- */

/** Errors are negative. */
typedef enum fbs_status {
  FBS_OK = 0,
  FBS_NEED_DATA = 1, /**< no error; feed or push more, or finish */
  FBS_END = 2,       /**< finished, and everything has been returned */

  FBS_ERROR_ARGUMENT = -1,    /**< a null pointer, a value out of its range, or a call at the wrong time */
  FBS_ERROR_NOT_FBS = -2,     /**< the input does not begin as an fbs stream does */
  FBS_ERROR_DAMAGED = -3,     /**< a packet is damaged, breaks a rule of the format, or is missing from what
                                   fbs_decoder_feed() was given */
  FBS_ERROR_TRUNCATED = -4,   /**< the stream ends inside a packet, or before its setup */
  FBS_ERROR_UNSUPPORTED = -5, /**< a newer version of the format, or a change of the picture's size */
  FBS_ERROR_TOO_LARGE = -6,   /**< beyond a limit of the format or of the settings */
  FBS_ERROR_NO_MEMORY = -7,
  FBS_ERROR_NO_FACE = -8,  /**< the encoder found no face, and was not allowed to continue without */
  FBS_ERROR_IO = -9,       /**< the encoder could not use its temporary file */
  FBS_ERROR_INTERNAL = -10 /**< a bug in the library */
} fbs_status;

/** A text for users, such as "damaged stream"; never null. fbs_decoder_error() has details. */
FBS_API const char* fbs_status_text(fbs_status status);

/** Bytes that hold the text of any error, with its final zero. */
#define FBS_ERROR_SIZE 256

/* ---- pictures ---- */

/** Smallest and largest width and height of a picture, pixels. */
#define FBS_MIN_SIDE 64
#define FBS_MAX_SIDE 8192

/** Unit of times and durations: 1/90000 s. */
#define FBS_TICKS_PER_SECOND 90000

typedef enum fbs_matrix { FBS_MATRIX_UNSPECIFIED = 0, FBS_MATRIX_BT601 = 1, FBS_MATRIX_BT709 = 2 } fbs_matrix;

/** Properties shared by all pictures of a stream. */
typedef struct fbs_format {
  uint32_t width, height;                      /**< pixels, FBS_MIN_SIDE..FBS_MAX_SIDE */
  uint32_t frame_rate_num, frame_rate_den;     /**< nominal pictures per second; each has its own duration */
  uint32_t pixel_aspect_num, pixel_aspect_den; /**< width of a pixel over its height; 0/1 when unknown */
  fbs_matrix matrix;                           /**< of YCbCr */
  int full_range;                              /**< 0: black is 16, white 235; 1: 0 and 255 */
} fbs_format;

/** 8-bit 4:2:0: planes Y, Cb, Cr. Chroma planes have (width + 1) / 2 by (height + 1) / 2 samples, each at the
 * centre of the four pixels it belongs to. */
typedef struct fbs_picture {
  uint32_t width, height; /**< pixels */
  uint8_t* data[3];       /**< first sample of the top row of each plane */
  ptrdiff_t stride[3];    /**< bytes from a row to the next one below; may be negative */
} fbs_picture;

/** The read-only counterpart. */
typedef struct fbs_const_picture {
  uint32_t width, height;
  const uint8_t* data[3];
  ptrdiff_t stride[3];
} fbs_const_picture;

/** What a picture has suffered from losses. */
typedef enum fbs_quality {
  FBS_QUALITY_EXACT = 0,           /**< nothing that is known */
  FBS_QUALITY_PATTERN_MISSING = 1, /**< a pattern that was sent is missing */
  FBS_QUALITY_INTERPOLATED = 2,    /**< its motion is missing, and lies between that before and behind */
  FBS_QUALITY_HELD = 3             /**< it is missing, and the one before is shown in its place */
} fbs_quality;

/** A picture's place in its stream. */
typedef struct fbs_picture_info {
  uint64_t number;   /**< from 0; missing numbers were lost */
  uint64_t time;     /**< since the beginning of the stream, ticks */
  uint32_t duration; /**< ticks, at least 1 */
  int held;          /**< 1: this picture was lost, and the previous one is shown in its place */
  int new_scene;     /**< 1: the first of a scene where decoding can begin */
  int quality;       /**< fbs_quality */
} fbs_picture_info;

/* ---- the face ---- */

/** Positions are pixels from the top left corner of the picture; the centre of the first pixel is 0.5, 0.5.
 * "right" and "left" are the person's own. */
typedef struct fbs_landmark {
  float x, y;
  /** 0..1: how much of the area of the triangles around the point faces the viewer, in the picture.
   * 1: visible; 0: the point is on the far side of the head. */
  float confidence;
} fbs_landmark;

/** Number of landmarks, in the order of iBUG (300-W), from 0. */
#define FBS_LANDMARKS 68

/** Largest number of vertices of a wire-frame. The generic head has 105; a stream may bring another. */
#define FBS_MAX_VERTICES 1024

/** Number of control points of the snakes, in the order of bitstream/SPEC.md section 5.1: outer mouth 0..9,
 * inner mouth 10..17, right brow 18..21, left brow 22..25, upper lids 26..27 and 28..29, lower lids 30..31
 * and 32..33, pupils 34 and 35. */
#define FBS_CONTROL_POINTS 36

/** Pose and expression of the face. */
typedef struct fbs_face_state {
  float pitch, yaw, roll; /**< degrees; positive: the face looks down, to the picture's left, its top leans
                               to the picture's right */
  float x, y;             /**< middle of the head at the height of the eyes, pixels */
  float eye_distance;     /**< with the face seen from the front, pixels */
  /** Displacement of each control point from the expressionless face, x and y along the head's own axes, in
   * eye distances. */
  float control[FBS_CONTROL_POINTS][2];
} fbs_face_state;

/** A vertex of the wire-frame in the picture. */
typedef struct fbs_vertex {
  float x, y; /**< pixels */
  float z;    /**< eye distances away from the viewer, from the middle of the head */
} fbs_vertex;

/** Number of named movements of the face, with ARKit's names where both have them. docs/export.md says what
 * each is at a weight of 1; 0 is the face of the scene's first picture. */
#define FBS_BLENDSHAPES 32

/** A name such as "jawOpen"; null from FBS_BLENDSHAPES on, and when out of memory. */
FBS_API const char* fbs_blendshape_name(size_t index);

/** A viewer's changes to a face: all 0 changes nothing. Values beyond a limit count as the limit. */
typedef struct fbs_face_edit {
  float pitch, yaw, roll; /**< degrees, +-12, +-18 and +-15 */
  float brows;            /**< -1: lowered, 1: raised, as far as looks right */
  float mouth;            /**< -1: shut, 1: opened wide */
  float smile;            /**< -1: corners down and in, 1: up and out */
  float lids;             /**< -1: opened wider, 1: shut */
} fbs_face_edit;

/* ---- log and threads ---- */

/** How much a line of the log matters. */
typedef enum fbs_log_level {
  FBS_LOG_ERROR,   /**< the work has ended */
  FBS_LOG_WARNING, /**< a viewer may see it: damage, a lost face, a bitrate that is not met */
  FBS_LOG_INFO,    /**< scenes, and the end of what a warning was about */
  FBS_LOG_DEBUG    /**< versions, threads, processor */
} fbs_log_level;

/** Told what happens, for people to read: wording is no part of the interface. May be called by any thread,
 * the library's own too, several at once, during any call for the object and for an encoder between calls.
 * Returns soon, throws nothing, and calls no function of the object.
 * @param user   that of the settings
 * @param level  fbs_log_level
 * @param text   one line, valid during the call */
typedef void (*fbs_log)(void* user, int level, const char* text);

/** Called on each thread that the library starts, before its work: to set priority, cores, or the name that a
 * debugger shows. Several may call it at once. Throws nothing, and calls no function of the object.
 * @param name  "fbs-draw", "fbs-code", "fbs-analyse" or "fbs-worker": at most 15 characters */
typedef void (*fbs_thread_start)(void* user, const char* name);

/* ---- decoder ---- */

typedef struct fbs_decoder fbs_decoder;

#define FBS_MAX_THREADS 64

/** Filled by fbs_decoder_default_settings(&settings, sizeof settings). */
typedef struct fbs_decoder_settings {
  size_t struct_size;
  /** Streams with more pixels per picture are refused with FBS_ERROR_TOO_LARGE before memory is allocated.
   * 0: FBS_MAX_SIDE * FBS_MAX_SIDE. Default: 0. A decoder takes about 3 bytes per pixel, and 1 MB, for each
   * of a scene's patterns, of which there are 64 at most, and about 30 bytes per pixel besides. There are up
   * to 3 scenes, besides the present one, to which a stream may return. */
  uint64_t max_pixels;
  /** Threads that draw, up to FBS_MAX_THREADS, including the caller's; 0: as many as there are cores. With
   * more than 1, while pictures are drawn in a row, others draw those that follow and whose packets have been
   * fed; pictures are the same, and none is later. Each takes about 20 bytes per pixel. Default: 1. */
  int threads;
  fbs_log log;                   /**< null (default): nobody is told */
  fbs_thread_start thread_start; /**< null (default): nothing is done */
  void* user;                    /**< passed to both; lives as long as the decoder */
  /** Null (default), or FBS_ERROR_SIZE bytes: fbs_decoder_open() writes there why it fails, in one line; ""
   * if it does not. Not needed after the call. */
  char* open_error;
} fbs_decoder_settings;

/** @param settings     null: nothing happens
 * @param struct_size  sizeof *settings: the bytes to write */
FBS_API void fbs_decoder_default_settings(fbs_decoder_settings* settings, size_t struct_size);

/** Creates a decoder for one stream.
 * @param out       set to the decoder, to be freed by fbs_decoder_close(); to null on failure
 * @param settings  null: defaults; not needed after the call
 * @return FBS_OK, FBS_ERROR_ARGUMENT, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_decoder_open(fbs_decoder** out, const fbs_decoder_settings* settings);

/** Frees the decoder, with everything it has returned, and sets *decoder to null. Null is allowed. */
FBS_API void fbs_decoder_close(fbs_decoder** decoder);

/** Copies the next bytes of the stream, in pieces of any size. Bytes not yet decoded are kept: call
 * fbs_decoder_next() until it needs data.
 * This function and fbs_decoder_feed_packet() may run in one thread while another is in
 * fbs_decoder_get_picture(), fbs_decoder_draw() or fbs_decoder_draw_state(), and leave pictures valid. No
 * other two calls for one decoder run at once.
 * @return FBS_OK; FBS_ERROR_ARGUMENT after fbs_decoder_finish() or fbs_decoder_feed_packet(), or when bytes
 *         is null and size is not 0; FBS_ERROR_NO_MEMORY, with nothing taken */
FBS_API fbs_status fbs_decoder_feed(fbs_decoder* decoder, const uint8_t* bytes, size_t size);

/** How many numbers late a packet may come without harm: fbs_decoder_feed_packet(). */
#define FBS_REORDER 8

/** The same for a link that loses packets or changes their order: copies what one of its packets brings,
 * which is whole packets of the stream, such as what fbs_encoder_pull() returns. A stream is fed by one of
 * the two functions.
 *
 * Packets are decoded by rising number. One that is missing is waited for: fbs_decoder_next() returns
 * FBS_NEED_DATA at its place until a number more than FBS_REORDER above it has come, or
 * fbs_decoder_skip_missing(), fbs_decoder_packets_lost() or fbs_decoder_finish() is called. Then decoding
 * goes on without it, which is no error: info.quality says what a picture lacks. If it comes after all,
 * pictures that have been returned stay as they were, and those behind it are as if it had come in order.
 * One that comes twice has no effect.
 *
 * A viewer who joins later begins with any number above FBS_REORDER. If that is not the first of a scene,
 * packets below it are waited for as for missing ones; in any case they are accepted until a picture has been
 * returned.
 * @param number  one more for each packet that is sent, 0 or 1 for the first of the stream; below 2^64 - 1
 * @return FBS_OK; FBS_ERROR_ARGUMENT after fbs_decoder_finish() or fbs_decoder_feed(), for a number beyond
 *         its range, or when bytes is null and size is not 0; FBS_ERROR_NO_MEMORY, with nothing taken */
FBS_API fbs_status fbs_decoder_feed_packet(fbs_decoder* decoder, uint64_t number, const uint8_t* bytes,
                                           size_t size);

/** Numbers of packets that are missing and still of use, by rising number: to be asked for. Those that are
 * waited for are among them, which may only be late.
 * @param out    null when most is 0
 * @param most   how many at most
 * @param count  set to how many were written
 * @return FBS_OK, FBS_ERROR_ARGUMENT */
FBS_API fbs_status fbs_decoder_get_missing(fbs_decoder* decoder, uint64_t* out, size_t most, size_t* count);

/** Packets below this number that are missing will not come: they are not waited for, nor kept a place for.
 * @return FBS_OK, FBS_ERROR_ARGUMENT */
FBS_API fbs_status fbs_decoder_packets_lost(fbs_decoder* decoder, uint64_t before);

/** Says that the next picture is due: fbs_decoder_next() goes on with the lowest number behind the missing
 * ones that it waits for. To be called when that has returned FBS_NEED_DATA and the picture cannot wait any
 * longer; where a jitter buffer has waited already, whenever it returns FBS_NEED_DATA.
 * @return FBS_OK; FBS_NEED_DATA: all packets that have come have been decoded; FBS_ERROR_ARGUMENT */
FBS_API fbs_status fbs_decoder_skip_missing(fbs_decoder* decoder);

/** Says whether to ask the sender for a scene: fbs_encoder_request_scene().
 * @return 1: because of what is missing, nothing that follows can be decoded until a scene begins.
 *         0: packets can be decoded, or may still come. Where a pattern alone is missing
 *         (FBS_QUALITY_PATTERN_MISSING), fbs_encoder_lose_patterns() costs less. 0 for null, too */
FBS_API int fbs_decoder_needs_scene(const fbs_decoder* decoder);

/** Ends the stream: the rest is returned, then FBS_END. Repeating the call has no effect.
 * @return FBS_OK, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_decoder_finish(fbs_decoder* decoder);

/** Advances to the next picture, without drawing it.
 * @param info  may be null
 * @return FBS_OK: the functions below refer to the next picture;
 *         FBS_NEED_DATA, FBS_END: there is none; the functions below still refer to the last one;
 *         an error: reported once. The next call continues after the damage, at the next scene, and returns
 *         FBS_END when there is none. Pictures known to be lost are held: fbs_picture_info.
 *         After FBS_ERROR_NO_MEMORY everything is lost: FBS_END until fbs_decoder_reset() */
FBS_API fbs_status fbs_decoder_next(fbs_decoder* decoder, fbs_picture_info* info);

/** Forgets everything but settings and edit: the decoder is as new. To seek, reset, then feed the stream from
 * a setup packet on: fbs_find_scene(). The stream's signature, its first four bytes, may then be left out.
 * @return FBS_OK; FBS_ERROR_NO_MEMORY, with nothing changed */
FBS_API fbs_status fbs_decoder_reset(fbs_decoder* decoder);

/** Sets a viewer's changes to the face of all pictures, until the next call: they are drawn and described
 * with them. Lips and lids never cross.
 * @param edit  null: none, as at first
 * @return FBS_OK; FBS_ERROR_ARGUMENT when a member of `edit` is not a number */
FBS_API fbs_status fbs_decoder_set_edit(fbs_decoder* decoder, const fbs_face_edit* edit);

/** Draws the picture into the decoder's memory.
 * @param out  set to planes that stay valid and unchanged until the next call for this decoder of any
 *             function other than fbs_decoder_get_...
 * @return FBS_OK; FBS_ERROR_ARGUMENT before the first picture; FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_decoder_get_picture(fbs_decoder* decoder, fbs_const_picture* out);

/** Draws the picture into the caller's memory.
 * @param picture  of the format's size, otherwise FBS_ERROR_ARGUMENT is returned; |stride| is at least the
 *                 plane's width. Exactly width * height samples of each plane are written */
FBS_API fbs_status fbs_decoder_draw(fbs_decoder* decoder, const fbs_picture* picture);

/** Draws the face in a state of the caller's, in the scene of the picture announced last: the view of a user
 * who turns the head. Does not affect what fbs_decoder_get_picture() returns. With the state of
 * fbs_decoder_get_state() it draws the picture as sent; so does any state where a held picture's scene is
 * gone.
 * @param state    numbers of any kind within the format's limits: rotations of +-90 degrees, control points
 *                 of +-2, an eye distance of 1 to 8192 pixels, a place within +-16384 pixels
 * @param picture  as for fbs_decoder_draw()
 * @return FBS_OK; FBS_ERROR_ARGUMENT: beyond a limit, or before the first picture; FBS_ERROR_NO_FACE;
 *         FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_decoder_draw_state(fbs_decoder* decoder, const fbs_face_state* state,
                                          const fbs_picture* picture);

/** @return FBS_OK; FBS_NEED_DATA until the setup has arrived */
FBS_API fbs_status fbs_decoder_get_format(const fbs_decoder* decoder, fbs_format* out);

/* These describe the picture that fbs_decoder_next() announced last, without drawing it. Each returns FBS_OK;
 * FBS_ERROR_NO_FACE in a scene without a face; FBS_ERROR_ARGUMENT before the first picture. */

FBS_API fbs_status fbs_decoder_get_state(const fbs_decoder* decoder, fbs_face_state* out);
/** @param out  FBS_LANDMARKS points */
FBS_API fbs_status fbs_decoder_get_landmarks(const fbs_decoder* decoder, fbs_landmark* out);
/** @param out  FBS_BLENDSHAPES weights */
FBS_API fbs_status fbs_decoder_get_blendshapes(const fbs_decoder* decoder, float* out);
/** @param out    the vertices of the scene's wire-frame
 * @param count  before: capacity of `out`; after: number of vertices, 0 without a face. If the capacity is
 *               too
 *               small, nothing is written and the result is FBS_ERROR_ARGUMENT */
FBS_API fbs_status fbs_decoder_get_vertices(const fbs_decoder* decoder, fbs_vertex* out, size_t* count);

/** The cause of the last call that returned an error for this decoder, in one line; "" before the first.
 * Never null; valid until the next call for this decoder. */
FBS_API const char* fbs_decoder_error(const fbs_decoder* decoder);
/** The offset of the last error in the stream, from the first byte fed; 0 if it has none. */
FBS_API uint64_t fbs_decoder_error_offset(const fbs_decoder* decoder);

/* ---- without a decoder ---- */

/** A scene: where decoding can begin. */
typedef struct fbs_scene {
  uint64_t offset; /**< of its setup packet, bytes */
  uint64_t number; /**< of its first picture */
  uint64_t time;   /**< of its first picture, ticks */
} fbs_scene;

/** Finds the scene that contains a time: the last one that begins at or before it, or the first. Skips
 * damaged parts of the stream.
 * @param bytes  the whole stream
 * @return FBS_OK; FBS_END when there is no scene in it; FBS_ERROR_ARGUMENT, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_find_scene(const uint8_t* bytes, size_t size, uint64_t time, fbs_scene* out);

#ifdef __cplusplus
}
#endif

#endif
