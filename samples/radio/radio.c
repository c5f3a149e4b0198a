/* radio send|channel|receive|compare: a stream of fbs over a narrow radio modem; README.md says how to use
 * it. The first three are a pipe, and report on standard error. kiss.c has what lies between the frames,
 * code.c what is in them, compare.c what it was worth. Needs libfbs and libfec. */
#include <fbs/packet.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "code.h"
#include "compare.h"

typedef struct {
  radio_layout layout;
  double modem;            /* bit/s */
  double bit_errors, drop; /* probability for each bit, and for each frame in percent */
  size_t seed;
} radio_options;

/* Bytes as they come, rather than as many as fit. */
static size_t read_some(uint8_t* bytes, size_t room) {
  const ssize_t size = read(STDIN_FILENO, bytes, room);
  return size > 0 ? (size_t)size : 0;
}

/* ---- send ---- */

/* When a modem of constant rate has sent what there is. Times are seconds of the video. */
typedef struct {
  uint64_t stream_bytes, packets, given; /* given: bytes that the modem has */
  double shown, oldest, busy_until;      /* oldest: the first picture with bytes that the modem has not */
  double latest;                         /* most that a picture came late */
} radio_clock;

/* The bytes up to a packet that shows pictures are there when the encoder has seen the last of these. */
static void advance_clock(radio_clock* clock, const fbs_packet_info* packet, const radio_sender* sender,
                          double modem) {
  const int first = clock->shown == 0;
  clock->shown = (double)packet->shown_until / FBS_TICKS_PER_SECOND;
  if (first) clock->oldest = clock->shown;
  if (sender->bytes == clock->given) return;
  if (clock->busy_until < clock->shown) clock->busy_until = clock->shown;
  clock->busy_until += 8 * (double)(sender->bytes - clock->given) / modem;
  if (clock->latest < clock->busy_until - clock->oldest) clock->latest = clock->busy_until - clock->oldest;
  clock->given = sender->bytes;
  clock->oldest = clock->shown;
}

static void report_sent(const radio_sender* sender, const radio_clock* clock, double modem) {
  const double air = (double)sender->bytes, stream = (double)clock->stream_bytes;
  const double frames = (double)sender->frames * (double)sender->code.layout.frame;
  const double kbits = clock->shown > 0 ? 0.008 / clock->shown : 0;
  fprintf(stderr, "stream: %.0f bytes, %llu packets, %.2f s, %.2f kbit/s\n", stream,
          (unsigned long long)clock->packets, clock->shown, kbits * stream);
  fprintf(stderr,
          "on air: %.0f bytes, %llu frames, %.2f kbit/s: code and headers add %.1f %%, KISS %.1f %%\n", air,
          (unsigned long long)sender->frames, kbits * air, 100 * (frames - stream) / stream,
          100 * (air - frames) / stream);
  fprintf(stderr, "at %.0f bit/s: busy for %.0f %% of the time, pictures at most %.1f s late\n", modem,
          100000 * kbits * air / modem, clock->latest);
}

static int send_stream(const radio_options* options) {
  radio_sender sender = {.out = stdout};
  radio_clock clock = {0};
  fbs_packet_reader* reader = NULL;
  fbs_packet_info packet;
  uint8_t bytes[4096];
  int good = code_open(&sender.code, &options->layout) && fbs_packet_reader_open(&reader) == FBS_OK &&
             putchar(KISS_FEND) != EOF;
  for (size_t size; good && (size = read_some(bytes, sizeof bytes)) > 0;) {
    for (size_t i = 0; good && i < size; ++i) { /* one by one, so that the clock sees each packet end */
      good = send_bytes(&sender, bytes + i, 1) && fbs_packet_reader_feed(reader, bytes + i, 1) == FBS_OK;
      for (fbs_status status; (status = fbs_packet_reader_next(reader, &packet)) != FBS_NEED_DATA;) {
        clock.packets += status == FBS_OK;
        if (status == FBS_OK && packet.pictures > 0) advance_clock(&clock, &packet, &sender, options->modem);
      }
    }
    clock.stream_bytes += size;
    fflush(stdout);
  }
  good = good && send_rest(&sender);
  if (good && clock.stream_bytes > 0) report_sent(&sender, &clock, options->modem);
  fbs_packet_reader_close(&reader);
  code_close(&sender.code);
  return good;
}

/* ---- channel ---- */

/* Uniform in 0..1; a linear congruential generator, so that a seed gives the same errors everywhere. */
static double uniform(uint64_t* state) {
  *state = *state * 6364136223846793005u + 1442695040888963407u;
  return (double)(*state >> 11) / 9007199254740992.0;
}

