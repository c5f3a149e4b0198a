#include "cli/matroska/matroska_writer.h"

#include <ebml/EbmlHead.h>
#include <ebml/EbmlSubHead.h>
#include <ebml/EbmlVersion.h>
#include <ebml/EbmlVoid.h>
#include <matroska/KaxBlock.h>
#include <matroska/KaxBlockData.h>
#include <matroska/KaxCluster.h>
#include <matroska/KaxClusterData.h>
#include <matroska/KaxCues.h>
#include <matroska/KaxCuesData.h>
#include <matroska/KaxInfo.h>
#include <matroska/KaxInfoData.h>
#include <matroska/KaxSeekHead.h>
#include <matroska/KaxSegment.h>
#include <matroska/KaxTrackAudio.h>
#include <matroska/KaxTrackEntryData.h>
#include <matroska/KaxTrackVideo.h>
#include <matroska/KaxTracks.h>
#include <matroska/KaxVersion.h>

#include <algorithm>
#include <exception>
#include <iterator>
#include <span>

#include "bitstream/sound_time.h"
#include "cli/video/opus_head.h"

namespace fbs::cli {
namespace {

using namespace libmatroska;  // as its headers do
using libebml::AddNewChild;
using libebml::GetChild;

constexpr std::uint64_t kVideoTrack = 1, kSoundTrack = 2;
constexpr std::uint64_t kTypeVideo = 1, kTypeAudio = 2;
constexpr std::int64_t kClusterTicks = 30'000;
constexpr std::uint64_t kSeekHeadSpace = 100;
constexpr std::int64_t kSecond = 1'000'000'000;  // ns
constexpr int kSegmentSizeBytes = 8;

/// Output of libmatroska in memory.
class Memory final : public libebml::IOCallback {
 public:
  uint32 read(void* /*buffer*/, std::size_t /*size*/) override { return 0; }
  std::size_t write(const void* buffer, std::size_t size) override {
    if (at_ + size > bytes_.size()) bytes_.resize(at_ + size);
    std::copy_n(static_cast<const std::uint8_t*>(buffer), size,
                bytes_.begin() + static_cast<std::ptrdiff_t>(at_));
    at_ += size;
    return size;
  }
  void setFilePointer(int64 offset, libebml::seek_mode mode) override {
    const auto base = mode == libebml::seek_beginning ? 0 : mode == libebml::seek_end ? bytes_.size() : at_;
    at_ = base + static_cast<std::size_t>(offset);
  }
  uint64 getFilePointer() override { return at_; }
  void close() override {}

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

template <class Element>
void set(libebml::EbmlMaster& master, std::uint64_t value) {
  GetChild<Element>(master).SetValue(value);
}

std::int64_t ticks_of(std::int64_t ns) {
  return (ns + kMatroskaTick / 2) / kMatroskaTick;
}

/// A block and its track, in the order of the file.
struct Placed {
  std::int64_t tick;
  std::uint64_t track;
  const MatroskaBlock* block;
};

std::vector<Placed> in_order(const MatroskaContent& content) {
  std::vector<Placed> video, sound, all;
  for (const MatroskaBlock& b : content.video.blocks) video.push_back({ticks_of(b.time), kVideoTrack, &b});
  if (content.sound)
    for (const MatroskaBlock& b : content.sound->blocks) sound.push_back({ticks_of(b.time), kSoundTrack, &b});
  std::ranges::merge(video, sound, std::back_inserter(all), {}, &Placed::tick, &Placed::tick);
  return all;
}

/// ns
std::int64_t delay_of(const MatroskaSound& sound) {
  return (kSecond * sound.skip + kSoundClock / 2) / kSoundClock;
}

class Writer {
 public:
  Writer(const MatroskaContent& content, const std::string& application)
      : content_(content), application_(application) {}

