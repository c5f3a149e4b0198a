#include "cli/matroska/matroska_reader.h"

#include <webm/buffer_reader.h>
#include <webm/callback.h>
#include <webm/status.h>
#include <webm/webm_parser.h>

#include <algorithm>
#include <exception>
#include <optional>
#include <string_view>
#include <utility>

#include "bitstream/sound_syntax.h"
#include "decoder/sound/opus_packet.h"

namespace fbs::cli {
namespace {

using webm::Status;

constexpr std::string_view kOpusHead = "OpusHead";
constexpr std::size_t kOpusHeadBytes = 19;
constexpr int kStop = 1;  // returned by the callback in place of one of libwebm's codes

/// Collects the blocks of two tracks.
class Collector final : public webm::Callback {
 public:
  explicit Collector(std::uint64_t size) : size_(size) {}

  /// Rejects before allocating what the file cannot contain.
  Status OnElementBegin(const webm::ElementMetadata& element, webm::Action* action) override {
    *action = webm::Action::kRead;
    if (element.size == webm::kUnknownElementSize) return go_on();
    const std::uint64_t begin = element.position + element.header_size;
    if (begin > size_ || element.size > size_ - begin) return stop(ErrorCode::kTruncated, "is cut off");
    return go_on();
  }

  Status OnInfo(const webm::ElementMetadata& /*element*/, const webm::Info& info) override {
    scale_ = info.timecode_scale.value();
    if (scale_ == 0 || scale_ > kMaxScale)
      return stop(ErrorCode::kInvalidStream, "has an impossible unit of time");
    return go_on();
  }

  Status OnTrackEntry(const webm::ElementMetadata& /*element*/, const webm::TrackEntry& track) override {
    const std::string& codec = track.codec_id.value();
    const bool video = codec == "V_FBS", first = video ? !video_ : !sound_;
    if ((!video && codec != "A_OPUS") || !first) {
      out_.left_out.push_back(codec);
      return go_on();
    }
    if (track.content_encodings.is_present())
      return stop(ErrorCode::kUnsupported, "its tracks are compressed or encrypted");
    return video ? take_video(track) : take_sound(track);
  }

  Status OnClusterBegin(const webm::ElementMetadata& /*element*/, const webm::Cluster& cluster,
                        webm::Action* action) override {
    *action = webm::Action::kRead;
    cluster_ = cluster.timecode.value();
    if (cluster_ > static_cast<std::uint64_t>(kMaxMatroskaTime) / scale_)
      return stop(ErrorCode::kInvalidStream, "has an impossible time");
    return go_on();
  }

  Status OnSimpleBlockBegin(const webm::ElementMetadata& /*element*/, const webm::SimpleBlock& block,
                            webm::Action* action) override {
    return begin(block, action);
  }

  Status OnBlockBegin(const webm::ElementMetadata& /*element*/, const webm::Block& block,
                      webm::Action* action) override {
    return begin(block, action);
  }

  Status OnFrame(const webm::FrameMetadata& frame, webm::Reader* reader, std::uint64_t* left) override {
    if (blocks_ == nullptr) return webm::Callback::OnFrame(frame, reader, left);
    if (*left > size_) return stop(ErrorCode::kTruncated, "is cut off");
    blocks_->push_back({time_, 0, true, std::vector<std::uint8_t>(*left)});
    std::vector<std::uint8_t>& bytes = blocks_->back().bytes;
    for (std::size_t at = 0; *left > 0;) {
      std::uint64_t count = 0;
      const Status status = reader->Read(*left, bytes.data() + at, &count);
      at += count;
      *left -= count;
      if (*left > 0 && !status.ok()) return status;
    }
    if (sound_ && blocks_ == &out_.content.sound->blocks)
      time_ += frame_ns(bytes);  // of the next in the lace
    return go_on();
  }

  [[nodiscard]] const std::optional<Error>& error() const { return error_; }

  Result<ReadMatroska> finish() {
    if (!video_) return fail(ErrorCode::kUnsupported, "is a Matroska file without fbs video (V_FBS)");
    if (auto& sound = out_.content.sound; sound && !sound->blocks.empty())
      sound->duration = opus_duration(sound->blocks.front().bytes);
    return std::move(out_);
  }

 private:
  static constexpr std::uint64_t kMaxScale = 1'000'000'000;  // ns

  static Status go_on() { return Status(Status::kOkCompleted); }

  Status stop(ErrorCode code, std::string text) {
    if (!error_) error_ = Error{code, std::move(text)};
    return Status(kStop);
  }

  Status take_video(const webm::TrackEntry& track) {
    video_ = track.track_number.value();
    out_.content.video.setup = track.codec_private.value();
    return go_on();
  }

  Status take_sound(const webm::TrackEntry& track) {
    const std::vector<std::uint8_t>& head = track.codec_private.value();
    const bool right = head.size() >= kOpusHeadBytes &&
                       std::equal(kOpusHead.begin(), kOpusHead.end(), head.begin()) && head[8] < 16 &&
                       head[18] == 0;
    if (!right) {
      out_.left_out.push_back(track.codec_id.value());
      return go_on();
    }
    sound_ = track.track_number.value();
    MatroskaSound& sound = out_.content.sound.emplace();
    sound.channels = head[9];
    sound.skip = head[10] + 256 * head[11];
    const std::uint64_t frame = std::min<std::uint64_t>(track.default_duration.value(), kMaxScale);
    sound.duration = static_cast<std::int32_t>((frame * 6 + 62'500) / 125'000);
    return go_on();
  }

  Status begin(const webm::Block& block, webm::Action* action) {
    *action = webm::Action::kRead;
    blocks_ = nullptr;
    if (video_ == block.track_number) blocks_ = &out_.content.video.blocks;
    if (sound_ == block.track_number) blocks_ = &out_.content.sound->blocks;
    const auto scale = static_cast<std::int64_t>(scale_);
    time_ = static_cast<std::int64_t>(cluster_) * scale + block.timecode * scale;
    return go_on();
  }

  static std::int64_t frame_ns(std::span<const std::uint8_t> packet) {
    return std::int64_t{opus_duration(packet)} * 125'000 / 6;
  }

  std::uint64_t size_;                          // of the file
  std::uint64_t scale_ = 1'000'000;             // ns
  std::uint64_t cluster_ = 0;                   // its time, in scale_
  std::int64_t time_ = 0;                       // of the next frame, ns
  std::optional<std::uint64_t> video_, sound_;  // numbers of the tracks
  std::vector<MatroskaBlock>* blocks_ = nullptr;
  std::optional<Error> error_;
  ReadMatroska out_;
};

}  // namespace

Result<ReadMatroska> read_matroska(std::span<const std::uint8_t> file) {
  try {
    webm::BufferReader reader(std::vector<std::uint8_t>(file.begin(), file.end()));
    webm::WebmParser parser;
    Collector collector(file.size());
    const Status status = parser.Feed(&collector, &reader);
    if (collector.error()) return fail(*collector.error());
    if (status.code == Status::kEndOfFile) return fail(ErrorCode::kTruncated, "is cut off");
    if (!status.completed_ok())
      return fail(ErrorCode::kInvalidStream,
                  "is a damaged Matroska file (near byte " + std::to_string(reader.Position()) + ")");
    return collector.finish();
  } catch (const std::exception& problem) {
    return fail(ErrorCode::kInvalidStream, std::string("cannot be read as Matroska: ") + problem.what());
  }
}

}  // namespace fbs::cli
