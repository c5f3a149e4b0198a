/* Bytes to frames and back. A frame has
 *
 *     2 bytes   its number (12 bits) and, in a spare one, how many frames with data its group has (4 bits)
 *     1 byte    a check of these
 *     1 byte    how many of the bytes that follow are used
 *     bytes of the stream, filled up with zeros
 *     parity    Reed-Solomon over all before: repairs half as many wrong bytes
 *
 * After each group of frames with data come spare ones, whose bytes from the fourth on are Reed-Solomon over
 * the bytes at the same place in the group: they replace as many frames that are lost. */
#ifndef RADIO_CODE_H
#define RADIO_CODE_H

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "kiss.h"

enum { HEADER = 3, MAX_GROUP = 15, MAX_CYCLE = 2 * MAX_GROUP };

/* Both ends need the same. */
typedef struct {
  size_t frame;  /* bytes of each frame */
  size_t parity; /* bytes of it; 0: wrong bytes are neither noticed nor repaired */
  size_t group;  /* frames with data, 1..MAX_GROUP */
  size_t spare;  /* frames behind them, 0..MAX_GROUP */
} radio_layout;

typedef struct {
  radio_layout layout;
  void *rows, *columns; /* codes of libfec; null without parity and without spares */
  unsigned number;      /* of the group's first frame */
  uint8_t body[MAX_CYCLE][MAX_FRAME];
} radio_code;

/* Returns 0 when out of memory. */
int code_open(radio_code* code, const radio_layout* layout);
void code_close(radio_code* code);

typedef struct {
  radio_code code;
  FILE* out;
  size_t full, used;      /* frames of the group that are sent, and bytes in the next one */
  uint64_t frames, bytes; /* what was written */
} radio_sender;

/* Both return 0 when writing failed. */
int send_bytes(radio_sender* sender, const uint8_t* bytes, size_t size);
int send_rest(radio_sender* sender);

typedef enum { FRAME_MISSING, FRAME_DOUBTFUL, FRAME_RIGHT } frame_state;

typedef struct {
  radio_code code;
  FILE* out;
  int started;
  frame_state state[MAX_CYCLE];
  size_t data;                               /* frames with data in this group; 0: not known yet */
  size_t next;                               /* the first of them that is not written yet */
  size_t last;                               /* one more than the highest place of a frame that has come */
  uint64_t sent, frames, repaired, doubtful; /* sent, as far as known; those that came, and which of them */
  uint64_t replaced, lost_bytes; /* frames that spares replaced; zeros written for those that were lost */
} radio_receiver;

/* A kiss_take. */
void receive_frame(void* receiver, const uint8_t* frame);
/* Writes what still waits for spare frames. */
void receive_rest(radio_receiver* receiver);

#endif
