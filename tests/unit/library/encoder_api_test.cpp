#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <set>

#include "bitstream/packet.h"
#include "decoder/stream/stream_decoder.h"
#include "encoder/encoder.h"
#include "fbs/encoder.h"
#include "fbs/fbs.h"
#include "tests/unit/library/api_decoder.h"
#include "tests/unit/talker_clip.h"

namespace fbs {
namespace {

constexpr int kSide = 112, kPictures = 45;

struct CloseEncoder {
  void operator()(fbs_encoder* encoder) const { fbs_encoder_close(&encoder); }
};
using ApiEncoder = std::unique_ptr<fbs_encoder, CloseEncoder>;

fbs_encoder_settings quick_settings() {
  fbs_encoder_settings settings;
  fbs_encoder_default_settings(&settings, sizeof settings);
  settings.format.width = settings.format.height = kSide;
  settings.format.frame_rate_num = 30;  // the talker's
  settings.effort = 0;
  return settings;
}

ApiEncoder api_encoder(const fbs_encoder_settings& settings) {
  fbs_encoder* encoder = nullptr;
  EXPECT_EQ(fbs_encoder_open(&encoder, &settings), FBS_OK);
  return ApiEncoder(encoder);
}

fbs_status open_status(const fbs_encoder_settings& settings) {
  fbs_encoder* encoder = nullptr;
  const fbs_status status = fbs_encoder_open(&encoder, &settings);
  EXPECT_EQ(encoder != nullptr, status == FBS_OK);
  fbs_encoder_close(&encoder);
  return status;
}

fbs_const_picture view_of(const Picture& p) {
  return {static_cast<std::uint32_t>(p.width()),
          static_cast<std::uint32_t>(p.height()),
          {p.y.samples.data(), p.u.samples.data(), p.v.samples.data()},
          {p.y.width, p.u.width, p.v.width}};
}

TalkerClip& clip() {
  static TalkerClip talker(talker_settings(kSide, kSide, kPictures));
  return talker;
}

struct Pulled {
  std::vector<std::vector<std::uint8_t>> packets;
  std::vector<fbs_packet> infos;  ///< their data is no longer valid
  fbs_status last = FBS_OK;

  [[nodiscard]] std::vector<std::uint8_t> stream() const {
    std::vector<std::uint8_t> out;
    for (const auto& packet : packets) out.insert(out.end(), packet.begin(), packet.end());
    return out;
  }
};

void pull(fbs_encoder* encoder, Pulled& out) {
  fbs_packet packet{};
  while ((out.last = fbs_encoder_pull(encoder, &packet)) == FBS_OK) {
    out.packets.emplace_back(packet.data, packet.data + packet.size);
    packet.data = nullptr;
    out.infos.push_back(packet);
  }
}

Pulled encoded(const fbs_encoder_settings& settings, int pictures, std::uint32_t duration = 0) {
  const ApiEncoder encoder = api_encoder(settings);
  Pulled out;
  for (int n = 0; n < pictures; ++n) {
    const fbs_const_picture picture = view_of(clip()[n]);
    EXPECT_EQ(fbs_encoder_push(encoder.get(), &picture, n % 3 == 2 ? duration : 0), FBS_OK);
    pull(encoder.get(), out);
    EXPECT_EQ(out.last, FBS_NEED_DATA);
  }
  EXPECT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK) << fbs_encoder_error(encoder.get());
  pull(encoder.get(), out);
  EXPECT_EQ(out.last, FBS_END);
  return out;
}

/// Feeds packet by packet: no picture that needs a packet comes before it, and its time is the first such
/// picture's.
void expect_right_places(const Pulled& pulled) {
  StreamDecoder decoder;
  std::map<std::uint64_t, std::uint64_t> times;  // of the pictures
  std::uint64_t end = 0;
  for (std::size_t k = 0; k < pulled.packets.size(); ++k) {
    const std::uint64_t number = pulled.infos[k].number;
    EXPECT_TRUE(times.empty() || times.rbegin()->first < number) << "packet " << k;
    decoder.feed(pulled.packets[k]);
    for (;;) {
      const auto status = decoder.next();
      ASSERT_TRUE(status) << status.error().text;
      if (*status != DecodeStatus::kPicture) break;
      times[decoder.position().pictures] = decoder.position().time;
      end = decoder.position().time + decoder.duration();
    }
  }
  ASSERT_EQ(pulled.infos.back().number, times.size()) << "the end packet";
  times[times.size()] = end;
  for (const fbs_packet& packet : pulled.infos) EXPECT_EQ(packet.time, times.at(packet.number));
}

TEST(EncoderApi, PacketsAreTheStream) {
  fbs_encoder_settings settings = quick_settings();
  settings.quality = 40;
  const Pulled pulled = encoded(settings, kPictures);
  EncoderSettings same;
  same.quality = 40;
  same.effort = 0;
  auto encoder = Encoder::create(clip().format(), same);
  std::vector<std::uint8_t> expected;
  const auto take = [&] {
    const auto bytes = encoder->take();
    expected.insert(expected.end(), bytes.begin(), bytes.end());
  };
  for (int n = 0; n < kPictures; ++n) {
    ASSERT_TRUE(encoder->push(clip()[n]));
    take();
  }
  ASSERT_TRUE(encoder->finish());
  take();
  EXPECT_EQ(pulled.stream(), expected);
  const Heard result = heard(pulled.stream());
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.infos.size(), std::size_t{kPictures});
}

