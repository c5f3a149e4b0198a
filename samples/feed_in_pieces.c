/* feed_in_pieces STREAM BYTES [PICTURES.yuv]: decodes a stream that arrives in pieces of BYTES bytes, as from
 * a network, continues after damage, and prints the number of pictures and their checksum. Writes them as raw
 * planes if a file is named. Needs libfbs. */
#include <fbs/fbs.h>
#include <stdio.h>
#include <stdlib.h>

typedef struct {
  uint64_t pictures, held, errors;
  uint32_t checksum; /* FNV-1a over all samples */
  fbs_status first_error;
} summary;

static int take_picture(fbs_decoder* decoder, summary* sum, FILE* out) {
  fbs_const_picture picture;
  if (fbs_decoder_get_picture(decoder, &picture) != FBS_OK) return 0;
  for (int plane = 0; plane < 3; ++plane) {
    const size_t width = plane == 0 ? picture.width : (picture.width + 1) / 2;
    const size_t height = plane == 0 ? picture.height : (picture.height + 1) / 2;
    for (size_t y = 0; y < height; ++y) {
      const uint8_t* const row = picture.data[plane] + (ptrdiff_t)y * picture.stride[plane];
      for (size_t x = 0; x < width; ++x) sum->checksum = (sum->checksum ^ row[x]) * 16777619u;
      if (out != NULL && fwrite(row, 1, width, out) != width) return 0;
    }
  }
  return 1;
}

/* Returns 0 when a picture cannot be decoded or written. */
static int decode(fbs_decoder* decoder, FILE* file, uint8_t* piece, size_t piece_size, FILE* out,
                  summary* sum) {
  for (;;) {
    fbs_picture_info info;
    const fbs_status status = fbs_decoder_next(decoder, &info);
    if (status == FBS_END) return 1;
    if (status == FBS_NEED_DATA) {
      const size_t size = fread(piece, 1, piece_size, file);
      if (size > 0)
        fbs_decoder_feed(decoder, piece, size);
      else
        fbs_decoder_finish(decoder);
    } else if (status == FBS_OK) {
      ++sum->pictures;
      sum->held += info.held != 0;
      if (!take_picture(decoder, sum, out)) return 0;
    } else {
      if (sum->errors++ == 0) sum->first_error = status;
      fprintf(stderr, "byte %llu: %s\n", (unsigned long long)fbs_decoder_error_offset(decoder),
              fbs_decoder_error(decoder));
    }
  }
}

int main(int argc, char** argv) {
  const size_t piece_size = argc < 3 ? 0 : strtoul(argv[2], NULL, 10);
  if (piece_size == 0) return fprintf(stderr, "usage: feed_in_pieces STREAM BYTES [PICTURES.yuv]\n"), 2;
  FILE* const file = fopen(argv[1], "rb");
  if (file == NULL) return perror(argv[1]), 1;
  FILE* const out = argc > 3 ? fopen(argv[3], "wb") : NULL;
  if (argc > 3 && out == NULL) return perror(argv[3]), 1;
  uint8_t* const piece = malloc(piece_size);
  fbs_decoder* decoder = NULL;
  if (piece == NULL || fbs_decoder_open(&decoder, NULL) != FBS_OK) return 1;

  summary sum = {0, 0, 0, 2166136261u, FBS_OK};
  int complete = decode(decoder, file, piece, piece_size, out, &sum);
  if (out != NULL && fclose(out) != 0) complete = 0;
  fbs_decoder_close(&decoder);
  free(piece);
  fclose(file);
  printf("%llu pictures, %llu of them held, checksum %08lx, %llu errors, the first: %s\n",
         (unsigned long long)sum.pictures, (unsigned long long)sum.held, (unsigned long)sum.checksum,
         (unsigned long long)sum.errors, fbs_status_text(sum.first_error));
  return complete ? 0 : 1;
}
