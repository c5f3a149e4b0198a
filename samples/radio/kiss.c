#include "kiss.h"

#include <string.h>

enum { FESC = 0xDB, TFEND = 0xDC, TFESC = 0xDD, DATA_FRAME = 0 };

size_t kiss_write(FILE* out, const uint8_t* frame, size_t size) {
  uint8_t bytes[2 * MAX_FRAME + 2];
  size_t count = 0;
  bytes[count++] = DATA_FRAME;
  for (size_t i = 0; i < size; ++i) {
    const int escaped = frame[i] == KISS_FEND || frame[i] == FESC;
    if (escaped) bytes[count++] = FESC;
    bytes[count++] = !escaped ? frame[i] : frame[i] == KISS_FEND ? TFEND : TFESC;
  }
  bytes[count++] = KISS_FEND;
  return fwrite(bytes, 1, count, out) == count ? count : 0;
}

/* All frames have the same size, so the number of bytes tells a FEND from a byte that became one. A command
 * or an escape that is hit costs its frame. */
static void end_piece(kiss_reader* reader) {
  const size_t with_command = reader->size + 1, count = reader->count;
  if (count == reader->piece && count != with_command) return; /* FENDs may be repeated */
  if (count - reader->piece == with_command) {
    reader->take(reader->context, reader->bytes + reader->piece + 1);
  } else if (count >= with_command) { /* a byte became a FEND, or a FEND around frames was hit */
    reader->take(reader->context, reader->bytes + 1);
    if (count > with_command) reader->take(reader->context, reader->bytes + count - reader->size);
  } else { /* wait for the rest */
    reader->bytes[reader->count++] = KISS_FEND;
    reader->piece = reader->count;
    return;
  }
  reader->count = reader->piece = 0;
}

static void append(kiss_reader* reader, uint8_t byte) {
  if (reader->count == sizeof reader->bytes) { /* nothing in them is a frame */
    memmove(reader->bytes, reader->bytes + 1, --reader->count);
    if (reader->piece > 0) --reader->piece;
  }
  reader->bytes[reader->count++] = byte;
}

void kiss_read(kiss_reader* reader, uint8_t byte) {
  if (reader->escaped) {
    reader->escaped = 0;
    if (byte == TFEND || byte == TFESC) {
      append(reader, byte == TFEND ? KISS_FEND : FESC);
      return;
    }
    append(reader, FESC); /* a byte that became an escape; what follows it is as it was sent */
  }
  if (byte == FESC)
    reader->escaped = 1;
  else if (byte == KISS_FEND)
    end_piece(reader);
  else
    append(reader, byte);
}
