#include "compare.h"

#include <fbs/packet.h>
#include <math.h>
#include <stdio.h>

typedef struct {
  fbs_decoder* decoder;
  unsigned pictures, sound; /* packets that are whole */
} stream;

static int open_stream(const char* name, stream* out) {
  fbs_packet_reader* reader = NULL;
  FILE* const file = fopen(name, "rb");
  if (file == NULL) return perror(name), 0;
  int good = fbs_decoder_open(&out->decoder, NULL) == FBS_OK && fbs_packet_reader_open(&reader) == FBS_OK;
  uint8_t bytes[4096];
  for (size_t size; good && (size = fread(bytes, 1, sizeof bytes, file)) > 0;)
    good = fbs_decoder_feed(out->decoder, bytes, size) == FBS_OK &&
           fbs_packet_reader_feed(reader, bytes, size) == FBS_OK;
  fclose(file);
  fbs_decoder_finish(out->decoder);
  fbs_packet_reader_finish(reader);
  fbs_packet_info packet;
  for (fbs_status status; good && (status = fbs_packet_reader_next(reader, &packet)) != FBS_END;) {
    if (status != FBS_OK || packet.fault != NULL) continue;
    ++*(packet.type == FBS_PACKET_SOUND_SETUP || packet.type == FBS_PACKET_SOUND ? &out->sound
                                                                                 : &out->pictures);
  }
  fbs_packet_reader_close(&reader);
  return good;
}

/* The next picture, whatever is wrong before it; returns 0 at the end. */
static int next_picture(const stream* from, fbs_picture_info* info) {
  fbs_status status = fbs_decoder_next(from->decoder, info);
  while (status < 0) status = fbs_decoder_next(from->decoder, info);
  return status == FBS_OK;
}

typedef struct {
  unsigned sent, exact, concealed;
  double error, samples; /* squared error of the concealed ones, sum over all samples, and their number */
} picture_count;

static double squared_error(const fbs_const_picture* a, const fbs_const_picture* b, int plane, size_t width,
                            size_t height) {
  double sum = 0;
  for (size_t y = 0; y < height; ++y) {
    const uint8_t* const p = a->data[plane] + (ptrdiff_t)y * a->stride[plane];
    const uint8_t* const q = b->data[plane] + (ptrdiff_t)y * b->stride[plane];
    for (size_t x = 0; x < width; ++x) sum += (p[x] - q[x]) * (p[x] - q[x]);
  }
  return sum;
}

static void compare_pictures(const stream* sent, const stream* received, picture_count* count) {
  fbs_const_picture a, b;
  if (fbs_decoder_get_picture(sent->decoder, &a) != FBS_OK ||
      fbs_decoder_get_picture(received->decoder, &b) != FBS_OK || a.width != b.width || a.height != b.height)
    return;
  const size_t width = (a.width + 1) / 2, height = (a.height + 1) / 2; /* of chroma */
  const double error = squared_error(&a, &b, 0, a.width, a.height) + squared_error(&a, &b, 1, width, height) +
                       squared_error(&a, &b, 2, width, height);
  if (error == 0) {
    ++count->exact;
    return;
  }
  ++count->concealed;
  count->error += error;
  count->samples += (double)a.width * (double)a.height + 2 * (double)width * (double)height;
}

/* Pictures have numbers: whatever is missing, both streams' are known to be the same one. */
static picture_count count_pictures(const stream* sent, const stream* received) {
  picture_count count = {0, 0, 0, 0, 0};
  fbs_picture_info here, there;
  int more = next_picture(received, &there);
  for (; next_picture(sent, &here); ++count.sent) {
    while (more && there.number < here.number) more = next_picture(received, &there);
    if (more && there.number == here.number && !there.held) compare_pictures(sent, received, &count);
  }
  return count;
}

int compare_streams(const char* sent_name, const char* received_name) {
  stream sent = {NULL, 0, 0}, received = {NULL, 0, 0};
  const int good = open_stream(sent_name, &sent) && open_stream(received_name, &received);
  if (good) {
    const picture_count count = count_pictures(&sent, &received);
    const double share = count.sent > 0 ? 100.0 / count.sent : 0;
    printf("packets: %u of %u, and %u of %u of the sound\n", received.pictures, sent.pictures, received.sound,
           sent.sound);
    printf("pictures: %.1f %% of %u exact, %.1f %% concealed, %.1f %% frozen", share * count.exact,
           count.sent, share * count.concealed, share * (count.sent - count.exact - count.concealed));
    if (count.concealed > 0)
      printf("; concealed ones: %.1f dB", 10 * log10(255.0 * 255.0 * count.samples / count.error));
    printf("\n");
  }
  fbs_decoder_close(&sent.decoder);
  fbs_decoder_close(&received.decoder);
  return good ? 0 : 1;
}
