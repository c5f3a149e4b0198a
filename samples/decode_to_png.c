/* decode_to_png STREAM FOLDER: decodes a stream and writes each picture to FOLDER as a PNG file.
 * Needs libfbs, and stb to write PNG. */
#include <fbs/fbs.h>
#include <stb_image_write.h>
#include <stdio.h>
#include <stdlib.h>

static uint8_t sample(double v) {
  return v < 0 ? 0 : v > 255 ? 255 : (uint8_t)(v + 0.5);
}

/* Three bytes per pixel: red, green, blue. The format says which YCbCr the video has. */
static void to_rgb(const fbs_const_picture* picture, const fbs_format* format, uint8_t* rgb) {
  const int bt709 = format->matrix == FBS_MATRIX_BT709;
  const double kr = bt709 ? 0.2126 : 0.299, kb = bt709 ? 0.0722 : 0.114, kg = 1 - kr - kb;
  const double black = format->full_range ? 0 : 16;
  const double luma_gain = format->full_range ? 1 : 255.0 / 219;
  const double chroma_gain = format->full_range ? 1 : 255.0 / 224;
  for (ptrdiff_t y = 0; y < (ptrdiff_t)picture->height; ++y) {
    const uint8_t* const row = picture->data[0] + y * picture->stride[0];
    const uint8_t* const cb_row = picture->data[1] + y / 2 * picture->stride[1]; /* one for 2 x 2 pixels */
    const uint8_t* const cr_row = picture->data[2] + y / 2 * picture->stride[2];
    for (uint32_t x = 0; x < picture->width; ++x) {
      const double luma = (row[x] - black) * luma_gain;
      const double cb = (cb_row[x / 2] - 128) * chroma_gain, cr = (cr_row[x / 2] - 128) * chroma_gain;
      const double red = luma + 2 * (1 - kr) * cr, blue = luma + 2 * (1 - kb) * cb;
      *rgb++ = sample(red);
      *rgb++ = sample((luma - kr * red - kb * blue) / kg);
      *rgb++ = sample(blue);
    }
  }
}

static int write_png(fbs_decoder* decoder, const char* folder, uint64_t number) {
  fbs_const_picture picture;
  fbs_format format;
  if (fbs_decoder_get_picture(decoder, &picture) != FBS_OK ||
      fbs_decoder_get_format(decoder, &format) != FBS_OK)
    return 0;
  const int width = (int)picture.width, height = (int)picture.height;
  uint8_t* const rgb = malloc((size_t)3 * picture.width * picture.height);
  if (rgb == NULL) return 0;
  to_rgb(&picture, &format, rgb);
  char name[4096];
  snprintf(name, sizeof name, "%s/%llu.png", folder, (unsigned long long)number);
  const int written = stbi_write_png(name, width, height, 3, rgb, 3 * width);
  free(rgb);
  return written;
}

static int decode(FILE* file, const char* folder) {
  fbs_decoder* decoder = NULL;
  if (fbs_decoder_open(&decoder, NULL) != FBS_OK) return 1;
  uint64_t pictures = 0;
  fbs_status status = FBS_NEED_DATA;
  while (status >= 0 && status != FBS_END) {
    status = fbs_decoder_next(decoder, NULL);
    if (status == FBS_NEED_DATA) {
      uint8_t bytes[4096];
      const size_t size = fread(bytes, 1, sizeof bytes, file);
      status = size > 0 ? fbs_decoder_feed(decoder, bytes, size) : fbs_decoder_finish(decoder);
    } else if (status == FBS_OK && !write_png(decoder, folder, ++pictures)) {
      fprintf(stderr, "%s: cannot write\n", folder);
      break;
    }
  }
  if (status < 0) fprintf(stderr, "%s\n", fbs_decoder_error(decoder));
  fbs_decoder_close(&decoder);
  return status == FBS_END ? 0 : 1;
}

int main(int argc, char** argv) {
  if (argc != 3) return fprintf(stderr, "usage: decode_to_png STREAM FOLDER\n"), 2;
  FILE* const file = fopen(argv[1], "rb");
  if (file == NULL) return perror(argv[1]), 1;
  const int failed = decode(file, argv[2]);
  fclose(file);
  return failed;
}
