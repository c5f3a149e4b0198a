#include "code.h"

#include <fec.h>
#include <string.h>

enum { SYMBOLS = 255, NUMBERS = 1 << 12 };

static void* reed_solomon(size_t data, size_t parity) {
  return init_rs_char(8, 0x11d, 1, 1, (int)parity, (int)(SYMBOLS - data - parity));
}

int code_open(radio_code* code, const radio_layout* layout) {
  code->layout = *layout;
  if (layout->parity > 0) code->rows = reed_solomon(layout->frame - layout->parity, layout->parity);
  if (layout->spare > 0) code->columns = reed_solomon(layout->group, layout->spare);
  return (layout->parity == 0 || code->rows != NULL) && (layout->spare == 0 || code->columns != NULL);
}

void code_close(radio_code* code) {
  if (code->rows != NULL) free_rs_char(code->rows);
  if (code->columns != NULL) free_rs_char(code->columns);
}

static size_t body_size(const radio_layout* layout) {
  return layout->frame - HEADER - layout->parity;
}

static size_t cycle(const radio_layout* layout) {
  return layout->group + layout->spare;
}

/* Numbers begin again after as many whole groups as fit, so that each tells the place in its group. */
static unsigned numbers(const radio_layout* layout) {
  return (unsigned)(NUMBERS / cycle(layout) * cycle(layout));
}

static void next_group(radio_code* code) {
  code->number = (code->number + (unsigned)cycle(&code->layout)) % numbers(&code->layout);
  memset(code->body, 0, sizeof code->body);
}

/* CRC-8 with the polynomial x^8 + x^2 + x + 1: up to three wrong bits of the header are noticed. */
static uint8_t header_check(const uint8_t* header) {
  unsigned crc = 0xFF;
  for (int bit = 0; bit < 16; ++bit) {
    const unsigned in = header[bit / 8] >> (7 - bit % 8) & 1u;
    crc = (crc << 1 & 0xFF) ^ ((crc >> 7 ^ in) ? 0x07 : 0);
  }
  return (uint8_t)crc;
}

/* ---- sender ---- */

static int send_frame(radio_sender* sender, size_t place, size_t data) {
  const radio_layout* const layout = &sender->code.layout;
  const unsigned number = sender->code.number + (unsigned)place;
  uint8_t frame[MAX_FRAME] = {(uint8_t)(data << 4 | number >> 8), (uint8_t)number};
  frame[2] = header_check(frame);
  memcpy(frame + HEADER, sender->code.body[place], body_size(layout));
  if (layout->parity > 0) encode_rs_char(sender->code.rows, frame, frame + layout->frame - layout->parity);
  const size_t written = kiss_write(sender->out, frame, layout->frame);
  ++sender->frames;
  sender->bytes += written;
  return written > 0;
}

static int send_spares(radio_sender* sender) {
  const radio_layout* const layout = &sender->code.layout;
  for (size_t at = 0; at < body_size(layout) && layout->spare > 0; ++at) {
    uint8_t column[MAX_GROUP], parity[MAX_GROUP];
    for (size_t i = 0; i < layout->group; ++i) column[i] = sender->code.body[i][at];
    encode_rs_char(sender->code.columns, column, parity);
    for (size_t i = 0; i < layout->spare; ++i) sender->code.body[layout->group + i][at] = parity[i];
  }
  for (size_t i = 0; i < layout->spare; ++i)
    if (!send_frame(sender, layout->group + i, sender->full)) return 0;
  sender->full = 0;
  next_group(&sender->code);
  return 1;
}

static int send_data(radio_sender* sender) {
  sender->code.body[sender->full][0] = (uint8_t)sender->used;
  sender->used = 0;
  if (!send_frame(sender, sender->full++, 0)) return 0;
  return sender->full < sender->code.layout.group || send_spares(sender);
}

int send_bytes(radio_sender* sender, const uint8_t* bytes, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    sender->code.body[sender->full][1 + sender->used++] = bytes[i];
    if (1 + sender->used == body_size(&sender->code.layout) && !send_data(sender)) return 0;
  }
  return 1;
}

int send_rest(radio_sender* sender) {
  if (sender->used > 0 && !send_data(sender)) return 0;
  return sender->full == 0 || send_spares(sender);
}

/* ---- receiver ---- */