TEST(EncoderApi, EachPacketTellsItsFirstPicture) {
  for (const int patterns : {0, 1}) {
    fbs_encoder_settings settings = quick_settings();
    settings.patterns = patterns;
    settings.key_interval = 1;
    const Pulled pulled = encoded(settings, kPictures, 5000);
    expect_right_places(pulled);
    ASSERT_FALSE(pulled.packets.empty());
    EXPECT_EQ(pulled.infos[0].key, 1);
    EXPECT_TRUE(std::equal(kSignature.begin(), kSignature.end(), pulled.packets[0].begin()));
    int keys = 0;
    for (std::size_t k = 0; k < pulled.packets.size(); ++k) {
      const std::size_t type_at = k == 0 ? kSignature.size() : 0;
      EXPECT_EQ(pulled.infos[k].key == 1,
                pulled.packets[k][type_at] == static_cast<std::uint8_t>(PacketType::kSetup));
      keys += pulled.infos[k].key;
    }
    EXPECT_GT(keys, 1) << "a scene every second";
  }
}

/// Stamps of pictures as a camera makes them, in ticks of its clock.
using Camera = std::vector<std::int64_t>;

constexpr std::int64_t kClock = 1'000'000'007;  // at the first picture

Camera camera(int pictures, const std::function<std::int64_t(int)>& interval) {
  Camera out{kClock};
  while (out.size() < static_cast<std::size_t>(pictures))
    out.push_back(out.back() + interval(static_cast<int>(out.size())));
  return out;
}

/// 7.5 pictures per second, by a clock of milliseconds.
Camera slow_camera(int pictures) {
  return camera(pictures, [](int n) { return n % 3 == 0 ? 11'970 : 12'015; });
}
Camera jittering_camera(int pictures) {
  std::mt19937 random(3);
  return camera(pictures, [&](int) { return 2000 + static_cast<std::int64_t>(random() % 2000); });
}
/// 30 pictures per second, with a gap of 20 seconds before this picture.
Camera interrupted_camera(int pictures, int gap) {
  return camera(pictures, [=](int n) { return n == gap ? 1'800'000 : 3000; });
}

void push_stamped(fbs_encoder* encoder, int n, std::int64_t time, std::uint32_t duration = 0) {
  const fbs_const_picture picture = view_of(clip()[n]);
  const fbs_stamp stamp = {sizeof stamp, time, 1000 + static_cast<std::uint64_t>(n), duration};
  EXPECT_EQ(fbs_encoder_push_stamped(encoder, &picture, &stamp), FBS_OK) << fbs_encoder_error(encoder);
}

/// How much later each picture is shown than it was taken, ticks, and the pictures that begin groups.
struct Lateness {
  std::vector<std::int64_t> ticks;
  std::set<std::size_t> begins;
};

Lateness lateness(const fbs_encoder_settings& settings, const Camera& times) {
  const ApiEncoder encoder = api_encoder(settings);
  Pulled pulled;
  for (std::size_t n = 0; n < times.size(); ++n) {
    push_stamped(encoder.get(), static_cast<int>(n), times[n]);
    pull(encoder.get(), pulled);
  }
  EXPECT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
  pull(encoder.get(), pulled);
  const Heard shown = heard(pulled.stream());
  EXPECT_TRUE(shown.errors.empty());
  EXPECT_EQ(shown.infos.size(), times.size());
  Lateness out;
  for (const fbs_picture_info& info : shown.infos)
    out.ticks.push_back(static_cast<std::int64_t>(info.time) - (times[out.ticks.size()] - times.front()));
  std::size_t before = 0;
  for (const fbs_packet& packet : pulled.infos)
    if (packet.pictures > 0) {
      out.begins.insert(before);
      before += packet.pictures;
    }
  return out;
}

fbs_encoder_settings live_settings(int threads) {
  fbs_encoder_settings settings = quick_settings();
  settings.live = 1;
  settings.threads = threads;
  return settings;
}

