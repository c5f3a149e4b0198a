/* print_landmarks STREAM: prints head pose and the 68 iBUG landmarks of each picture. Nothing is drawn, so it
 * is much faster than decoding pictures. Needs libfbs. */
#include <fbs/fbs.h>
#include <stdio.h>

static void print(const fbs_decoder* decoder, uint64_t number) {
  fbs_face_state face;
  fbs_landmark landmarks[FBS_LANDMARKS];
  printf("picture %llu: ", (unsigned long long)number);
  if (fbs_decoder_get_state(decoder, &face) != FBS_OK ||
      fbs_decoder_get_landmarks(decoder, landmarks) != FBS_OK) {
    printf("no face\n");
    return;
  }
  printf("pitch %.1f yaw %.1f roll %.1f\n", face.pitch, face.yaw, face.roll);
  for (int k = 0; k < FBS_LANDMARKS; ++k)
    printf("%.2f %.2f %.2f\n", landmarks[k].x, landmarks[k].y, landmarks[k].confidence);
}

int main(int argc, char** argv) {
  if (argc != 2) return fprintf(stderr, "usage: print_landmarks STREAM\n"), 2;
  FILE* const file = fopen(argv[1], "rb");
  if (file == NULL) return perror(argv[1]), 1;
  fbs_decoder* decoder = NULL;
  if (fbs_decoder_open(&decoder, NULL) != FBS_OK) return 1;

  fbs_picture_info picture;
  fbs_status status = FBS_NEED_DATA;
  while (status >= 0 && status != FBS_END) {
    status = fbs_decoder_next(decoder, &picture);
    if (status == FBS_NEED_DATA) {
      uint8_t bytes[4096];
      const size_t size = fread(bytes, 1, sizeof bytes, file);
      status = size > 0 ? fbs_decoder_feed(decoder, bytes, size) : fbs_decoder_finish(decoder);
    } else if (status == FBS_OK) {
      print(decoder, picture.number);
    }
  }
  if (status < 0) fprintf(stderr, "%s\n", fbs_decoder_error(decoder));
  fbs_decoder_close(&decoder);
  fclose(file);
  return status == FBS_END ? 0 : 1;
}
