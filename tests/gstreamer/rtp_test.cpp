#include <fbs/packet.h>
#include <gst/rtp/gstrtpbuffer.h>
#include <gtest/gtest.h>

#include <random>

#include "tests/gstreamer/stream.h"

namespace fbs::gstreamer {
namespace {

constexpr const char* kRtpCaps =
    "application/x-rtp, media=video, clock-rate=90000, encoding-name=FBS, payload=96";

/// The RTP packets of groups.
std::vector<Buffer> paid(const std::vector<Buffer>& groups, int mtu) {
  const Harness harness = group_harness("rtpfbspay mtu=" + std::to_string(mtu));
  for (const Buffer& group : groups) push(harness.get(), copy_of(group));
  return finish(harness.get());
}

Harness depayloader(const std::string& line = "rtpfbsdepay") {
  Harness harness(gst_harness_new_parse(line.c_str()));
  gst_harness_set_src_caps_str(harness.get(), kRtpCaps);
  return harness;
}

bool has_marker(const Buffer& packet) {
  GstRTPBuffer rtp = GST_RTP_BUFFER_INIT;
  gst_rtp_buffer_map(packet.get(), GST_MAP_READ, &rtp);
  const bool marker = gst_rtp_buffer_get_marker(&rtp) != FALSE;
  gst_rtp_buffer_unmap(&rtp);
  return marker;
}

TEST(RtpFbs, WhatIsPaidComesOutAgain) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  for (const int mtu : {28, 100, 1400}) {
    const Harness harness = depayloader();
    for (Buffer& packet : paid(groups, mtu)) push(harness.get(), std::move(packet));
    const std::vector<Buffer> out = finish(harness.get());
    ASSERT_EQ(out.size(), groups.size()) << mtu;
    for (std::size_t k = 0; k < out.size(); ++k) {
      EXPECT_EQ(bytes_of(out[k].get()), bytes_of(groups[k].get())) << k;
      EXPECT_EQ(is_key(out[k]), is_key(groups[k])) << k;
      EXPECT_EQ(GST_BUFFER_PTS(out[k].get()), GST_BUFFER_PTS(groups[k].get())) << k;
    }
  }
}

TEST(RtpFbs, NoPacketIsLargerThanTheMtuAndTheLastOfAGroupIsMarked) {
  const std::vector<Buffer> groups = encoded(kPictures);
  std::size_t marked = 0;
  for (const Buffer& packet : paid(groups, 100)) {
    EXPECT_LE(gst_buffer_get_size(packet.get()), 100U);
    marked += has_marker(packet) ? 1U : 0U;
  }
  EXPECT_EQ(marked, groups.size());
}

/// The output when one RTP packet is lost.
std::vector<Buffer> without(GstHarness* depay, const std::vector<Buffer>& groups, std::size_t lost) {
  std::vector<Buffer> packets = paid(groups, 100);
  for (std::size_t k = 0; k < packets.size(); ++k)
    if (k != lost) push(depay, std::move(packets[k]));
  return finish(depay);
}

TEST(RtpFbs, AfterALossNothingComesUpToTheNextScene) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  const std::size_t count = paid(groups, 100).size();
  for (std::size_t lost = 0; lost < count; ++lost) {
    const Harness harness = depayloader();
    const std::vector<Buffer> out = without(harness.get(), groups, lost);
    // Whatever is lost, the output is whole: the library finds no damage except the missing packets.
    EXPECT_LT(out.size(), groups.size()) << lost;
    for (const Buffer& group : out)
      if (GST_BUFFER_IS_DISCONT(group.get())) {
        EXPECT_TRUE(is_key(group)) << lost;
      }
    EXPECT_LE(decoded(joined(out)).errors, 1) << lost;
  }
}

TEST(RtpFbs, GroupsThatStandAloneGoOnAfterALoss) {
  for (const char* settings : {"resilience=packet", "resilience=strong"}) {
    const std::vector<Buffer> groups = encoded(kPictures, {}, 1, settings);
    const std::size_t count = paid(groups, 100).size();
    std::size_t last_of_head = 0;
    for (const Buffer& packet : paid(groups, 100)) {
      if (has_marker(packet)) break;
      ++last_of_head;
    }
    for (std::size_t lost = last_of_head + 2; lost < count; ++lost) {
      const Harness harness = depayloader();
      const std::vector<Buffer> out = without(harness.get(), groups, lost);
      EXPECT_EQ(out.size(), groups.size() - 1) << settings << ' ' << lost;
      const Decoded shown = decoded(joined(out));
      EXPECT_LE(shown.errors, 1) << settings << ' ' << lost;
      EXPECT_GE(shown.pictures.size(), kPictures - 6U) << settings << ' ' << lost;
    }
  }
}

TEST(RtpFbs, ASceneThatIsLostWholeIsNoticed) {
  const std::vector<Buffer> groups = encoded(kPictures, {30}, 1, "resilience=packet");
  std::vector<Buffer> packets = paid(groups, 1 << 15);
  ASSERT_EQ(packets.size(), groups.size());
  const Harness harness = depayloader();
  std::size_t lost = 1;
  while (!is_key(groups[lost])) ++lost;
  for (std::size_t k = 0; k < packets.size(); ++k)
    if (k != lost) push(harness.get(), std::move(packets[k]));
  EXPECT_EQ(finish(harness.get()).size(), lost);
  EXPECT_GE(scene_requests(harness.get()), 1);
}

