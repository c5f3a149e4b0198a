/* lossy_call WIDTH HEIGHT RATE [LOSS [SEED [THREADS]]] < PICTURES.yuv: both ends of a call, and a link
 * between them that delays packets, changes their order, loses LOSS percent (default 5), and has a quarter of
 * its rate from 8 s on. Time is simulated, so a run can be repeated exactly. Prints a line for each second.
 *
 *     ffmpeg -i talk.mkv -f rawvideo -pix_fmt yuv420p - | lossy_call 352 288 25
 *
 * Needs libfbs_encoder. docs/library.md walks through it. */
#include <fbs/encoder.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { SECOND = FBS_TICKS_PER_SECOND, MS = SECOND / 1000 };
static int64_t now; /* all times are in ticks */

/* What is counted: bytes on the link, packets, requests, pictures. */
enum { BYTES, LOST, RESENT, SCENES, SHOWN, LATE, FLAWED, COUNTERS };
static uint32_t second[COUNTERS], all[COUNTERS];

/* ---- the link: a queue, then a way that takes its time ---- */

enum { WIDE = 24, NARROW = 6 /* kbit/s */, QUEUE = 1 * SECOND, HEADERS = 28 /* bytes of IP and UDP */ };
enum { DELAY = 40 * MS, JITTER = 60 * MS, DETOUR = 250 * MS /* of one packet in 20 */ };
enum {
  LARGEST = 16384 /* bytes of a packet */,
  MTU = 1200 /* of a piece of it */,
  MOST = 256 /* on their way */
};

typedef struct {
  uint32_t kbps, loss, random;
  int64_t idle; /* when the queue will be empty */
  struct flight {
    int64_t arrives;
    size_t size; /* 0: none */
    uint8_t bytes[LARGEST];
  } flights[MOST];
} link;
static link there, back;

static uint32_t chance(uint32_t* random, uint32_t below) {
  *random = *random * 1664525u + 1013904223u;
  return (uint32_t)((uint64_t)*random * below >> 32);
}

/* Returns 0 if the packet is lost. */
static int link_send(link* l, const void* bytes, size_t size) {
  if (l->idle > now + QUEUE) return 0;
  l->idle = (l->idle > now ? l->idle : now) + (int64_t)(size + HEADERS) * 8 * MS / l->kbps;
  for (size_t sent = 0; sent < size; sent += MTU)
    if (chance(&l->random, 100) < l->loss) return 0;
  struct flight* f = l->flights;
  while (f->size > 0)
    if (++f == l->flights + MOST) return 0;
  f->arrives = l->idle + DELAY + chance(&l->random, JITTER) + (chance(&l->random, 20) == 0 ? DETOUR : 0);
  f->size = size;
  memcpy(f->bytes, bytes, size);
  return 1;
}

/* Takes one packet that has arrived. Returns 0 if there is none. */
static int link_receive(link* l, void* bytes) {
  struct flight* first = NULL;
  for (struct flight* f = l->flights; f < l->flights + MOST; ++f)
    if (f->size > 0 && f->arrives <= now && (first == NULL || f->arrives < first->arrives)) first = f;
  if (first == NULL) return 0;
  memcpy(bytes, first->bytes, first->size);
  first->size = 0;
  return 1;
}

/* ---- what the ends send each other; machines of different kinds need a byte order, too ---- */

typedef struct {
  uint32_t number;     /* the same when it is sent again */
  uint32_t oldest;     /* number that can still be sent again */
  uint32_t count;      /* of all that was sent: gaps are what the link has lost */
  uint32_t size;       /* of `bytes` */
  int64_t sent, begin; /* by the sender's clock: now, and at time 0 of the stream */
  uint8_t bytes[LARGEST - 32];
} packet;

typedef struct {
  int needs_scene, lacks_pattern;
  float queue;          /* s that packets have waited lately */
  uint32_t measured;    /* how often the next two have been */
  float kbps, loss;     /* received; share of packets */
  uint32_t count;       /* of those missing */
  uint64_t missing[16]; /* to be sent again */
} report;

/* ---- the sender ---- */

enum { KEPT = 16 /* packets, some 3 s */, ROUND_TRIP = 200 * MS, SLOWEST = 3, FASTEST = 24 /* kbit/s */ };

