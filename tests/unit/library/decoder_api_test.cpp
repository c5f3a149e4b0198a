#include <algorithm>
#include <map>
#include <mutex>
#include <numeric>
#include <thread>

#include "bitstream/packet.h"
#include "bitstream/syntax.h"
#include "tests/unit/library/api_decoder.h"

namespace fbs {
namespace {

fbs_status status_of_vector(const std::string& error) {
  static const std::map<std::string, fbs_status> statuses = {{"-", FBS_OK},
                                                             {"kNotFbs", FBS_ERROR_NOT_FBS},
                                                             {"kTruncated", FBS_ERROR_TRUNCATED},
                                                             {"kInvalidStream", FBS_ERROR_DAMAGED},
                                                             {"kUnsupported", FBS_ERROR_UNSUPPORTED},
                                                             {"kTooLarge", FBS_ERROR_TOO_LARGE}};
  return statuses.at(error);
}

TEST(DecoderApi, SaysWhichVersionItIs) {
  EXPECT_EQ(fbs_version_number(),
            unsigned{FBS_VERSION_MAJOR << 16 | FBS_VERSION_MINOR << 8 | FBS_VERSION_PATCH});
  const std::string text = std::to_string(FBS_VERSION_MAJOR) + "." + std::to_string(FBS_VERSION_MINOR) + "." +
                           std::to_string(FBS_VERSION_PATCH);
  EXPECT_EQ(fbs_version_string(), text);
  EXPECT_EQ(fbs_format_version(), unsigned{kFormatVersion});
}

TEST(DecoderApi, EveryStatusHasAText) {
  std::map<std::string, int> texts;
  for (int status = FBS_ERROR_INTERNAL; status <= FBS_END; ++status)
    ++texts[fbs_status_text(static_cast<fbs_status>(status))];
  EXPECT_EQ(texts.size(), std::size_t{FBS_END - FBS_ERROR_INTERNAL + 1});
  EXPECT_STREQ(fbs_status_text(static_cast<fbs_status>(-11)), "unknown status");
}

TEST(DecoderApi, VectorsInPiecesOfAnySize) {
  for (const Vector& vector : read_vectors(FBS_VECTORS)) {
    const auto bytes = vector_bytes(vector.file);
    for (const std::size_t piece : {std::size_t{7}, std::size_t{4096}, bytes.size()}) {
      SCOPED_TRACE(vector.file + " in pieces of " + std::to_string(piece));
      const Heard result = heard(bytes, piece);
      EXPECT_EQ(result.last, FBS_END);
      EXPECT_EQ(result.infos.size(), vector.expected.pictures);
      EXPECT_EQ(result.md5, vector.expected.md5);
      EXPECT_EQ(result.errors.empty() ? FBS_OK : result.errors.front(),
                status_of_vector(vector.expected.error));
    }
  }
}

// While one thread draws, outside the lock, another feeds what follows.
TEST(DecoderApi, IsFedWhileItDraws) {
  const auto bytes = vector_bytes("turns.fbs");
  for (const int threads : {1, 3}) {
    fbs_decoder_settings settings;
    fbs_decoder_default_settings(&settings, sizeof settings);
    settings.threads = threads;
    fbs_decoder* opened = nullptr;
    ASSERT_EQ(fbs_decoder_open(&opened, &settings), FBS_OK);
    const ApiDecoder decoder(opened);
    std::mutex mutex;
    std::thread feeder([&] {
      for (std::size_t at = 0; at < bytes.size(); at += 50) {
        const std::lock_guard lock(mutex);
        fbs_decoder_feed(opened, bytes.data() + at, std::min<std::size_t>(50, bytes.size() - at));
      }
      const std::lock_guard lock(mutex);
      fbs_decoder_finish(opened);
    });
    Md5 md5;
    for (fbs_status status = FBS_OK; status != FBS_END;) {
      {
        const std::lock_guard lock(mutex);
        status = fbs_decoder_next(opened, nullptr);
      }
      if (status == FBS_OK)
        md5.add(shown_by(opened));
      else if (status != FBS_END)
        std::this_thread::yield();
    }
    feeder.join();
    EXPECT_EQ(md5.hex(), heard(bytes).md5) << threads << " threads";
  }
}

TEST(DecoderApi, TellsNumbersTimesAndScenes) {
  const Heard result = heard(vector_bytes("turns.fbs"));
  ASSERT_EQ(result.infos.size(), 24u);
  std::uint64_t time = 0;
  int scenes = 0;
  for (std::size_t n = 0; n < result.infos.size(); ++n) {
    const fbs_picture_info& info = result.infos[n];
    EXPECT_EQ(info.number, n);
    EXPECT_EQ(info.time, time);
    EXPECT_GE(info.duration, 1u);
    EXPECT_EQ(info.held, 0);
    time += info.duration;
    scenes += info.new_scene;
  }
  EXPECT_EQ(result.infos[0].new_scene, 1);
  EXPECT_GE(scenes, 1);
}

TEST(DecoderApi, HeldPicturesAreThoseBefore) {
  const ApiDecoder decoder = api_decoder();
  const auto bytes = vector_bytes("lost_scene.fbs");
  ASSERT_EQ(fbs_decoder_feed(decoder.get(), bytes.data(), bytes.size()), FBS_OK);
  ASSERT_EQ(fbs_decoder_finish(decoder.get()), FBS_OK);
  std::vector<std::uint8_t> before;
  int held = 0;
  fbs_picture_info info{};
  for (fbs_status status = FBS_OK; status != FBS_END; status = fbs_decoder_next(decoder.get(), &info)) {
    if (status != FBS_OK) continue;
    fbs_const_picture picture;
    if (fbs_decoder_get_picture(decoder.get(), &picture) != FBS_OK) continue;
    auto now = samples_of(picture);
    if (info.held != 0) {
      ++held;
      EXPECT_EQ(now, before);
      EXPECT_EQ(info.new_scene, 0);
    }
    before = std::move(now);
  }
  EXPECT_GT(held, 0);
}

TEST(DecoderApi, PacketsOfALinkMayComeLate) {
  const auto bytes = vector_bytes("live.fbs");
  std::vector<std::vector<std::uint8_t>> packets;
  PacketReader reader(bytes);
  for (auto read = reader.next(); read && read->status == ReadStatus::kPacket; read = reader.next()) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(read->packet.offset);
    packets.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(read->packet.size));
  }
  ASSERT_GT(packets.size(), 9u);