static int damage_stream(const radio_options* options) {
  uint64_t state = options->seed * 0x9E3779B97F4A7C15u + 1, frames = 0, dropped = 0, bits = 0;
  int lost = 0, inside = 0;
  uint8_t bytes[4096];
  for (size_t size; (size = read_some(bytes, sizeof bytes)) > 0;) {
    for (size_t i = 0; i < size; ++i) {
      const int end = bytes[i] == KISS_FEND; /* of a frame, if it has begun */
      if (!inside && !end) {
        ++frames;
        lost = uniform(&state) < options->drop / 100;
        dropped += (uint64_t)lost;
      }
      const int leave_out = lost;
      inside = !end;
      if (end) lost = 0;
      if (leave_out) continue;
      for (int bit = 0; bit < 8; ++bit) {
        if (uniform(&state) >= options->bit_errors) continue;
        bytes[i] ^= (uint8_t)(1 << bit);
        ++bits;
      }
      putchar(bytes[i]);
    }
    fflush(stdout);
  }
  fprintf(stderr, "channel: %llu of %llu frames dropped, %llu bits wrong\n", (unsigned long long)dropped,
          (unsigned long long)frames, (unsigned long long)bits);
  return !ferror(stdout);
}

/* ---- receive ---- */

static int receive_stream(const radio_options* options) {
  radio_receiver receiver = {.out = stdout};
  kiss_reader reader = {.size = options->layout.frame, .take = receive_frame, .context = &receiver};
  uint8_t bytes[4096];
  const int good = code_open(&receiver.code, &options->layout);
  for (size_t size; good && (size = read_some(bytes, sizeof bytes)) > 0;)
    for (size_t i = 0; i < size; ++i) kiss_read(&reader, bytes[i]);
  if (good) kiss_read(&reader, KISS_FEND); /* the last one may have been hit */
  receive_rest(&receiver);
  fprintf(
      stderr,
      "frames: %llu of %llu came, %llu of them repaired, %llu beyond repair; %llu replaced by spare ones\n"
      "%llu bytes of the stream lost\n",
      (unsigned long long)receiver.frames, (unsigned long long)receiver.sent,
      (unsigned long long)receiver.repaired, (unsigned long long)receiver.doubtful,
      (unsigned long long)receiver.replaced, (unsigned long long)receiver.lost_bytes);
  code_close(&receiver.code);
  return good && !ferror(stdout);
}

/* ---- options ---- */

static int usage(void) {
  fprintf(
      stderr,
      "usage: radio send [--frame 40..255] [--parity 0..32] [--group 1..15] [--spare 0..15] [--modem BIT/S]\n"
      "       radio channel [--bit-errors 0..0.5] [--drop PERCENT] [--seed N]\n"
      "       radio receive [--frame ...] [--parity ...] [--group ...] [--spare ...], as for send\n"
      "       radio compare SENT.fbs RECEIVED.fbs\n");
  return 2;
}

static int count_in(size_t* out, double value, double least, double most) {
  if (!(value >= least && value <= most)) return 0;
  *out = (size_t)value;
  return value == floor(value);
}

static int number_in(double* out, double value, double least, double most) {
  *out = value;
  return value >= least && value <= most;
}

/* Returns 0 when there is no such option, or no such value of it. */
static int set_option(radio_options* options, const char* name, const char* text) {
  radio_layout* const layout = &options->layout;
  char* end = NULL;
  const double value = strtod(text, &end);
  if (end == text || *end != 0) return 0;
  if (strcmp(name, "--frame") == 0) return count_in(&layout->frame, value, 40, MAX_FRAME);
  if (strcmp(name, "--parity") == 0) return count_in(&layout->parity, value, 0, 32);
  if (strcmp(name, "--group") == 0) return count_in(&layout->group, value, 1, MAX_GROUP);
  if (strcmp(name, "--spare") == 0) return count_in(&layout->spare, value, 0, MAX_GROUP);
  if (strcmp(name, "--modem") == 0) return number_in(&options->modem, value, 1, 1e9);
  if (strcmp(name, "--bit-errors") == 0) return number_in(&options->bit_errors, value, 0, 0.5);
  if (strcmp(name, "--drop") == 0) return number_in(&options->drop, value, 0, 100);
  if (strcmp(name, "--seed") == 0) return count_in(&options->seed, value, 0, 1e9);
  return 0;
}

int main(int argc, char** argv) {
  const char* const verb = argc > 1 ? argv[1] : "";
  if (strcmp(verb, "compare") == 0) return argc == 4 ? compare_streams(argv[2], argv[3]) : usage();
  radio_options options = {{80, 6, 15, 4}, 9600, 1e-4, 0, 1};
  for (int i = 2; i < argc; i += 2)
    if (i + 1 == argc || !set_option(&options, argv[i], argv[i + 1])) return usage();
  if (options.layout.spare > 0 && options.layout.parity == 0) { /* it would spread wrong bytes */
    fprintf(stderr, "radio: --spare needs --parity, which tells the frames that are right\n");
    return 2;
  }
  if (strcmp(verb, "send") == 0) return !send_stream(&options);
  if (strcmp(verb, "channel") == 0) return !damage_stream(&options);
  if (strcmp(verb, "receive") == 0) return !receive_stream(&options);
  return usage();
}