/* Replaces data that are not right, once there are spare frames enough. */
static void replace_lost(radio_receiver* receiver) {
  const radio_layout* const layout = &receiver->code.layout;
  int lost[MAX_CYCLE], count = 0;
  size_t data_lost = 0;
  if (receiver->data == 0) return; /* no spare one has come */
  for (size_t i = 0; i < cycle(layout); ++i) {
    const int unsent = i >= receiver->data && i < layout->group;
    if (receiver->state[i] == FRAME_RIGHT || unsent) continue;
    data_lost += i < receiver->data;
    lost[count++] = (int)i;
  }
  if (data_lost == 0 || count > (int)layout->spare) return;
  for (size_t at = 0; at < body_size(layout); ++at) {
    uint8_t column[MAX_CYCLE];
    int places[MAX_CYCLE];
    memcpy(places, lost, sizeof places);
    for (size_t i = 0; i < cycle(layout); ++i) column[i] = receiver->code.body[i][at];
    decode_rs_char(receiver->code.columns, column, places, count);
    for (size_t i = 0; i < receiver->data; ++i) receiver->code.body[i][at] = column[i];
  }
  for (size_t i = 0; i < receiver->data; ++i) receiver->state[i] = FRAME_RIGHT;
  receiver->replaced += data_lost;
}

/* Zeros for what is lost keep what follows in its place, so that a decoder that has read the length of a
 * packet need not wait for bytes of later ones. */
static void write_frame(radio_receiver* receiver, size_t i) {
  const size_t most = body_size(&receiver->code.layout) - 1;
  const uint8_t* const body = receiver->code.body[i];
  const size_t used = receiver->state[i] != FRAME_RIGHT || body[0] > most ? most : body[0];
  if (receiver->state[i] == FRAME_MISSING) receiver->lost_bytes += used;
  fwrite(body + 1, 1, used, receiver->out);
}

/* wait: as long as spare frames may come for those that are not right. */
static void write_frames(radio_receiver* receiver, size_t end, int wait) {
  for (; receiver->next < end; ++receiver->next) {
    if (wait && receiver->state[receiver->next] != FRAME_RIGHT) break;
    write_frame(receiver, receiver->next);
  }
  fflush(receiver->out);
}

static void end_group(radio_receiver* receiver, int at_end) {
  const radio_layout* const layout = &receiver->code.layout;
  const size_t seen = receiver->last < layout->group ? receiver->last : layout->group;
  const size_t data = receiver->data > 0 ? receiver->data : at_end ? seen : layout->group;
  write_frames(receiver, data, 0);
  receiver->sent += at_end && receiver->data == 0 ? receiver->last : data + layout->spare;
  memset(receiver->state, 0, sizeof receiver->state);
  receiver->data = receiver->next = receiver->last = 0;
  next_group(&receiver->code);
}

/* A number far behind is that of a sender that has begun anew: nothing overtakes in a pipe. A doubtful one is
 * not believed that far. Returns whether the group is that of the number. */
static int go_to_group_of(radio_receiver* receiver, unsigned number, int doubtful) {
  radio_code* const code = &receiver->code;
  const unsigned all = numbers(&code->layout), group = (unsigned)cycle(&code->layout);
  unsigned ahead = (number + all - code->number) % all;
  if (receiver->started && doubtful && ahead >= 2 * group) return 0;
  if (!receiver->started || ahead >= all / 2) {
    if (receiver->started) end_group(receiver, 1);
    code->number = number - number % group;
    receiver->started = 1;
    return 1;
  }
  for (; ahead >= group; ahead -= group) end_group(receiver, 0);
  return 1;
}

void receive_frame(void* context, const uint8_t* bytes) {
  radio_receiver* const receiver = context;
  const radio_layout* const layout = &receiver->code.layout;
  uint8_t frame[MAX_FRAME];
  memcpy(frame, bytes, layout->frame);
  /* Bytes that were wrong; negative, and nothing has changed, when they are too many. */
  const int found = layout->parity > 0 ? decode_rs_char(receiver->code.rows, frame, NULL, 0) : 0;
  const unsigned number = (frame[0] & 15u) << 8 | frame[1];
  if (header_check(frame) != frame[2] || number >= numbers(layout)) return;
  if (!go_to_group_of(receiver, number, found < 0)) return;

  const size_t place = number - receiver->code.number, data = frame[0] >> 4;
  if (receiver->state[place] == FRAME_RIGHT) return;
  ++receiver->frames;
  receiver->repaired += found > 0;
  receiver->doubtful += found < 0;
  /* What cannot be repaired is passed on: the checks of the stream's packets tell which of them were hit. */
  receiver->state[place] = found < 0 ? FRAME_DOUBTFUL : FRAME_RIGHT;
  memcpy(receiver->code.body[place], frame + HEADER, body_size(layout));
  if (receiver->last < place + 1) receiver->last = place + 1;
  if (place >= layout->group && found >= 0 && data <= layout->group) receiver->data = data;
  replace_lost(receiver);
  const size_t known = receiver->data > 0 ? receiver->data : layout->group;
  write_frames(receiver, receiver->last < known ? receiver->last : known, layout->spare > 0);
}

void receive_rest(radio_receiver* receiver) {
  if (receiver->started) end_group(receiver, 1);
}
