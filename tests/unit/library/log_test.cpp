// The log and the hook of threads, through the C++ headers, whose names are ours: nothing else of fbs is
// included.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <mutex>
#include <string>
#include <vector>

#include "fbs/encoder.hpp"
#include "fbs/fbs.hpp"

namespace fbs::api {
namespace {

/// Keeps lines, of any thread.
struct Log {
  void operator()(fbs_log_level level, const char* text) {
    const std::lock_guard lock(mutex);
    lines.push_back(std::to_string(level) + " " + text);
  }
  [[nodiscard]] bool has(fbs_log_level level, const std::string& text) const {
    return std::any_of(lines.begin(), lines.end(), [&](const std::string& line) {
      return line.starts_with(std::to_string(level)) && line.find(text) != std::string::npos;
    });
  }
  std::mutex mutex;
  std::vector<std::string> lines;
};

std::string all(const Log& log) {
  std::string out;
  for (const std::string& line : log.lines) out += line + "\n";
  return out;
}

std::vector<std::uint8_t> vector_bytes(const std::string& name) {
  std::ifstream file(FBS_VECTORS "/" + name, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_FALSE(bytes.empty()) << name;
  return bytes;
}

void decode(Decoder& decoder, const std::vector<std::uint8_t>& bytes) {
  decoder.feed(bytes.data(), bytes.size());
  decoder.finish();
  for (fbs_status status = FBS_OK; status != FBS_END;) {
    status = fbs_decoder_next(decoder.get(), nullptr);
    if (status == FBS_OK) decoder.picture();
  }
}

TEST(Log, TellsOfScenesAndOfLittleElseWhereAStreamIsWhole) {
  Log log;
  auto settings = Decoder::default_settings();
  log_to(settings, log);
  Decoder decoder(settings);
  decode(decoder, vector_bytes("talk.fbs"));
  EXPECT_EQ(log.lines.size(), 2U) << all(log);
  EXPECT_TRUE(log.has(FBS_LOG_DEBUG, "kernels ")) << all(log);
  EXPECT_TRUE(log.has(FBS_LOG_INFO, "picture 0: a scene of 128x96 begins, with a face")) << all(log);
}

TEST(Log, TellsOfDamageAndWhatPicturesSuffer) {
  for (const char* const name : {"live_without_6.fbs", "lost_scene.fbs"}) {
    Log log;
    auto settings = Decoder::default_settings();
    log_to(settings, log);
    Decoder decoder(settings);
    decode(decoder, vector_bytes(name));
    SCOPED_TRACE(name + (":\n" + all(log)));
    EXPECT_TRUE(log.has(FBS_LOG_WARNING, "; decoding goes on behind it"));
    EXPECT_TRUE(log.has(FBS_LOG_WARNING, "missing"));
    EXPECT_TRUE(log.has(FBS_LOG_INFO, "exact again"));
    EXPECT_LT(log.lines.size(), 16U);  // a line for a row of pictures, not for each
  }
}

TEST(Log, SaysWhyAnEncoderDoesNotOpen) {
  Log log;
  auto settings = Encoder::default_settings();
  log_to(settings, log);
  EXPECT_THROW(Encoder{settings}, Error);
  EXPECT_TRUE(log.has(FBS_LOG_ERROR, "width or height outside 64..8192")) << all(log);
}

/// what() of the error that opening throws.
template <class Object, class Settings>
std::string refusal(const Settings& settings) {
  try {
    const Object opened(settings);
  } catch (const Error& error) {
    EXPECT_EQ(error.status(), FBS_ERROR_ARGUMENT);
    return error.what();
  }
  return "opened";
}

TEST(Wrappers, ThrowWhyAnObjectDoesNotOpen) {
  EXPECT_EQ(refusal<Encoder>(Encoder::default_settings()), "width or height outside 64..8192");
  auto settings = Decoder::default_settings();
  settings.threads = -1;
  EXPECT_EQ(refusal<Decoder>(settings), "threads outside 0..64");
}

/// Encodes grey pictures, in which there is no face.
void encode_grey(fbs_encoder_settings settings) {
  settings.format.width = settings.format.height = 64;
  settings.allow_no_face = 1;
  settings.effort = 0;
  Encoder encoder(settings);
  const std::vector<std::uint8_t> grey(64 * 64, 90);
  const fbs_const_picture picture = {64, 64, {grey.data(), grey.data(), grey.data()}, {64, 32, 32}};
  for (int n = 0; n < 5; ++n) encoder.push(picture);
  encoder.finish();
}

TEST(Log, TellsOfABitrateThatIsNotMet) {
  Log log;
  auto settings = Encoder::default_settings();
  log_to(settings, log);
  settings.bitrate = 4000;  // grey takes less
  encode_grey(settings);
  EXPECT_TRUE(log.has(FBS_LOG_WARNING, "target 4000.00 kbit/s not reachable")) << all(log);
  EXPECT_TRUE(log.has(FBS_LOG_INFO, "picture 0: a scene begins, without a face")) << all(log);
}

TEST(Wrappers, StampsComeBackWithPackets) {
  auto settings = Encoder::default_settings();
  settings.format.width = settings.format.height = 64;
  settings.allow_no_face = settings.live = 1;
  Encoder encoder(settings);
  const std::vector<std::uint8_t> grey(64 * 64, 90);
  const fbs_const_picture picture = {64, 64, {grey.data(), grey.data(), grey.data()}, {64, 32, 32}};
  encoder.push(picture, fbs_stamp{sizeof(fbs_stamp), 4711, 42, 0});
  ASSERT_TRUE(encoder.wait(std::chrono::minutes(10)));
  ASSERT_TRUE(encoder.pull());
  EXPECT_EQ(encoder.stamp().time, 4711);
  EXPECT_EQ(encoder.stamp().user, 42U);
  while (encoder.pull()) continue;
  EXPECT_FALSE(encoder.wait(std::chrono::hours(-1)));
}

/// Names of threads that have started.
struct Names {
  static void note(void* user, const char* name) {
    auto& self = *static_cast<Names*>(user);
    const std::lock_guard lock(self.mutex);
    self.names.emplace_back(name);
  }
  std::mutex mutex;
  std::vector<std::string> names;
};

TEST(ThreadStart, IsCalledOnceForEachThread) {
  Names names;
  auto settings = Decoder::default_settings();
  settings.threads = 3;
  settings.thread_start = &Names::note;
  settings.user = &names;
  {
    Decoder decoder(settings);
    decode(decoder, vector_bytes("talk.fbs"));
  }
  EXPECT_EQ(names.names, (std::vector<std::string>{"fbs-draw", "fbs-draw"}));

  names.names.clear();
  auto encoding = Encoder::default_settings();
  encoding.threads = 3;
  encoding.thread_start = &Names::note;
  encoding.user = &names;
  encode_grey(encoding);
  EXPECT_FALSE(names.names.empty());
  for (const std::string& name : names.names) EXPECT_EQ(name, "fbs-worker");
}

}  // namespace
}  // namespace fbs::api
