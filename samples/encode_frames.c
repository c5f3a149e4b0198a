/* encode_frames WIDTH HEIGHT RATE OUT.fbs: encodes pictures in memory. Here they are read from standard
 * input, as raw planes; a camera or another decoder would do as well:
 *
 *     ffmpeg -i talk.mkv -f rawvideo -pix_fmt yuv420p - | encode_frames 352 288 25 talk.fbs
 *
 * Needs libfbs_encoder. */
#include <fbs/encoder.h>
#include <stdio.h>
#include <stdlib.h>

/* Writes the packets that are ready. Often there are none: pictures are collected before they are coded. */
static fbs_status write_packets(fbs_encoder* encoder, FILE* out) {
  fbs_packet packet;
  fbs_status status = FBS_OK;
  while ((status = fbs_encoder_pull(encoder, &packet)) == FBS_OK)
    if (fwrite(packet.data, 1, packet.size, out) != packet.size) return FBS_ERROR_IO;
  return status;
}

static fbs_status encode(fbs_encoder* encoder, const fbs_format* format, uint8_t* samples, FILE* out) {
  const ptrdiff_t width = format->width, chroma_width = (width + 1) / 2;
  const size_t luma = (size_t)format->width * format->height;
  const size_t chroma = (size_t)chroma_width * ((format->height + 1) / 2);
  const fbs_const_picture picture = {format->width,
                                     format->height,
                                     {samples, samples + luma, samples + luma + chroma},
                                     {width, chroma_width, chroma_width}};
  fbs_status status = FBS_NEED_DATA;
  while (status == FBS_NEED_DATA) {
    const size_t size = luma + 2 * chroma;
    const int more = fread(samples, 1, size, stdin) == size;
    status = more ? fbs_encoder_push(encoder, &picture, 0) : fbs_encoder_finish(encoder);
    if (status == FBS_OK) status = write_packets(encoder, out);
  }
  return status;
}

int main(int argc, char** argv) {
  if (argc != 5) return fprintf(stderr, "usage: encode_frames WIDTH HEIGHT RATE OUT.fbs < PICTURES.yuv\n"), 2;
  fbs_encoder_settings settings;
  fbs_encoder_default_settings(&settings, sizeof settings);
  settings.format.width = (uint32_t)strtoul(argv[1], NULL, 10);
  settings.format.height = (uint32_t)strtoul(argv[2], NULL, 10);
  settings.format.frame_rate_num = (uint32_t)strtoul(argv[3], NULL, 10);
  settings.quality = 60; /* or settings.bitrate, in kbit/s */
  char why[FBS_ERROR_SIZE];
  settings.open_error = why;
  fbs_encoder* encoder = NULL;
  if (fbs_encoder_open(&encoder, &settings) != FBS_OK) return fprintf(stderr, "encode_frames: %s\n", why), 2;

  FILE* const out = fopen(argv[4], "wb");
  if (out == NULL) return perror(argv[4]), 1;
  uint8_t* const samples = malloc((size_t)2 * (settings.format.width + 1) * (settings.format.height + 1));
  if (samples == NULL) return 1;
  const fbs_status status = encode(encoder, &settings.format, samples, out);
  if (status != FBS_END) fprintf(stderr, "%s: %s\n", fbs_status_text(status), fbs_encoder_error(encoder));
  fbs_encoder_close(&encoder);
  free(samples);
  return fclose(out) == 0 && status == FBS_END ? 0 : 1;
}