  const ApiDecoder decoder = api_decoder();
  const auto feed = [&](std::size_t k) {
    ASSERT_EQ(fbs_decoder_feed_packet(decoder.get(), k, packets[k].data(), packets[k].size()), FBS_OK);
  };
  const auto worst = [&] {
    int found = FBS_QUALITY_EXACT;
    fbs_picture_info info{};
    for (fbs_status status{}; (status = fbs_decoder_next(decoder.get(), &info)) != FBS_NEED_DATA;)
      if (status == FBS_OK) found = std::max(found, info.quality);
    return found;
  };
  for (std::size_t k = 0; k < 6; ++k) feed(k);
  EXPECT_EQ(worst(), FBS_QUALITY_EXACT);
  feed(7);
  EXPECT_EQ(worst(), FBS_OK) << "it is waited for";
  EXPECT_EQ(fbs_decoder_skip_missing(decoder.get()), FBS_OK);
  EXPECT_EQ(worst(), FBS_QUALITY_INTERPOLATED);
  EXPECT_EQ(fbs_decoder_skip_missing(decoder.get()), FBS_NEED_DATA);
  EXPECT_EQ(fbs_decoder_needs_scene(decoder.get()), 0);
  std::uint64_t missing[2] = {};
  std::size_t count = 0;
  ASSERT_EQ(fbs_decoder_get_missing(decoder.get(), missing, 2, &count), FBS_OK);
  EXPECT_EQ(count, 1u);
  EXPECT_EQ(missing[0], 6u);
  feed(6);
  feed(8);
  EXPECT_EQ(worst(), FBS_QUALITY_EXACT);
  ASSERT_EQ(fbs_decoder_get_missing(decoder.get(), missing, 2, &count), FBS_OK);
  EXPECT_EQ(count, 0u);
  feed(10);
  (void)worst();
  ASSERT_EQ(fbs_decoder_packets_lost(decoder.get(), 10), FBS_OK);
  ASSERT_EQ(fbs_decoder_get_missing(decoder.get(), missing, 2, &count), FBS_OK);
  EXPECT_EQ(count, 0u);
  EXPECT_EQ(fbs_decoder_get_missing(decoder.get(), nullptr, 2, &count), FBS_ERROR_ARGUMENT);
}