TEST(RtpFbs, AfterALossASceneIsAskedFor) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  const Harness asking = depayloader(), silent = depayloader("rtpfbsdepay request-keyframe=false");
  without(asking.get(), groups, 3);
  without(silent.get(), groups, 3);
  EXPECT_GE(scene_requests(asking.get()), 1);
  EXPECT_EQ(scene_requests(silent.get()), 0);
}

TEST(RtpFbs, ASceneIsAskedForAsSoonAsAPacketIsGivenUp) {
  const std::vector<Buffer> groups = encoded(20);
  std::vector<Buffer> packets = paid(groups, 1400);
  for (const bool may_be_parity : {false, true}) {
    const Harness harness = depayloader();
    for (std::size_t k = 0; k < 2; ++k) push(harness.get(), copy_of(packets[k]));
    gst_harness_push_event(
        harness.get(),
        gst_event_new_custom(
            GST_EVENT_CUSTOM_DOWNSTREAM,
            gst_structure_new("GstRTPPacketLost", "seqnum", G_TYPE_UINT, 2U, "timestamp", G_TYPE_UINT64,
                              guint64{GST_SECOND}, "duration", G_TYPE_UINT64, guint64{GST_SECOND} / 5,
                              "might-have-been-fec", G_TYPE_BOOLEAN, may_be_parity, nullptr)));
    EXPECT_EQ(scene_requests(harness.get()), may_be_parity ? 0 : 1);
    const std::size_t before = pull(harness.get()).size();
    push(harness.get(), copy_of(packets[2]));  // of no use after a loss
    EXPECT_EQ(pull(harness.get()).size(), may_be_parity ? 1U : 0U) << before;
  }
}

TEST(RtpFbs, ASceneThatMayWaitInTheJitterBufferIsNotAskedForAgain) {
  const std::vector<Buffer> groups = encoded(kPictures);
  const Harness close = depayloader(), behind = depayloader();
  gst_harness_set_upstream_latency(behind.get(), GST_SECOND);
  without(close.get(), groups, 3);
  without(behind.get(), groups, 3);
  EXPECT_GE(scene_requests(close.get()), 3);   // in 1.8 s, one each half second
  EXPECT_LE(scene_requests(behind.get()), 2);  // each second and a half
}

TEST(RtpFbs, AStreamIsJoinedAtASceneAndHasItsSignature) {
  const std::vector<Buffer> groups = encoded(kPictures, {30});
  std::vector<Buffer> packets = paid(groups, 1400);
  const Harness harness = depayloader();
  for (std::size_t k = 1; k < packets.size(); ++k) push(harness.get(), std::move(packets[k]));
  const Decoded pictures = decoded(joined(finish(harness.get())));
  EXPECT_EQ(pictures.errors, 0);
  EXPECT_EQ(pictures.pictures.size(), kPictures - scenes_of(groups).at(1));
}

TEST(RtpFbs, AStreamIsJoinedByThePartsOfItsHead) {
  const std::vector<Buffer> groups = encoded(kPictures, {}, 1, "resilience=strong join=1");
  std::vector<Buffer> packets = paid(groups, 1400);
  const Harness harness = depayloader();
  for (std::size_t k = 2; k < packets.size(); ++k) push(harness.get(), std::move(packets[k]));
  const std::vector<Buffer> out = finish(harness.get());
  ASSERT_FALSE(out.empty());
  EXPECT_TRUE(is_key(out.front()));
  const std::size_t pictures = decoded(joined(out)).pictures.size();
  EXPECT_GT(pictures, 0U);
  EXPECT_LT(pictures, kPictures);
}

TEST(RtpFbs, PayloadsOfNothingAreNoHarm) {
  const Harness harness = depayloader();
  for (const guint size : {0U, 1U, 2U}) {
    Buffer packet(gst_rtp_buffer_new_allocate(size, 0, 0));
    push(harness.get(), std::move(packet));
  }
  EXPECT_TRUE(finish(harness.get()).empty());
}

TEST(RtpFbs, RandomPayloadsAreNoHarm) {
  std::minstd_rand random(3);
  const Harness harness = depayloader("rtpfbsdepay ! fbsdec");
  for (guint16 number = 0; number < 2000; ++number) {
    const auto size = static_cast<guint>(random() % 40);
    Buffer packet(gst_rtp_buffer_new_allocate(size, 0, 0));
    GstRTPBuffer rtp = GST_RTP_BUFFER_INIT;
    gst_rtp_buffer_map(packet.get(), GST_MAP_WRITE, &rtp);
    gst_rtp_buffer_set_seq(&rtp, static_cast<guint16>(number + number / 50));  // some are lost
    gst_rtp_buffer_set_payload_type(&rtp, 96);
    gst_rtp_buffer_set_marker(&rtp, random() % 3 == 0);
    auto* const payload = static_cast<guint8*>(gst_rtp_buffer_get_payload(&rtp));
    for (guint k = 0; k < size; ++k) payload[k] = static_cast<guint8>(random() >> 8);
    if (size > 1) payload[1] = FBS_PACKET_SETUP;
    gst_rtp_buffer_unmap(&rtp);
    gst_harness_push(harness.get(), packet.release());
  }
  EXPECT_TRUE(finish(harness.get()).empty());
}

}  // namespace
}  // namespace fbs::gstreamer