TEST(EncoderApi, ASteadyCameraIsExactAtAnyRate) {
  for (const int live : {0, 1}) {
    fbs_encoder_settings settings = live_settings(2);
    settings.live = live;
    const auto [late, begins] = lateness(settings, slow_camera(40));
    EXPECT_EQ(late[0], 0);
    EXPECT_EQ(late[1], 3000 - 12'015) << "the first is a group of its own, of nominal length";
    for (std::size_t n = 2; n < late.size(); ++n)
      EXPECT_LE(std::abs(late[n]), begins.contains(n) ? 45 : 1) << "picture " << n << ", live " << live;
  }
}

TEST(EncoderApi, OnlyTheFirstPictureOfAGroupCanBeOffAndTimesDoNotDrift) {
  for (const int gap : {0, 20, 25, 26}) {
    const Camera times = gap == 0 ? jittering_camera(kPictures) : interrupted_camera(kPictures, gap);
    const auto [late, begins] = lateness(live_settings(2), times);
    EXPECT_LT(begins.size(), late.size() / 4);
    for (std::size_t n = 0; n < late.size(); ++n) {
      std::int64_t most = 1;
      if (begins.contains(n) && gap == 0) most = 2000;
      if (begins.contains(n) && n == static_cast<std::size_t>(gap)) most = 1'797'000;
      EXPECT_LE(std::abs(late[n]), most) << "picture " << n << ", gap " << gap;
    }
  }
}

TEST(EncoderApi, TimesAreRightWhereScenesBegin) {
  fbs_encoder_settings settings = live_settings(2);
  settings.key_interval = 0.5;  // 15 pictures
  for (const std::int64_t late : lateness(settings, slow_camera(kPictures)).ticks)
    EXPECT_LE(std::abs(late), 9015);
}

TEST(EncoderApi, TimesGoOnFromASceneWithoutAFaceToOneWithAFace) {
  const Picture grey(kSide, kSide);
  const Camera times = jittering_camera(kPictures);
  for (const auto& [live, patterns] : {std::pair{0, 0}, {0, 1}, {1, 0}, {1, 1}}) {
    fbs_encoder_settings settings = live_settings(2);
    settings.live = live;
    settings.patterns = patterns;
    settings.allow_no_face = 1;
    const ApiEncoder encoder = api_encoder(settings);
    Pulled pulled;
    for (int n = 0; n < kPictures; ++n) {
      const fbs_const_picture picture = view_of(n / 10 % 2 == 0 ? grey : clip()[n]);
      const fbs_stamp stamp = {sizeof stamp, times[static_cast<std::size_t>(n)], 0, 0};
      ASSERT_EQ(fbs_encoder_push_stamped(encoder.get(), &picture, &stamp), FBS_OK);
    }
    ASSERT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
    pull(encoder.get(), pulled);
    fbs_encoder_report report{};
    ASSERT_EQ(fbs_encoder_get_report(encoder.get(), &report), FBS_OK);
    EXPECT_GT(report.scenes, 1U) << live << patterns;
    const Heard shown = heard(pulled.stream());
    EXPECT_TRUE(shown.errors.empty()) << live << patterns;
    ASSERT_EQ(shown.infos.size(), std::size_t{kPictures});
    std::size_t off = 0;
    for (std::size_t n = 0; n < times.size(); ++n) {
      const auto late = static_cast<std::int64_t>(shown.infos[n].time) - (times[n] - times.front());
      EXPECT_LE(std::abs(late), 2000) << n;
      off += std::abs(late) > 1 ? 1 : 0;
    }
    EXPECT_LE(off, kPictures / (live ? 6 : 30) + 2 * report.scenes) << "groups, and scenes";
  }
}

TEST(EncoderApi, ADurationThatIsKnownMakesAllTimesExact) {
  const Camera times = jittering_camera(20);
  const ApiEncoder encoder = api_encoder(live_settings(1));
  Pulled pulled;
  for (std::size_t n = 0; n < times.size(); ++n) {
    const std::int64_t next = n + 1 < times.size() ? times[n + 1] : times[n] + 7777;
    push_stamped(encoder.get(), static_cast<int>(n), times[n], static_cast<std::uint32_t>(next - times[n]));
  }
  ASSERT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
  pull(encoder.get(), pulled);
  const Heard shown = heard(pulled.stream());
  ASSERT_EQ(shown.infos.size(), times.size());
  for (std::size_t n = 0; n < times.size(); ++n)
    EXPECT_LE(std::abs(static_cast<std::int64_t>(shown.infos[n].time) - (times[n] - times.front())), 1) << n;
  EXPECT_NEAR(shown.infos.back().duration, 7777, 1);
}

TEST(EncoderApi, PacketsBringTheStampOfTheirPicture) {
  const ApiEncoder encoder = api_encoder(live_settings(1));
  const auto stamp_of = [&] {
    fbs_stamp stamp{};
    stamp.struct_size = sizeof stamp;
    EXPECT_EQ(fbs_encoder_get_stamp(encoder.get(), &stamp), FBS_OK);
    EXPECT_EQ(stamp.struct_size, sizeof stamp);
    return stamp;
  };
  fbs_stamp stamp{};
  stamp.struct_size = sizeof stamp;
  EXPECT_EQ(fbs_encoder_get_stamp(encoder.get(), &stamp), FBS_ERROR_ARGUMENT) << "no packet yet";
  const Camera times = slow_camera(20);
  fbs_packet packet{};
  std::size_t packets = 0;
  for (int n = 0; n < 20; ++n) {
    if (n == 13) {  // a group begins
      const fbs_const_picture picture = view_of(clip()[n]);
      ASSERT_EQ(fbs_encoder_push(encoder.get(), &picture, 1234), FBS_OK);
    } else {
      push_stamped(encoder.get(), n, times[static_cast<std::size_t>(n)]);
    }
    while (fbs_encoder_pull(encoder.get(), &packet) == FBS_OK) {
      ++packets;
      const fbs_stamp found = stamp_of();
      if (packet.number == 13) {
        EXPECT_EQ(found.time, FBS_NO_TIME);
        EXPECT_EQ(found.user, 0U);
        EXPECT_EQ(found.duration, 1234U);
      } else {
        EXPECT_EQ(found.time, times[packet.number]);
        EXPECT_EQ(found.user, 1000 + packet.number);
      }
    }
  }
  EXPECT_GT(packets, 4U);
  ASSERT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
  while (fbs_encoder_pull(encoder.get(), &packet) == FBS_OK)
    if (packet.type != FBS_PACKET_END) {
      EXPECT_EQ(stamp_of().time, times[packet.number]);
    }
  EXPECT_EQ(fbs_encoder_get_stamp(encoder.get(), &stamp), FBS_ERROR_ARGUMENT) << "of the end packet";
}

TEST(EncoderApi, StampsThatMakeNoSenseAreRefused) {
  const ApiEncoder encoder = api_encoder(live_settings(1));
  const fbs_const_picture picture = view_of(clip()[0]);
  const auto push = [&](const fbs_stamp& stamp) {
    return fbs_encoder_push_stamped(encoder.get(), &picture, &stamp);
  };
  EXPECT_EQ(push({0, 5, 0, 0}), FBS_ERROR_ARGUMENT) << "no size";
  EXPECT_EQ(push({sizeof(fbs_stamp), 500, 0, 0}), FBS_OK);
  for (const std::int64_t time : {std::int64_t{500}, std::int64_t{-1}, INT64_MAX})
    EXPECT_EQ(push({sizeof(fbs_stamp), time, 0, 0}), FBS_ERROR_ARGUMENT) << time;
  EXPECT_STRNE(fbs_encoder_error(encoder.get()), "");
  EXPECT_EQ(push({sizeof(fbs_stamp), 600, 0, 60 * FBS_TICKS_PER_SECOND + 1}), FBS_ERROR_ARGUMENT);
  struct Later {
    fbs_stamp known;
    std::uint64_t unknown;
  } later{{sizeof(Later), 600, 0, 0}, 1};
  EXPECT_EQ(push(later.known), FBS_ERROR_ARGUMENT) << "a member that is unknown";
  later.unknown = 0;
  EXPECT_EQ(push(later.known), FBS_OK);
  fbs_encoder_report report{};
  ASSERT_EQ(fbs_encoder_get_report(encoder.get(), &report), FBS_OK);
  EXPECT_EQ(report.pictures, 2U);
}

TEST(EncoderApi, WaitsForWhatOthersCode) {
  constexpr std::uint32_t kLong = 600'000;  // ms: a test that hangs fails
  for (const int threads : {1, 3}) {
    const ApiEncoder encoder = api_encoder(live_settings(threads));
    EXPECT_EQ(fbs_encoder_wait(encoder.get(), kLong), FBS_NEED_DATA) << "there is nothing to wait for";
    Pulled pulled;
    for (int n = 0; n < 7; ++n) {
      push_stamped(encoder.get(), n, 3000 * n);
      while (fbs_encoder_wait(encoder.get(), kLong) == FBS_OK) {
        EXPECT_EQ(fbs_encoder_wait(encoder.get(), 0), FBS_OK) << "until it is pulled";
        fbs_packet packet{};
        ASSERT_EQ(fbs_encoder_pull(encoder.get(), &packet), FBS_OK);
        pulled.packets.emplace_back(packet.data, packet.data + packet.size);
      }
      const std::size_t complete = n < 6 ? 1 : 7;
      EXPECT_EQ(heard(pulled.stream()).infos.size(), complete) << "after picture " << n;
    }
    ASSERT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
    EXPECT_EQ(fbs_encoder_wait(encoder.get(), kLong), FBS_OK);
    pull(encoder.get(), pulled);
    EXPECT_EQ(fbs_encoder_wait(encoder.get(), kLong), FBS_END);
  }
}

TEST(EncoderApi, LivePacketsComeAtOnce) {
  fbs_encoder_settings settings = quick_settings();
  settings.live = 1;
  settings.threads = 1;
  const ApiEncoder encoder = api_encoder(settings);
  Pulled pulled;
  const fbs_const_picture first = view_of(clip()[0]);
  ASSERT_EQ(fbs_encoder_push(encoder.get(), &first, 0), FBS_OK);
  pull(encoder.get(), pulled);
  EXPECT_EQ(heard(pulled.stream()).infos.size(), 1u) << "the first picture leaves alone";
  expect_right_places(encoded(settings, 20));
}

/// @param key_interval  s; 0: the default
fbs_encoder_settings lossy_settings(int resilience, double key_interval = 0, double join = 0) {
  fbs_encoder_settings settings = quick_settings();
  settings.quality = 40;
  settings.live = 1;
  settings.resilience = resilience;
  if (key_interval > 0) settings.key_interval = key_interval;
  settings.join = join;
  return settings;
}

/// A viewer of a live stream whose packets come in any order.
struct Viewer {
  ApiDecoder decoder = api_decoder();
  Heard heard;
  Md5 md5;
  bool draws = false, asked = false;  ///< asked: a scene would have helped at some time

  void feed(std::uint64_t number, const std::vector<std::uint8_t>& packet) {
    EXPECT_EQ(fbs_decoder_feed_packet(decoder.get(), number, packet.data(), packet.size()), FBS_OK);
    look();
  }
  void look() {
    fbs_picture_info info{};
    while ((heard.last = fbs_decoder_next(decoder.get(), &info)) != FBS_NEED_DATA && heard.last != FBS_END) {
      if (heard.last != FBS_OK) {
        heard.errors.push_back(heard.last);
        continue;
      }
      heard.infos.push_back(info);
      if (draws) md5.add(shown_by(decoder.get()));
    }
    asked = asked || fbs_decoder_needs_scene(decoder.get()) != 0;
  }
  void finish() {
    EXPECT_EQ(fbs_decoder_finish(decoder.get()), FBS_OK);
    look();
    EXPECT_EQ(heard.last, FBS_END);
    heard.md5 = md5.hex();
  }
  [[nodiscard]] std::size_t missing() const {
    std::uint64_t numbers[64];
    std::size_t count = 0;
    EXPECT_EQ(fbs_decoder_get_missing(decoder.get(), numbers, 64, &count), FBS_OK);
    return count;
  }
};

/// Numbers 0..`packets` - 1 in a random order in which none comes before one that is more than FBS_REORDER
/// below it.
std::vector<std::size_t> any_order(std::size_t packets, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<std::pair<std::uint64_t, std::size_t>> places;
  for (std::size_t k = 0; k < packets; ++k)
    places.push_back({1000 * k + random() % (1000 * (FBS_REORDER + 1)), k});
  std::sort(places.begin(), places.end());
  std::vector<std::size_t> order;
  for (const auto& place : places) order.push_back(place.second);
  return order;
}

TEST(EncoderApi, LivePacketsMayComeInAnyOrder) {
  const std::array settings = {lossy_settings(FBS_RESILIENCE_NONE), lossy_settings(FBS_RESILIENCE_NONE, 0.5),
                               lossy_settings(FBS_RESILIENCE_PACKET),
                               lossy_settings(FBS_RESILIENCE_STRONG, 1),
                               lossy_settings(FBS_RESILIENCE_PACKET, 0, 5)};
  std::vector<std::vector<std::vector<std::uint8_t>>> streams;
  std::vector<std::string> digests;
  for (const fbs_encoder_settings& s : settings) {
    streams.push_back(encoded(s, kPictures).packets);
    Viewer in_order;
    in_order.draws = true;
    for (std::size_t k = 0; k < streams.back().size(); ++k) in_order.feed(k, streams.back()[k]);
    in_order.finish();
    ASSERT_EQ(in_order.heard.infos.size(), static_cast<std::size_t>(kPictures));
    digests.push_back(in_order.heard.md5);
  }
  for (unsigned seed = 0; seed < 1000 && !testing::Test::HasFailure(); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    const std::size_t stream = seed % streams.size();
    const std::uint64_t first = std::array{0, 0, 1, 5000}[seed / 5 % 4];
    const auto& packets = streams[stream];
    Viewer viewer;
    viewer.draws = seed < 20;
    for (const std::size_t k : any_order(packets.size(), seed)) viewer.feed(first + k, packets[k]);
    EXPECT_EQ(viewer.missing(), 0U);
    viewer.finish();
    EXPECT_TRUE(viewer.heard.errors.empty());
    EXPECT_FALSE(viewer.asked);
    ASSERT_EQ(viewer.heard.infos.size(), static_cast<std::size_t>(kPictures));
    for (std::size_t n = 0; n < kPictures; ++n) {
      EXPECT_EQ(viewer.heard.infos[n].number, n);
      EXPECT_EQ(viewer.heard.infos[n].quality, FBS_QUALITY_EXACT);
    }
    if (viewer.draws) {
      EXPECT_EQ(viewer.heard.md5, digests[stream]);
    }
  }
}

// Whatever is lost: no error, every picture that is shown is in its place, and motion goes on behind a loss.
TEST(EncoderApi, LivePacketsMayBeLostInAnyOrder) {
  for (const int resilience : {FBS_RESILIENCE_NONE, FBS_RESILIENCE_PACKET, FBS_RESILIENCE_STRONG}) {
    const auto packets = encoded(lossy_settings(resilience), kPictures).packets;
    for (unsigned seed = 0; seed < 100; ++seed) {
      SCOPED_TRACE(testing::Message() << "resilience " << resilience << ", seed " << seed);
      std::mt19937 random(seed + 5000);
      Viewer viewer;
      bool head_lost = false;
      for (const std::size_t k : any_order(packets.size(), seed)) {
        if (random() % 10 > 0)
          viewer.feed(k, packets[k]);
        else
          head_lost = head_lost || k < 4;
      }
      viewer.finish();
      EXPECT_TRUE(viewer.heard.errors.empty());
      for (std::size_t n = 1; n < viewer.heard.infos.size(); ++n)
        EXPECT_EQ(viewer.heard.infos[n].number, viewer.heard.infos[n - 1].number + 1);
      const bool goes_on = !head_lost && resilience != FBS_RESILIENCE_NONE;
      EXPECT_TRUE(goes_on ? !viewer.asked : viewer.asked || !viewer.heard.infos.empty());
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(EncoderApi, RowsMayLieInAnyOrder) {
  fbs_encoder_settings settings = quick_settings();
  settings.patterns = 1;
  const ApiEncoder encoder = api_encoder(settings);
  for (int n = 0; n < 10; ++n) {
    Picture flipped = clip()[n];
    fbs_const_picture view = view_of(flipped);
    Plane* const planes[] = {&flipped.y, &flipped.u, &flipped.v};
    for (std::size_t k = 0; k < 3; ++k) {
      Plane& plane = *planes[k];
      for (int y = 0; y < plane.height / 2; ++y)
        std::swap_ranges(plane.row(y), plane.row(y) + plane.width, plane.row(plane.height - 1 - y));
      view.data[k] = plane.row(plane.height - 1);
      view.stride[k] = -plane.width;
    }
    ASSERT_EQ(fbs_encoder_push(encoder.get(), &view, 0), FBS_OK);
  }
  ASSERT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
  Pulled pulled;
  pull(encoder.get(), pulled);
  EXPECT_EQ(pulled.stream(), encoded(settings, 10).stream());
}

TEST(EncoderApi, LandmarksAreWhereTheDecoderSeesThem) {
  const ApiEncoder encoder = api_encoder(quick_settings());
  std::vector<std::array<fbs_landmark, FBS_LANDMARKS>> tracked(20);
  fbs_landmark none[FBS_LANDMARKS];
  EXPECT_EQ(fbs_encoder_get_landmarks(encoder.get(), none), FBS_ERROR_ARGUMENT);
  for (int n = 0; n < 20; ++n) {
    const fbs_const_picture picture = view_of(clip()[n]);
    ASSERT_EQ(fbs_encoder_push(encoder.get(), &picture, 0), FBS_OK);
    ASSERT_EQ(fbs_encoder_get_landmarks(encoder.get(), tracked[static_cast<std::size_t>(n)].data()), FBS_OK);
  }
  ASSERT_EQ(fbs_encoder_finish(encoder.get()), FBS_OK);
  Pulled pulled;
  pull(encoder.get(), pulled);
  const auto stream = pulled.stream();
  const ApiDecoder decoder = api_decoder();
  ASSERT_EQ(fbs_decoder_feed(decoder.get(), stream.data(), stream.size()), FBS_OK);
  double sum = 0;
  for (const auto& points : tracked) {
    ASSERT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_OK);
    fbs_landmark shown[FBS_LANDMARKS];
    ASSERT_EQ(fbs_decoder_get_landmarks(decoder.get(), shown), FBS_OK);
    for (std::size_t k = 0; k < FBS_LANDMARKS; ++k) {
      EXPECT_GT(points[k].confidence, 0);
      EXPECT_LE(points[k].confidence, 1);
      sum += std::hypot(points[k].x - shown[k].x, points[k].y - shown[k].y);
    }
  }
  EXPECT_LT(sum / (20 * FBS_LANDMARKS), 0.5) << "pixels";
}

TEST(EncoderApi, ReportsWhatHappened) {
  const ApiEncoder encoder = api_encoder(quick_settings());
  fbs_encoder_report report{};
  ASSERT_EQ(fbs_encoder_get_report(encoder.get(), &report), FBS_OK);
  EXPECT_EQ(report.pictures, 0u);
  const fbs_const_picture picture = view_of(clip()[0]);
  ASSERT_EQ(fbs_encoder_push(encoder.get(), &picture, 0), FBS_OK);
  ASSERT_EQ(fbs_encoder_get_report(encoder.get(), &report), FBS_OK);
  EXPECT_EQ(report.pictures, 1u);
  EXPECT_EQ(report.without_face, 0u);
  EXPECT_EQ(report.scenes, 1u);
}

TEST(EncoderApi, SettingsOutOfRangeAreRefused) {
  EXPECT_EQ(open_status(quick_settings()), FBS_OK);
  fbs_encoder_settings unset;
  fbs_encoder_default_settings(&unset, sizeof unset);
  EXPECT_EQ(open_status(unset), FBS_ERROR_ARGUMENT) << "no width, no height";
  EXPECT_EQ(open_status(fbs_encoder_settings{}), FBS_ERROR_ARGUMENT) << "struct_size is 0";
  const auto refuses = [](auto&& change) {
    fbs_encoder_settings settings = quick_settings();
    change(settings);
    return open_status(settings) == FBS_ERROR_ARGUMENT;
  };
  using Settings = fbs_encoder_settings;
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(refuses([](Settings& s) { s.format.width = FBS_MIN_SIDE - 1; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.format.height = FBS_MAX_SIDE + 1; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.format.height = UINT32_MAX; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.format.frame_rate_num = 0; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.format.frame_rate_den = 0; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.format.frame_rate_num = UINT32_MAX; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.format.pixel_aspect_den = 0; }));
  EXPECT_TRUE(refuses([](Settings& s) {
    const int unknown = 3;
    std::memcpy(static_cast<void*>(&s.format.matrix), &unknown, sizeof unknown);
  }));
  for (const int quality : {-1, 101})
    EXPECT_TRUE(refuses([&](Settings& s) { s.quality = quality; })) << quality;
  for (const int effort : {-1, 10}) EXPECT_TRUE(refuses([&](Settings& s) { s.effort = effort; })) << effort;
  for (const int tune : {-1, 2}) EXPECT_TRUE(refuses([&](Settings& s) { s.tune = tune; })) << tune;
  for (const int patterns : {-1, 65})
    EXPECT_TRUE(refuses([&](Settings& s) { s.patterns = patterns; })) << patterns;
  EXPECT_TRUE(refuses([](Settings& s) { s.face = -1; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.threads = -1; }));
  for (const double value : {-1.0, kNan, kInfinity, -kInfinity, 1e300}) {
    EXPECT_TRUE(refuses([&](Settings& s) { s.bitrate = value; })) << value;
    EXPECT_TRUE(refuses([&](Settings& s) { s.seconds = value; })) << value;
    EXPECT_TRUE(refuses([&](Settings& s) { s.key_interval = value; })) << value;
    EXPECT_TRUE(refuses([&](Settings& s) { s.live = 1, s.live_delay = value; })) << value;
    EXPECT_TRUE(refuses([&](Settings& s) { s.live = 1, s.live_buffer = value; })) << value;
    EXPECT_TRUE(refuses([&](Settings& s) { s.bitrate = 5, s.start = value == -1 ? -2 : value; })) << value;
  }
  EXPECT_TRUE(refuses([](Settings& s) { s.start = 1; })) << "of no rate";
  EXPECT_TRUE(refuses([](Settings& s) { s.live = 1, s.live_delay = 0; }));
  EXPECT_TRUE(refuses([](Settings& s) { s.live = 1, s.patterns = 2; }));
}

TEST(EncoderApi, OpenTellsWhyItFails) {
  char why[FBS_ERROR_SIZE] = "?";
  fbs_encoder_settings settings = quick_settings();
  settings.open_error = why;
  EXPECT_EQ(open_status(settings), FBS_OK);
  EXPECT_STREQ(why, "");
  settings.format.width = 7;
  EXPECT_EQ(open_status(settings), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(why, "width or height outside 64..8192");
  settings.format.width = 64;
  settings.quality = 101;
  EXPECT_EQ(open_status(settings), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(why, "quality outside 0..100");
}

// A program compiled with the header of version 0.2.
TEST(EncoderApi, SettingsWithoutALaterMemberAreTaken) {
  fbs_encoder_settings settings = quick_settings();
  settings.struct_size = offsetof(fbs_encoder_settings, open_error);
  settings.open_error = reinterpret_cast<char*>(1);  // what comes to lie there
  EXPECT_EQ(open_status(settings), FBS_OK);
  settings.quality = -1;
  EXPECT_EQ(open_status(settings), FBS_ERROR_ARGUMENT);
}

TEST(EncoderApi, PicturesThatDoNotFitAreRefused) {
  const ApiEncoder encoder = api_encoder(quick_settings());
  const auto refuses = [&](auto&& change, std::uint32_t duration = 0) {
    fbs_const_picture picture = view_of(clip()[0]);
    change(picture);
    return fbs_encoder_push(encoder.get(), &picture, duration) == FBS_ERROR_ARGUMENT &&
           *fbs_encoder_error(encoder.get()) != '\0';
  };
  EXPECT_TRUE(refuses([](fbs_const_picture& p) { ++p.width; }));
  EXPECT_TRUE(refuses([](fbs_const_picture& p) { --p.height; }));
  for (int k = 0; k < 3; ++k) {
    EXPECT_TRUE(refuses([&](fbs_const_picture& p) { p.data[k] = nullptr; }));
    EXPECT_TRUE(refuses([&](fbs_const_picture& p) { --p.stride[k]; }));
  }
  EXPECT_TRUE(refuses([](fbs_const_picture&) {}, 60 * FBS_TICKS_PER_SECOND + 1));
  fbs_encoder_report report{};
  ASSERT_EQ(fbs_encoder_get_report(encoder.get(), &report), FBS_OK);
  EXPECT_EQ(report.pictures, 0u) << "nothing was taken";
}

TEST(EncoderApi, NullPointersAreAnswered) {
  fbs_encoder_default_settings(nullptr, sizeof(fbs_encoder_settings));
  fbs_encoder* none = nullptr;
  const fbs_encoder_settings settings = quick_settings();
  const fbs_const_picture picture = view_of(clip()[0]);
  fbs_packet packet;
  fbs_stamp stamp{};
  fbs_encoder_report report;
  fbs_landmark landmarks[FBS_LANDMARKS];
  EXPECT_EQ(fbs_encoder_open(nullptr, &settings), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_open(&none, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_push(none, &picture, 0), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_push_stamped(none, &picture, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_wait(none, 0), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_stamp(none, &stamp), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_finish(none), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_pull(none, &packet), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_report(none, &report), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_landmarks(none, landmarks), FBS_ERROR_ARGUMENT);
  EXPECT_STREQ(fbs_encoder_error(none), "");
  fbs_encoder_close(nullptr);
  fbs_encoder_close(&none);
  const ApiEncoder encoder = api_encoder(settings);
  EXPECT_EQ(fbs_encoder_push(encoder.get(), nullptr, 0), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_push_stamped(encoder.get(), nullptr, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_stamp(encoder.get(), nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_stamp(encoder.get(), &stamp), FBS_ERROR_ARGUMENT) << "its size is 0";
  EXPECT_EQ(fbs_encoder_pull(encoder.get(), nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_report(encoder.get(), nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_encoder_get_landmarks(encoder.get(), nullptr), FBS_ERROR_ARGUMENT);
}

// A loop that pushes, finishes and pulls until FBS_END comes to an end whatever happens.
TEST(EncoderApi, EveryEncodingEnds) {
  fbs_packet packet;
  const ApiEncoder empty = api_encoder(quick_settings());
  EXPECT_EQ(fbs_encoder_pull(empty.get(), &packet), FBS_NEED_DATA);
  EXPECT_EQ(fbs_encoder_finish(empty.get()), FBS_ERROR_ARGUMENT) << "no picture";
  EXPECT_EQ(fbs_encoder_pull(empty.get(), &packet), FBS_END);

  const Picture grey(kSide, kSide);
  const fbs_const_picture view = view_of(grey);
  const ApiEncoder nobody = api_encoder(quick_settings());
  for (int n = 0; n < 3; ++n) ASSERT_EQ(fbs_encoder_push(nobody.get(), &view, 0), FBS_OK);
  EXPECT_EQ(fbs_encoder_finish(nobody.get()), FBS_ERROR_NO_FACE);
  Pulled pulled;
  pull(nobody.get(), pulled);
  EXPECT_EQ(pulled.last, FBS_END);
  EXPECT_EQ(fbs_encoder_finish(nobody.get()), FBS_ERROR_ARGUMENT) << "a second time";
  EXPECT_EQ(fbs_encoder_push(nobody.get(), &view, 0), FBS_ERROR_ARGUMENT);

  fbs_encoder_settings settings = quick_settings();
  settings.allow_no_face = 1;
  const ApiEncoder allowed = api_encoder(settings);
  for (int n = 0; n < 3; ++n) ASSERT_EQ(fbs_encoder_push(allowed.get(), &view, 0), FBS_OK);
  fbs_landmark landmarks[FBS_LANDMARKS];
  EXPECT_EQ(fbs_encoder_get_landmarks(allowed.get(), landmarks), FBS_ERROR_NO_FACE);
  EXPECT_EQ(fbs_encoder_finish(allowed.get()), FBS_OK);
  EXPECT_EQ(fbs_encoder_finish(allowed.get()), FBS_ERROR_ARGUMENT) << "a second time";
  EXPECT_EQ(fbs_encoder_push(allowed.get(), &view, 0), FBS_ERROR_ARGUMENT);
  Pulled whole;
  pull(allowed.get(), whole);
  EXPECT_EQ(whole.last, FBS_END);
  const Heard result = heard(whole.stream());
  EXPECT_TRUE(result.errors.empty());
  EXPECT_EQ(result.infos.size(), 3u) << "calls after the end change nothing";
}

TEST(EncoderApi, AFaceThatIsNotThereEndsTheEncoding) {
  fbs_encoder_settings settings = quick_settings();
  settings.face = 3;
  const ApiEncoder encoder = api_encoder(settings);
  const fbs_const_picture picture = view_of(clip()[0]);
  EXPECT_EQ(fbs_encoder_push(encoder.get(), &picture, 0), FBS_ERROR_NO_FACE);
  EXPECT_STRNE(fbs_encoder_error(encoder.get()), "");
  EXPECT_EQ(fbs_encoder_push(encoder.get(), &picture, 0), FBS_ERROR_ARGUMENT);
  fbs_packet packet;
  EXPECT_EQ(fbs_encoder_pull(encoder.get(), &packet), FBS_END);
}

TEST(EncoderApi, CallsComeInAnyOrder) {
  std::mt19937 random(1);
  for (int sequence = 0; sequence < 6; ++sequence) {
    fbs_encoder_settings settings = quick_settings();
    settings.live = static_cast<int>(random() % 2);
    settings.patterns = static_cast<int>(random() % 2);
    const ApiEncoder encoder = api_encoder(settings);
    bool ended = false;
    for (int call = 0; call < 40; ++call) {
      const fbs_const_picture picture = view_of(clip()[static_cast<int>(random() % kPictures)]);
      fbs_packet packet;
      fbs_landmark landmarks[FBS_LANDMARKS];
      fbs_encoder_report report;
      switch (random() % 6) {
        case 0:
        case 1:
          EXPECT_EQ(fbs_encoder_push(encoder.get(), &picture, random() % 9000),
                    ended ? FBS_ERROR_ARGUMENT : FBS_OK);
          break;
        case 2: {
          const fbs_status status = fbs_encoder_pull(encoder.get(), &packet);
          EXPECT_TRUE(status == FBS_OK || status == (ended ? FBS_END : FBS_NEED_DATA)) << status;
          break;
        }
        case 3:
          EXPECT_EQ(fbs_encoder_get_report(encoder.get(), &report), FBS_OK);
          break;
        case 4:
          EXPECT_NE(fbs_encoder_get_landmarks(encoder.get(), landmarks), FBS_ERROR_INTERNAL);
          break;
        default:
          if (random() % 8 == 0) {
            EXPECT_NE(fbs_encoder_finish(encoder.get()), FBS_ERROR_INTERNAL);
            ended = true;
          }
      }
    }
  }
}

}  // namespace
}  // namespace fbs