  std::vector<std::uint8_t> write() {
    write_head();
    segment_.WriteHead(out_, kSegmentSizeBytes);
    libebml::EbmlVoid space;
    space.SetSize(kSeekHeadSpace);
    space.Render(out_);
    write_info();
    write_tracks();
    write_clusters();
    if (cues_.ListSize() > 0) {
      cues_.Render(out_);
      seek_head_.IndexThis(cues_, segment_);
    }
    const std::uint64_t end = out_.getFilePointer();
    space.ReplaceWith(seek_head_, out_, true);
    segment_.ForceSize(end - segment_.GetDataStart());
    segment_.OverwriteHead(out_);
    return out_.take();
  }

 private:
  void write_head() {
    libebml::EbmlHead head;
    GetChild<libebml::EDocType>(head).SetValue("matroska");
    set<libebml::EDocTypeVersion>(head, 4);
    set<libebml::EDocTypeReadVersion>(head, 2);
    head.Render(out_, true);
  }

  void write_info() {
    auto& info = GetChild<KaxInfo>(segment_);
    set<KaxTimecodeScale>(info, kMatroskaTick);
    std::int64_t end = 0;
    for (const Placed& p : in_order(content_)) {
      const std::int64_t delay = p.track == kSoundTrack ? delay_of(*content_.sound) : 0;
      end = std::max(end, p.block->time + p.block->duration - delay);
    }
    GetChild<KaxDuration>(info).SetValue(static_cast<double>(end) / kMatroskaTick);
    GetChild<KaxMuxingApp>(info).SetValueUTF8("libebml " + libebml::EbmlCodeVersion + ", libmatroska " +
                                              KaxCodeVersion);
    GetChild<KaxWritingApp>(info).SetValueUTF8(application_);
    info.Render(out_);
    seek_head_.IndexThis(info, segment_);
  }

  static KaxTrackEntry& add_track(KaxTracks& tracks, std::uint64_t number, std::uint64_t type,
                                  const char* codec, std::span<const std::uint8_t> setup) {
    auto& track = AddNewChild<KaxTrackEntry>(tracks);
    track.SetGlobalTimecodeScale(kMatroskaTick);
    set<KaxTrackNumber>(track, number);
    set<KaxTrackUID>(track, number);
    set<KaxTrackType>(track, type);
    set<KaxTrackFlagLacing>(track, 0);
    GetChild<KaxTrackLanguage>(track).SetValue("und");
    GetChild<KaxCodecID>(track).SetValue(codec);
    GetChild<KaxCodecPrivate>(track).CopyBuffer(setup.data(), static_cast<uint32>(setup.size()));
    return track;
  }

  void write_tracks() {
    auto& tracks = GetChild<KaxTracks>(segment_);
    tracks.RemoveAll();
    const MatroskaVideo& v = content_.video;
    video_ = &add_track(tracks, kVideoTrack, kTypeVideo, "V_FBS", v.setup);
    if (v.picture_duration > 0) set<KaxTrackDefaultDuration>(*video_, v.picture_duration);
    auto& picture = GetChild<KaxTrackVideo>(*video_);
    set<KaxVideoPixelWidth>(picture, v.width);
    set<KaxVideoPixelHeight>(picture, v.height);
    set<KaxVideoDisplayWidth>(picture, v.display_width);
    set<KaxVideoDisplayHeight>(picture, v.height);
    if (content_.sound) add_sound_track(tracks, *content_.sound);
    tracks.Render(out_);
    seek_head_.IndexThis(tracks, segment_);
  }

  void add_sound_track(KaxTracks& tracks, const MatroskaSound& s) {
    sound_ = &add_track(tracks, kSoundTrack, kTypeAudio, "A_OPUS", opus_head(s.channels, s.skip));
    set<KaxTrackDefaultDuration>(*sound_, kSecond / 1000 * s.duration / (kSoundClock / 1000));
    set<KaxCodecDelay>(*sound_, delay_of(s));
    set<KaxSeekPreRoll>(*sound_, kSecond / 1000 * kSoundPreroll / (kSoundClock / 1000));
    auto& samples = GetChild<KaxTrackAudio>(*sound_);
    GetChild<KaxAudioSamplingFreq>(samples).SetValue(kSoundClock);
    set<KaxAudioChannels>(samples, s.channels);
  }

