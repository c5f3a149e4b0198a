// print_landmarks STREAM: prints head pose and the 68 iBUG landmarks of each picture. Nothing is drawn, so it
// is much faster than decoding to pictures. Needs only the decoder library.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "decoder/scene_face.h"
#include "decoder/stream_decoder.h"

namespace {

constexpr double kDegrees = 360.0 / 65536;  // the stream counts angles in 2^-16 turns
constexpr double kPixels = 1.0 / 64;        // and positions in 1/64 pixel

void print(const fbs::StreamDecoder& decoder) {
  const auto* face = face_of(decoder.scene());
  if (face == nullptr) {
    std::printf("picture %d: no face\n", static_cast<int>(decoder.pictures()));
    return;
  }
  const fbs::HeadPose pose = fbs::head_pose(decoder.state());
  std::printf("picture %d: pitch %.1f yaw %.1f roll %.1f\n", static_cast<int>(decoder.pictures()),
              pose.pitch * kDegrees, pose.yaw * kDegrees, pose.roll * kDegrees);
  const auto vertices = face->project_vertices(decoder.state());  // all 105 of the head, z being depth
  for (const auto vertex : fbs::generic_head().landmark_vertex)
    std::printf("%.2f %.2f\n", vertices[vertex].x * kPixels, vertices[vertex].y * kPixels);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: print_landmarks STREAM\n"), 2;
  std::ifstream file(argv[1], std::ios::binary);
  const std::vector<char> bytes(std::istreambuf_iterator<char>(file), {});
  fbs::StreamDecoder decoder;
  decoder.feed({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  decoder.close();
  for (;;) {
    const auto status = decoder.next();
    if (!status) return std::fprintf(stderr, "%s: %s\n", argv[1], status.error().text.c_str()), 1;
    if (*status == fbs::DecodeStatus::kEnd) return 0;
    print(decoder);  // instead of decoder.render(picture)
  }
}