TEST(DecoderApi, AStreamIsFedInOneWay) {
  const auto bytes = vector_bytes("live.fbs");
  const ApiDecoder decoder = api_decoder();
  const std::uint8_t* const data = bytes.data();
  ASSERT_EQ(fbs_decoder_feed(decoder.get(), data, 9), FBS_OK);
  EXPECT_EQ(fbs_decoder_feed_packet(decoder.get(), 0, data, 9), FBS_ERROR_ARGUMENT);
  ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
  EXPECT_EQ(fbs_decoder_feed_packet(decoder.get(), UINT64_MAX, data, bytes.size()), FBS_ERROR_ARGUMENT);
  ASSERT_EQ(fbs_decoder_feed_packet(decoder.get(), 0, data, bytes.size()), FBS_OK);
  EXPECT_EQ(fbs_decoder_feed(decoder.get(), data, 9), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_OK);
}

TEST(DecoderApi, TellsTheFormatOnceTheSetupHasArrived) {
  const ApiDecoder decoder = api_decoder();
  fbs_format format{};
  EXPECT_EQ(fbs_decoder_get_format(decoder.get(), &format), FBS_NEED_DATA);
  const auto bytes = vector_bytes("odd.fbs");
  for (std::size_t fed = 0; fbs_decoder_get_format(decoder.get(), &format) == FBS_NEED_DATA; ++fed) {
    ASSERT_LT(fed, 64u);
    ASSERT_EQ(fbs_decoder_feed(decoder.get(), &bytes[fed], 1), FBS_OK);
    ASSERT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_NEED_DATA);
  }
  fbs_const_picture picture;
  ASSERT_EQ(fbs_decoder_feed(decoder.get(), bytes.data() + 64, 0), FBS_OK) << "no bytes are fine";
  const ApiDecoder whole = at_first_picture("odd.fbs");
  ASSERT_EQ(fbs_decoder_get_picture(whole.get(), &picture), FBS_OK);
  EXPECT_EQ(format.width, picture.width);
  EXPECT_EQ(format.height, picture.height);
  EXPECT_GT(format.frame_rate_num, 0u);
}

TEST(DecoderApi, ErrorsAreReportedOnceWithTextAndPlace) {
  const auto whole = vector_bytes("talk.fbs");
  const Heard cut = heard(std::span(whole).first(whole.size() - 8));
  ASSERT_EQ(cut.errors.size(), 1u);
  EXPECT_EQ(cut.errors[0], FBS_ERROR_TRUNCATED);
  EXPECT_GT(cut.error_offsets[0], 4u);
  EXPECT_LT(cut.error_offsets[0], whole.size());
}

TEST(DecoderApi, NothingFollowsTheEnd) {
  const ApiDecoder decoder = api_decoder();
  const auto bytes = vector_bytes("one.fbs");
  EXPECT_EQ(heard(decoder.get(), bytes, 100).last, FBS_END);
  EXPECT_EQ(fbs_decoder_finish(decoder.get()), FBS_OK);
  EXPECT_EQ(fbs_decoder_feed(decoder.get(), bytes.data(), 1), FBS_ERROR_ARGUMENT);
  EXPECT_STRNE(fbs_decoder_error(decoder.get()), "");
  EXPECT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_END);
  EXPECT_EQ(shown_by(decoder.get()).size(), shown_by(at_first_picture("one.fbs").get()).size())
      << "the last picture can still be had";
}