  void write_clusters() {
    const std::vector<Placed> blocks = in_order(content_);
    for (std::size_t begin = 0; begin < blocks.size();) {
      std::size_t end = begin + 1;
      const auto begins = [](const Placed& p) { return p.track == kVideoTrack && p.block->key; };
      while (end < blocks.size() && !begins(blocks[end]) &&
             blocks[end].tick - blocks[begin].tick < kClusterTicks)
        ++end;
      write_cluster(std::span(blocks).subspan(begin, end - begin));
      begin = end;
    }
  }

  void write_cluster(std::span<const Placed> blocks) {
    KaxCluster cluster;
    const auto tick = static_cast<std::uint64_t>(blocks.front().tick);
    cluster.SetParent(segment_);
    cluster.InitTimecode(tick, kMatroskaTick);
    set<KaxClusterTimecode>(cluster, tick);
    for (const Placed& p : blocks)
      if (p.track == kVideoTrack)
        add_group(cluster, p);
      else
        add_simple(cluster, p);
    static_cast<libebml::EbmlElement&>(cluster).Render(out_);
    const Placed& first = blocks.front();
    if (first.track == kVideoTrack && first.block->key) add_cue(tick, segment_.GetRelativePosition(cluster));
  }

  /// The frame of a block; its bytes are not copied.
  static DataBuffer* frame_of(const MatroskaBlock& block) {
    // libmatroska only reads them.
    auto* bytes =
        const_cast<std::uint8_t*>(block.bytes.data());  // NOLINT(cppcoreguidelines-pro-type-const-cast)
    return new DataBuffer(bytes, static_cast<uint32>(block.bytes.size()));
  }

  void add_group(KaxCluster& cluster, const Placed& p) {
    auto& group = AddNewChild<KaxBlockGroup>(cluster);
    group.SetParent(cluster);
    group.SetParentTrack(*video_);
    group.AddFrame(*video_, p.tick * kMatroskaTick, *frame_of(*p.block), LACING_NONE);
    set<KaxBlockDuration>(group, ticks_of(p.block->time + p.block->duration) - p.tick);
    if (!p.block->key) GetChild<KaxReferenceBlock>(group).SetReferencedTimecode(last_video_ - p.tick);
    last_video_ = p.tick;
  }

  void add_simple(KaxCluster& cluster, const Placed& p) {
    auto& block = AddNewChild<KaxSimpleBlock>(cluster);
    block.SetParent(cluster);
    block.AddFrame(*sound_, p.tick * kMatroskaTick, *frame_of(*p.block), LACING_NONE);
    block.SetKeyframe(true);
  }

  void add_cue(std::uint64_t tick, std::uint64_t position) {
    auto& point = AddNewChild<KaxCuePoint>(cues_);
    set<KaxCueTime>(point, tick);
    auto& where = GetChild<KaxCueTrackPositions>(point);
    set<KaxCueTrack>(where, kVideoTrack);
    set<KaxCueClusterPosition>(where, position);
  }

  const MatroskaContent& content_;
  std::string application_;
  Memory out_;
  KaxSegment segment_;
  KaxSeekHead seek_head_;
  KaxCues cues_;
  KaxTrackEntry *video_ = nullptr, *sound_ = nullptr;  // in segment_
  std::int64_t last_video_ = 0;                        // tick of its last block
};

}  // namespace

Result<std::vector<std::uint8_t>> write_matroska(const MatroskaContent& content,
                                                 const std::string& application) {
  try {
    return Writer(content, application).write();
  } catch (const std::exception& problem) {
    return fail(ErrorCode::kInternal, std::string("libmatroska: ") + problem.what());
  }
}

}  // namespace fbs::cli