static struct {
  fbs_encoder* encoder;
  packet kept[KEPT];
  uint32_t number, count; /* of the packet that is being filled; of those sent */
  int64_t begin, asked;   /* as in a packet; when a scene was asked for */
  uint32_t measured;      /* of the last report */
  double kbps, loss;      /* of the encoder; mean of those reported */
} anna;

static void send_packet(packet* p) {
  const size_t size = offsetof(packet, bytes) + p->size;
  p->oldest = anna.number < KEPT ? 0 : anna.number - KEPT + 1;
  p->count = ++anna.count;
  p->sent = now;
  p->begin = anna.begin;
  second[BYTES] += (uint32_t)size + HEADERS;
  second[LOST] += !link_send(&there, p, size);
}

/* A packet of the link has a group: what makes pictures that can be shown. */
static void send_coded(void) {
  fbs_packet coded;
  while (fbs_encoder_wait(anna.encoder, 60000) == FBS_OK &&
         fbs_encoder_pull(anna.encoder, &coded) == FBS_OK) {
    packet* const p = &anna.kept[anna.number % KEPT];
    if (p->number != anna.number) p->size = 0;
    p->number = anna.number;
    fbs_stamp stamp = {sizeof stamp, 0, 0, 0};
    if (fbs_encoder_get_stamp(anna.encoder, &stamp) == FBS_OK) anna.begin = stamp.time - (int64_t)coded.time;
    if (p->size + coded.size > sizeof p->bytes) continue; /* as good as lost */
    memcpy(p->bytes + p->size, coded.data, coded.size);
    p->size += (uint32_t)coded.size;
    if (coded.pictures == 0 && coded.type != FBS_PACKET_END) continue;
    ++anna.number;
    send_packet(p);
  }
}

/* A queue means that more is sent than the link carries. Losses are repaired, unless there are many. A rate
 * that is not used says nothing about the link, and does not grow. */
static void adapt(const report* r) {
  anna.measured = r->measured;
  anna.loss += 0.15 * (r->loss - anna.loss);
  if (r->queue > 0.15)
    anna.kbps = 0.75 * (r->kbps < anna.kbps ? r->kbps : anna.kbps);
  else if (anna.loss > 0.25)
    anna.kbps *= 0.95;
  else if (r->kbps > 0.7 * anna.kbps)
    anna.kbps *= 1.025;
  anna.kbps = anna.kbps < SLOWEST ? SLOWEST : anna.kbps > FASTEST ? FASTEST : anna.kbps;
  fbs_encoder_set_bitrate(anna.encoder, anna.kbps);
}

static void take_report(const report* r) {
  for (uint32_t k = 0; k < r->count; ++k) {
    packet* const p = &anna.kept[r->missing[k] % KEPT];
    if (p->number != r->missing[k]) continue;                             /* no longer kept */
    const double takes = p->size * 8 / (1000 * anna.kbps) + r->queue;     /* s */
    if (now < p->sent + ROUND_TRIP + (int64_t)(takes * SECOND)) continue; /* on its way */
    send_packet(p);
    ++second[RESENT];
  }
  if (r->needs_scene && now > anna.asked + SECOND) { /* until then, one may be on its way */
    fbs_encoder_request_scene(anna.encoder);
    anna.asked = now;
    ++second[SCENES];
  } else if (r->lacks_pattern) {
    fbs_encoder_lose_patterns(anna.encoder);
  }
  if (r->measured > anna.measured) adapt(r);
}

/* ---- the receiver ---- */

enum {
  WAIT = 700 * MS /* a group, 0.2 s, and what is sent again */,
  CATCH_UP = 2 * MS,
  REPORT = 20 * MS,
  MEASURE = SECOND / 2
};

static struct {
  fbs_decoder* decoder;
  fbs_picture_info picture;  /* decoded last */
  int waiting;               /* 1: it is to be shown */
  int64_t begin;             /* packet.begin */
  int64_t way, more, queue;  /* time of the fastest packet; what the last one took more, and both of two */
  int64_t wait;              /* of pictures, beyond `way` */
  uint32_t highest, noticed; /* packet.number; the same at the last report */
  uint32_t count, counted;   /* packet.count; the same at the last second */
  uint32_t packets, bytes;   /* in this second */
  report report;
} bert;

