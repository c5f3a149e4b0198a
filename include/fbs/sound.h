/* fbs, a video codec for talking heads: the sound of a stream, decoded. fbs/fbs.h says what holds for all
 * functions.
 *
 *     fbs_sound* sound = NULL;
 *     fbs_sound_open(&sound);
 *     fbs_sound_feed(sound, bytes, size);  // the same bytes as fbs_decoder_feed() takes
 *     fbs_samples samples;
 *     if (fbs_sound_take(sound, picture.time + picture.duration, &samples) == FBS_OK) play(&samples);
 *     fbs_sound_close(&sound); */
#ifndef FBS_SOUND_H
#define FBS_SOUND_H

#include <fbs/fbs.h>

#ifdef __cplusplus
extern "C" {
#endif

/** Reads a stream's sound, and skips what is damaged: fbs_decoder_next() reports it. */
typedef struct fbs_sound fbs_sound;

/** @param out  set to the object, to be freed by fbs_sound_close(); to null on failure
 * @return FBS_OK, FBS_ERROR_ARGUMENT, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_sound_open(fbs_sound** out);

/** Frees the object, and sets *sound to null. Null is allowed. */
FBS_API void fbs_sound_close(fbs_sound** sound);

/** Copies the next bytes of the stream, in pieces of any size.
 * @return FBS_OK; FBS_ERROR_ARGUMENT when bytes is null and size is not 0; FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_sound_feed(fbs_sound* sound, const uint8_t* bytes, size_t size);

/** What has come so far. */
typedef struct fbs_sound_info {
  uint32_t sample_rate; /**< Hz; 0 until sound has come that can be decoded */
  uint32_t channels;    /**< 1 or 2; 0 as above */
  uint64_t bytes;       /**< of sound packets */
  /** End of the pictures that can be shown, with all before them, ticks: their sound has come, unless it was
   * lost. */
  uint64_t shown_until;
} fbs_sound_info;

/** @return FBS_OK, FBS_ERROR_ARGUMENT, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_sound_get_info(fbs_sound* sound, fbs_sound_info* out);

/** Makes a time, in ticks, that of the next sample. At first it is 0. */
FBS_API fbs_status fbs_sound_seek(fbs_sound* sound, uint64_t time);

/** Unit of the time of samples: 1/48000 s. */
#define FBS_SOUND_TICKS_PER_SECOND 48000

typedef struct fbs_samples {
  uint64_t time;                  /**< of the first one, 1/FBS_SOUND_TICKS_PER_SECOND s */
  uint32_t sample_rate, channels; /**< Hz; 1 or 2 */
  size_t count;                   /**< of each channel */
  const int16_t* data;            /**< channels interleaved; valid until the next call for this object */
} fbs_samples;

/** Takes the samples from where the last call, or fbs_sound_seek(), ended: up to a time, or as far as sound
 * has come. What was lost is silence.
 * @param end  ticks
 * @return FBS_OK, also when there are none; FBS_NEED_DATA until sound has come that can be decoded;
 *         FBS_ERROR_ARGUMENT, FBS_ERROR_NO_MEMORY */
FBS_API fbs_status fbs_sound_take(fbs_sound* sound, uint64_t end, fbs_samples* out);

/** As fbs_decoder_error(). */
FBS_API const char* fbs_sound_error(const fbs_sound* sound);

#ifdef __cplusplus
}
#endif

#endif
