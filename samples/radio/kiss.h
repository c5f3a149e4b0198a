/* KISS: frames in a stream of bytes, between bytes FEND. */
#ifndef RADIO_KISS_H
#define RADIO_KISS_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#define KISS_FEND 0xC0
#define MAX_FRAME 255 /* bytes; what a Reed-Solomon code over bytes can span */

/* Writes a frame, its command and the FEND behind it. The one before it is that of the frame before.
 * Returns the bytes written, 0 when that failed. */
size_t kiss_write(FILE* out, const uint8_t* frame, size_t size);

/* Takes what may be a frame: a check inside it has to tell. */
typedef void (*kiss_take)(void* context, const uint8_t* frame);

/* Finds frames of one size where bits of the bytes between them are wrong, too. Zeros at first, but for
 * `size`, `take` and `context`. */
typedef struct {
  size_t size; /* of each frame */
  kiss_take take;
  void* context;
  uint8_t bytes[2 * MAX_FRAME + 4]; /* since the last frame, each beginning with its command */
  size_t count, piece;              /* piece: where those behind the last FEND begin */
  int escaped;
} kiss_reader;

void kiss_read(kiss_reader* reader, uint8_t byte);

#endif