/* The clocks of the ends may differ by anything: `way` has the difference in it. */
static void take_packet(const packet* p) {
  fbs_decoder_feed_packet(bert.decoder, p->number, p->bytes, p->size);
  fbs_decoder_packets_lost(bert.decoder, p->oldest);
  if (now - p->sent < bert.way) bert.way = now - p->sent;
  const int64_t more = now - p->sent - bert.way;
  bert.queue = more < bert.more ? more : bert.more; /* one alone has taken a detour */
  bert.more = more;
  bert.begin = p->begin;
  if (p->number > bert.highest) bert.highest = p->number;
  if (p->count > bert.count) bert.count = p->count;
  bert.bytes += p->size;
  ++bert.packets;
}

static int64_t time_due(void) {
  return now - bert.begin - bert.way - bert.wait;
}

/* Goes on to the next picture. Returns 0 if it cannot be decoded yet. */
static int decode(void) {
  const int64_t next = (int64_t)bert.picture.time + bert.picture.duration; /* 0 before the first picture */
  fbs_status status;
  while ((status = fbs_decoder_next(bert.decoder, &bert.picture)) != FBS_OK) {
    if (status < 0) fprintf(stderr, "lossy_call: %s\n", fbs_decoder_error(bert.decoder));
    if (status == FBS_END) return 0;
    if (status == FBS_NEED_DATA && (next == 0 || time_due() < next)) return 0;
    if (status == FBS_NEED_DATA && fbs_decoder_skip_missing(bert.decoder) != FBS_OK) return 0;
  }
  return 1;
}

static void show(void) {
  fbs_const_picture picture;
  while (bert.waiting || decode()) {
    const int64_t late = time_due() - (int64_t)bert.picture.time;
    bert.waiting = late < 0;
    if (bert.waiting) return;
    if (late > bert.picture.duration) {
      bert.wait += late; /* others would be late, too */
      ++second[LATE];
    } else if (bert.wait > WAIT) {
      bert.wait -= CATCH_UP;
    }
    second[FLAWED] += bert.picture.quality != FBS_QUALITY_EXACT;
    second[SHOWN] += fbs_decoder_get_picture(bert.decoder, &picture) == FBS_OK; /* to the screen */
  }
}

static void measure(report* r) {
  const uint32_t sent = bert.count - bert.counted;
  ++r->measured;
  r->kbps = (float)bert.bytes * 8 * SECOND / MEASURE / 1000;
  r->loss = sent > bert.packets ? 1 - (float)bert.packets / (float)sent : 0;
  bert.counted = bert.count;
  bert.packets = bert.bytes = 0;
}

/* Asks for what was missing at the last report already: the rest may only be late. */
static void send_report(report* r) {
  size_t count = 0;
  fbs_decoder_get_missing(bert.decoder, r->missing, 16, &count);
  r->lacks_pattern = count == 0 && bert.picture.quality == FBS_QUALITY_PATTERN_MISSING;
  r->needs_scene = fbs_decoder_needs_scene(bert.decoder);
  while (count > 0 && r->missing[count - 1] > bert.noticed) --count;
  bert.noticed = bert.highest;
  r->count = (uint32_t)count;
  r->queue = (float)bert.queue / SECOND;
  if (now % MEASURE == 0) measure(r);
  if (now % MEASURE == 0 || count > 0 || r->needs_scene || r->lacks_pattern)
    link_send(&back, r, offsetof(report, missing) + count * sizeof r->missing[0]);
}

/* ---- the call ---- */

static int fail(const char* text) {
  fprintf(stderr, "lossy_call: %s\n", text);
  return 1;
}

static void print(const char* name, const uint32_t* n, double seconds) {
  const int64_t delay = bert.picture.duration > 0 ? bert.way + bert.wait : 0;
  printf("%3s %5u %6.1f %6.1f %5u %7u %7u %6u %5u %7u %6d\n", name, there.kbps, anna.kbps,
         n[BYTES] * .008 / seconds, n[LOST], n[RESENT], n[SCENES], n[SHOWN], n[LATE], n[FLAWED],
         (int)(delay / MS));
}