TEST(DecoderApi, ForeignFilesAreRefused) {
  const std::string text = "RIFF, or anything else that is no stream of ours";
  const Heard result = heard({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, 1);
  ASSERT_EQ(result.errors.size(), 1u);
  EXPECT_EQ(result.errors[0], FBS_ERROR_NOT_FBS);
  EXPECT_EQ(heard(std::span<const std::uint8_t>{}).errors, std::vector{FBS_ERROR_NOT_FBS});
}

TEST(DecoderApi, LargePicturesAreRefusedBeforeTheyAreDecoded) {
  const auto bytes = vector_bytes("talk.fbs");
  fbs_format format{};
  ASSERT_EQ(fbs_decoder_get_format(at_first_picture("talk.fbs").get(), &format), FBS_OK);
  const std::uint64_t pixels = std::uint64_t{format.width} * format.height;
  const ApiDecoder enough = api_decoder(pixels), too_few = api_decoder(pixels - 1);
  EXPECT_TRUE(heard(enough.get(), bytes, 4096).errors.empty());
  const Heard refused = heard(too_few.get(), bytes, 4096);
  EXPECT_EQ(refused.errors, std::vector{FBS_ERROR_TOO_LARGE});
  EXPECT_TRUE(refused.infos.empty());
  EXPECT_EQ(fbs_decoder_get_format(too_few.get(), &format), FBS_NEED_DATA);
  EXPECT_EQ(fbs_decoder_reset(too_few.get()), FBS_OK);
  EXPECT_EQ(heard(too_few.get(), bytes, 4096).errors, std::vector{FBS_ERROR_TOO_LARGE})
      << "the settings stay";
}

TEST(DecoderApi, ThreadsDrawWhatOneDraws) {
  fbs_decoder_settings settings;
  fbs_decoder_default_settings(&settings, sizeof settings);
  EXPECT_EQ(settings.threads, 1);
  fbs_decoder* decoder = nullptr;
  char why[FBS_ERROR_SIZE] = "?";
  settings.open_error = why;
  for (const int threads : {-1, FBS_MAX_THREADS + 1}) {
    settings.threads = threads;
    EXPECT_EQ(fbs_decoder_open(&decoder, &settings), FBS_ERROR_ARGUMENT);
    EXPECT_EQ(decoder, nullptr);
    EXPECT_STREQ(why, "threads outside 0..64");
  }
  settings.threads = 0;  // as many as there are cores
  ASSERT_EQ(fbs_decoder_open(&decoder, &settings), FBS_OK);
  EXPECT_STREQ(why, "");
  fbs_decoder_close(&decoder);
  settings.threads = 3;
  ASSERT_EQ(fbs_decoder_open(&decoder, &settings), FBS_OK);
  const ApiDecoder several(decoder), one = api_decoder();
  const auto bytes = vector_bytes("talk.fbs");
  for (fbs_decoder* d : {several.get(), one.get()}) {
    ASSERT_EQ(fbs_decoder_feed(d, bytes.data(), bytes.size()), FBS_OK);
    ASSERT_EQ(fbs_decoder_finish(d), FBS_OK);
  }
  while (fbs_decoder_next(one.get(), nullptr) == FBS_OK) {
    ASSERT_EQ(fbs_decoder_next(several.get(), nullptr), FBS_OK);
    fbs_const_picture a, b;
    ASSERT_EQ(fbs_decoder_get_picture(one.get(), &a), FBS_OK);
    ASSERT_EQ(fbs_decoder_get_picture(several.get(), &b), FBS_OK);
    ASSERT_EQ(samples_of(a), samples_of(b));
  }
}

TEST(DecoderApi, ResetForgetsTheStream) {
  const ApiDecoder decoder = at_first_picture("truncated.fbs");
  ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
  fbs_const_picture picture;
  EXPECT_EQ(fbs_decoder_get_picture(decoder.get(), &picture), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_decoder_next(decoder.get(), nullptr), FBS_NEED_DATA);
  for (const std::size_t piece : {1u, 3u, 5000u}) {
    EXPECT_EQ(heard(decoder.get(), vector_bytes("odd.fbs"), piece).md5, "2573344f6a4808799e09cb249f32c0a6");
    ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
  }
}

TEST(DecoderApi, AfterResetTheSignatureMayBeLeftOut) {
  const auto bytes = vector_bytes("talk.fbs");
  const auto without = std::span(bytes).subspan(kSignature.size());
  const std::string expected = heard(bytes).md5;
  const ApiDecoder decoder = api_decoder();
  EXPECT_EQ(heard(decoder.get(), without, 1).errors, std::vector{FBS_ERROR_NOT_FBS}) << "not before";
  for (const std::size_t piece : {1u, 3u, 5000u}) {
    ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
    const Heard result = heard(decoder.get(), without, piece);
    EXPECT_TRUE(result.errors.empty());
    EXPECT_EQ(result.md5, expected) << piece;
  }
}

TEST(DecoderApi, OffsetsCountFedBytes) {
  auto bytes = vector_bytes("flipped_bits.fbs");
  const Heard whole = heard(bytes);
  const ApiDecoder decoder = api_decoder();
  ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
  const Heard joined = heard(decoder.get(), std::span(bytes).subspan(kSignature.size()), 100);
  ASSERT_EQ(whole.error_offsets.size(), 1u);
  ASSERT_EQ(joined.error_offsets.size(), 1u);
  EXPECT_EQ(joined.error_offsets[0] + kSignature.size(), whole.error_offsets[0]);
}

// A seek may end inside a signature, or before anything.
TEST(DecoderApi, AfterResetAnythingMayCome) {
  const ApiDecoder decoder = api_decoder();
  std::vector<std::uint8_t> bytes = {0x89, 'f', 'b', 'X', 1, 2, 3};
  for (std::size_t size = 0; size <= bytes.size(); ++size) {
    ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
    const Heard result = heard(decoder.get(), std::span(bytes).first(size), 1);
    EXPECT_EQ(result.last, FBS_END) << size;
    EXPECT_EQ(result.errors.size(), 1u) << size;
  }
}

TEST(DecoderApi, SeeksToTheSceneOfATime) {
  const auto bytes = vector_bytes("joined.fbs");
  const auto all = vector_bytes("backwards.fbs");
  fbs_scene scene{};
  EXPECT_EQ(fbs_find_scene(bytes.data(), bytes.size(), 0, &scene), FBS_OK);
  EXPECT_EQ(scene.offset, kSignature.size());
  EXPECT_EQ(fbs_find_scene(nullptr, 0, 0, &scene), FBS_END);
  EXPECT_EQ(fbs_find_scene(nullptr, 1, 0, &scene), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_find_scene(bytes.data(), bytes.size(), 0, nullptr), FBS_ERROR_ARGUMENT);
  EXPECT_EQ(fbs_find_scene(bytes.data() + 4, 3, 0, &scene), FBS_END);

  ASSERT_EQ(fbs_find_scene(all.data(), all.size(), UINT64_MAX, &scene), FBS_OK);
  ASSERT_GT(scene.offset, kSignature.size());
  ASSERT_GT(scene.number, 0u);
  const ApiDecoder decoder = at_first_picture("backwards.fbs");
  ASSERT_EQ(fbs_decoder_reset(decoder.get()), FBS_OK);
  const Heard result = heard(decoder.get(), std::span(all).subspan(scene.offset), 9);
  ASSERT_FALSE(result.infos.empty());
  EXPECT_EQ(result.infos[0].number, scene.number);
  EXPECT_EQ(result.infos[0].time, scene.time);
  EXPECT_EQ(result.infos[0].new_scene, 1);
}

}  // namespace
}  // namespace fbs