static void end_second(void) {
  char name[24];
  snprintf(name, sizeof name, "%d", (int)(now / SECOND));
  print(name, second, 1);
  for (int k = 0; k < COUNTERS; ++k) all[k] += second[k];
  memset(second, 0, sizeof second);
}

static int run(const fbs_const_picture* picture, uint8_t* samples, size_t size, uint32_t rate) {
  static packet packet;
  report report;
  uint64_t pictures = 0;
  int64_t next = 0, end = INT64_MAX;
  puts("  s  link  coded   sent  lost  resent  scenes  shown  late  flawed  delay");
  for (; now < end; now += MS) {
    there.kbps = now < 8 * SECOND ? WIDE : NARROW;
    if (now >= next && end == INT64_MAX) { /* the camera */
      const fbs_stamp stamp = {sizeof stamp, next, pictures, 0};
      const int more = fread(samples, 1, size, stdin) == size;
      if ((more ? fbs_encoder_push_stamped(anna.encoder, picture, &stamp)
                : fbs_encoder_finish(anna.encoder)) != FBS_OK)
        return fail(fbs_encoder_error(anna.encoder));
      send_coded();
      next = (int64_t)++pictures * SECOND / rate;
      if (!more) end = (now / SECOND + 3) * SECOND + MS;
    }
    while (link_receive(&there, &packet)) take_packet(&packet);
    show();
    if (now > 0 && now % REPORT == 0) send_report(&bert.report);
    while (link_receive(&back, &report)) take_report(&report);
    if (now > 0 && now % SECOND == 0) end_second();
  }
  print("all", all, (double)now / SECOND);
  return 0;
}

int main(int argc, char** argv) {
  if (argc < 4) return fail("usage: lossy_call WIDTH HEIGHT RATE [LOSS [SEED [THREADS]]] < PICTURES.yuv");
  char why[FBS_ERROR_SIZE];
  fbs_encoder_settings settings;
  fbs_encoder_default_settings(&settings, sizeof settings);
  settings.format.width = (uint32_t)strtoul(argv[1], NULL, 10);
  settings.format.height = (uint32_t)strtoul(argv[2], NULL, 10);
  settings.format.frame_rate_num = (uint32_t)strtoul(argv[3], NULL, 10);
  settings.live = settings.allow_no_face = 1;
  settings.bitrate = anna.kbps = 16;
  settings.live_buffer = 0.5;                  /* no packet waits longer for the link */
  settings.key_interval = 600;                 /* nobody joins later, and scenes can be asked for */
  settings.resilience = FBS_RESILIENCE_PACKET; /* motion goes on while what is lost is sent again */
  settings.threads = argc > 6 ? atoi(argv[6]) : 1;
  settings.open_error = why;
  if (fbs_encoder_open(&anna.encoder, &settings) != FBS_OK) return fail(why);
  fbs_decoder_settings viewer;
  fbs_decoder_default_settings(&viewer, sizeof viewer);
  viewer.threads = settings.threads;
  viewer.open_error = why;
  if (fbs_decoder_open(&bert.decoder, &viewer) != FBS_OK) return fail(why);
  there.loss = back.loss = argc > 4 ? (uint32_t)strtoul(argv[4], NULL, 10) : 5;
  there.random = argc > 5 ? (uint32_t)strtoul(argv[5], NULL, 10) : 1;
  back.random = ~there.random;
  back.kbps = WIDE;
  bert.way = INT64_MAX / 2;
  bert.wait = WAIT;

  const ptrdiff_t width = settings.format.width, half = (width + 1) / 2;
  const size_t luma = (size_t)width * settings.format.height;
  const size_t chroma = (size_t)half * ((settings.format.height + 1) / 2);
  uint8_t* const samples = malloc(luma + 2 * chroma);
  if (samples == NULL) return fail("no memory");
  const fbs_const_picture picture = {settings.format.width,
                                     settings.format.height,
                                     {samples, samples + luma, samples + luma + chroma},
                                     {width, half, half}};
  const int status = run(&picture, samples, luma + 2 * chroma, settings.format.frame_rate_num);
  fbs_encoder_close(&anna.encoder);
  fbs_decoder_close(&bert.decoder);
  free(samples);
  return status;
}
