// lossy_link: a live stream over a link that loses packets, through the real decoder. What does a viewer see?
//
//   lossy_link STREAM.fbs SOURCE [--loss 10] [--burst 0] [--round-trip 0] [--wait 0.2] [--copies 0]
//              [--heads 0] [--from 0] [--seeds 5] [--worst FILE.pgm]
//
//   --loss        percent of packets
//   --burst       s: losses come in runs of this mean length; 0: each by itself
//   --round-trip  s: what is lost is asked for and sent again, as often as needed; 0: never
//   --wait        s that the receiver shows pictures later, and so waits for packets that are missing
//   --worst       PGM file: source, whole stream and what was shown, where the face was worst
//   --copies      each packet is sent again so many times, one group later each
//   --heads       1: heads of scenes behind the first are lost with any of their packets of 1200 bytes
//   --from        s: the viewer comes then, and knows nothing; counts from the first picture that is shown
//
// A packet of the link is a group's motion, pattern and blend, and before them a group that is sent again.
// Without --heads the head of a scene is not lost, as it would be sent until it is confirmed. A picture is
// due when its group and `wait` have passed; it is frozen if it has not been released by then, and right if
// its luma equals the whole stream's. Prints one line of JSON.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "bitstream/packet.h"
#include "cli/video/open/open_video.h"
#include "decoder/stream/packet_times.h"
#include "decoder/stream/stream_decoder.h"

namespace {

using namespace fbs;
using Bytes = std::vector<std::uint8_t>;

struct Options {
  double loss = 0.1, burst = 0, round_trip = 0, wait = 0.2, from = 0;
  int copies = 0, seeds = 5;
  bool heads = false;
  std::string worst;
};

struct Box {
  int left, top, right, bottom;
};

/// What one packet of the link carries.
struct Unit {
  Bytes head;             // of a scene
  Bytes bytes;            // motion, patterns and blends
  double begin = 0;       // s, of its first picture
  double end = 0;         // s, behind its last
  std::size_t first = 0;  // picture of the stream
};

[[noreturn]] void give_up(const std::string& text) {
  std::fprintf(stderr, "lossy_link: %s\n", text.c_str());
  std::exit(1);
}

double seconds(std::uint64_t time) {
  return static_cast<double>(time) / kTicksPerSecond;
}

std::vector<Unit> units_of(const Bytes& stream) {
  PacketReader reader(stream);
  PacketTimes times;
  std::vector<Unit> units;
  bool in_head = false, repeats = false;  // a group that has come goes with the next
  Bytes head(kSignature.begin(), kSignature.end());
  for (;;) {
    const auto read = reader.next();
    if (!read) give_up(read.error().text);
    if (read->status != ReadStatus::kPacket) break;
    const auto packet = std::span(stream).subspan(read->packet.offset, read->packet.size);
    const auto timed = times.take(read->packet);
    if (!timed) give_up(timed.error().text);
    if (read->packet.type == PacketType::kSetup) in_head = true;
    if (read->packet.type == PacketType::kMotion || read->packet.type == PacketType::kUnit) {
      if (!std::exchange(repeats, !timed->time)) units.push_back({std::move(head), {}});
      head.clear();
      in_head = false;
      units.back().begin = seconds(timed->first.time);
      units.back().first = timed->first.pictures;
    }
    if (read->packet.type == PacketType::kEnd) break;
    Bytes& to = in_head || units.empty() ? head : units.back().bytes;
    to.insert(to.end(), packet.begin(), packet.end());
    if (!units.empty()) units.back().end = seconds(times.released().time);
  }
  return units;
}

double psnr(const Plane& a, const Plane& b, const Box& box) {
  double sum = 0;
  for (int y = box.top; y < box.bottom; ++y)
    for (int x = box.left; x < box.right; ++x) {
      const int d = a.row(y)[x] - b.row(y)[x];
      sum += d * d;
    }
  const double mse = sum / ((box.right - box.left) * (box.bottom - box.top));
  return mse <= 0 ? 60 : std::min(60.0, 10 * std::log10(65025 / mse));
}

struct Reference {
  Plane luma;  // of the whole stream
  Box face{};
  double frame_db = 0, face_db = 0;
};

Box face_of(const StreamDecoder& decoder, int width, int height) {
  Box box{width, height, 0, 0};
  if (!decoder.scene().geometry) return {0, 0, width, height};
  for (const auto& v : decoder.scene().geometry->project_vertices(decoder.state()))
    box = {std::min(box.left, v.x / 64), std::min(box.top, v.y / 64), std::max(box.right, v.x / 64 + 1),
           std::max(box.bottom, v.y / 64 + 1)};
  return {std::clamp(box.left, 0, width - 8), std::clamp(box.top, 0, height - 8),
          std::clamp(box.right, 8, width), std::clamp(box.bottom, 8, height)};
}

struct Sums {
  double pictures = 0, right = 0, current = 0, within = 0, frame = 0, face = 0, longest = 0, worst = 0;
  std::vector<double> joined;  // s from Options::from to the first picture, for each seed that saw one
  std::size_t worst_picture = 0;
  Plane worst_shown;
};

class Link {
 public:
  Link(const Bytes& stream, const std::string& source) : units_(units_of(stream)) {
    auto video = open_video_source(source, {});
    if (!video) give_up(video.error().text);
    while (auto picture = (*video)->next()) {
      if (!*picture) break;
      source_.push_back(std::move((*picture)->picture.y));
    }
    StreamDecoder decoder;
    decoder.feed(stream);
    decoder.close();
    Picture picture;
    for (;;) {
      const auto status = decoder.next();
      if (!status) give_up(status.error().text);
      if (*status != DecodeStatus::kPicture) break;
      if (!decoder.render(picture)) give_up("cannot draw");
      const std::size_t n = references_.size();
      if (n >= source_.size()) break;
      const int w = picture.width(), h = picture.height();
      Reference r{picture.y, face_of(decoder, w, h), 0, 0};
      r.frame_db = psnr(r.luma, source_[n], {0, 0, w, h});
      r.face_db = psnr(r.luma, source_[n], r.face);
      references_.push_back(std::move(r));
      times_.push_back(seconds(decoder.position().time));
    }
  }

  void run(const Options& options, unsigned seed, Sums& sums) const {
    const std::vector<double> arrived = arrivals(options, seed);
    std::vector<std::pair<double, std::size_t>> order;
    for (std::size_t k = 0; k < units_.size(); ++k)
      if (arrived[k] < kNever && units_[k].begin >= options.from) order.push_back({arrived[k], k});
    std::stable_sort(order.begin(), order.end());
    StreamDecoder decoder;
    Picture picture;
    Plane shown;
    std::size_t next = 0;  // picture to be shown
    double frozen_since = -1;
    bool joined = false;
    std::map<std::size_t, Plane> waiting;  // released before they are due
    const auto take_pictures = [&] {
      for (;;) {
        const auto status = decoder.next();
        if (!status) continue;
        if (*status != DecodeStatus::kPicture) break;
        if (!decoder.render(picture)) give_up("cannot draw");
        const auto n = static_cast<std::size_t>(decoder.position().pictures);
        if (n >= next)
          waiting[n] = picture.y;
        else if (n + 1 == next)
          shown = picture.y;  // late, but nearer than what is shown
      }
    };
    const auto show_until = [&](double now) {
      for (; next < references_.size() && due(next, options) < now; ++next) {
        while (!waiting.contains(next) && decoder.skip_missing()) take_pictures();
        const auto released = waiting.find(next);
        const bool current = released != waiting.end();
        if (current) shown = std::move(released->second);
        waiting.erase(waiting.begin(), waiting.upper_bound(next));
        if (options.from > 0 && shown.samples.empty()) continue;  // has not joined yet
        if (options.from > 0 && !joined) sums.joined.push_back(times_[next] - options.from);
        joined = true;
        count(next, current, shown, sums);
        if (!current && frozen_since < 0) frozen_since = due(next, options);
        if (current && frozen_since >= 0) {
          sums.longest = std::max(sums.longest, due(next, options) - frozen_since);
          frozen_since = -1;
        }
      }
    };
    std::mt19937 random(seed + 1000);
    std::uniform_real_distribution<double> uniform(0, 1);
    for (const auto& [time, k] : order) {
      show_until(time);
      Bytes bytes = units_[k].head;
      if (options.heads && k > 0)
        for (std::size_t sent = 0; sent < units_[k].head.size(); sent += 1200)
          if (uniform(random) < options.loss) bytes.clear();
      bytes.insert(bytes.end(), units_[k].bytes.begin(), units_[k].bytes.end());
      decoder.feed_packet(k, bytes);
      take_pictures();
    }
    show_until(kNever);
  }

  /// The worst picture that was current: source, the whole stream's and what was shown, side by side, as PGM.
  void write_worst(const Sums& sums, const std::string& path) const {
    if (sums.worst_shown.samples.empty()) return;
    const std::array planes = {&source_[sums.worst_picture], &references_[sums.worst_picture].luma,
                               &sums.worst_shown};
    std::ofstream out(path, std::ios::binary);
    out << "P5 " << 3 * sums.worst_shown.width << ' ' << sums.worst_shown.height << " 255\n";
    for (int y = 0; y < sums.worst_shown.height; ++y)
      for (const Plane* plane : planes)
        out.write(reinterpret_cast<const char*>(plane->row(y)), sums.worst_shown.width);
  }

 private:
  static constexpr double kNever = 1e9, kOneWay = 0.05;

  /// When a picture is to be shown: all of a unit wait for the last of it to be coded.
  [[nodiscard]] double due(std::size_t picture, const Options& options) const {
    return times_[picture] + group_ + kOneWay + options.wait;
  }

  /// When each unit arrives.
  [[nodiscard]] std::vector<double> arrivals(const Options& o, unsigned seed) const {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(0, 1);
    const double leave = o.burst > 0 ? std::min(1.0, group_ / o.burst) : 1;
    const double enter = o.burst > 0 ? leave * o.loss / (1 - o.loss) : o.loss;
    bool bad = false;
    std::vector<bool> lost;
    for (std::size_t k = 0; k < units_.size(); ++k) {
      if (o.burst > 0)
        bad = bad ? uniform(random) >= leave : uniform(random) < enter;
      else
        bad = uniform(random) < o.loss;
      lost.push_back(bad && units_[k].head.empty());
    }
    std::vector<double> arrived;
    for (std::size_t k = 0; k < units_.size(); ++k) {
      double arrives = lost[k] ? kNever : units_[k].end + kOneWay;
      for (int c = 1; c <= o.copies && k + c < units_.size(); ++c)
        if (!lost[k + c]) arrives = std::min(arrives, units_[k + c].end + kOneWay);
      if (o.round_trip > 0 && arrives >= kNever) {
        // Noticed when the next one comes, and asked for until it is there.
        arrives = units_[k].end + kOneWay + group_;
        do arrives += o.round_trip;
        while (uniform(random) < o.loss);
      }
      arrived.push_back(arrives);
    }
    return arrived;
  }

  void count(std::size_t n, bool current, const Plane& shown, Sums& sums) const {
    const Reference& r = references_[n];
    ++sums.pictures;
    if (shown.samples.empty()) return;
    const bool right = current && shown.samples == r.luma.samples;
    double frame = 0, face = 0;
    if (!right) {
      frame = psnr(shown, source_[n], {0, 0, shown.width, shown.height}) - r.frame_db;
      face = psnr(shown, source_[n], r.face) - r.face_db;
    }
    sums.right += right;
    sums.current += current;
    sums.within += frame >= -1 && face >= -1;
    sums.frame += frame;
    sums.face += face;
    if (current && face < sums.worst) {
      sums.worst = face;
      sums.worst_picture = n;
      sums.worst_shown = shown;
    }
  }

  std::vector<Unit> units_;
  std::vector<Plane> source_;
  std::vector<Reference> references_;
  std::vector<double> times_;  // s
  double group_ = units_.size() > 2 ? units_[2].end - units_[2].begin : 0.2;
};

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3)
    give_up(
        "usage: lossy_link STREAM.fbs SOURCE [--loss %] [--burst s] [--round-trip s] [--wait s] [--copies n]"
        " [--heads 0|1] [--from s] [--seeds n] [--worst FILE.pgm]");
  Options options;
  for (int i = 3; i + 1 < argc; i += 2) {
    const std::string name = argv[i];
    const double value = std::atof(argv[i + 1]);
    if (name == "--loss")
      options.loss = value / 100;
    else if (name == "--burst")
      options.burst = value;
    else if (name == "--round-trip")
      options.round_trip = value;
    else if (name == "--wait")
      options.wait = value;
    else if (name == "--copies")
      options.copies = static_cast<int>(value);
    else if (name == "--heads")
      options.heads = value != 0;
    else if (name == "--from")
      options.from = value;
    else if (name == "--seeds")
      options.seeds = static_cast<int>(value);
    else if (name == "--worst")
      options.worst = argv[i + 1];
    else
      give_up("unknown option " + name);
  }
  std::ifstream file(argv[1], std::ios::binary);
  const Bytes stream{std::istreambuf_iterator<char>(file), {}};
  const Link link(stream, argv[2]);
  Sums s;
  for (int seed = 1; seed <= options.seeds; ++seed) link.run(options, static_cast<unsigned>(seed), s);
  if (!options.worst.empty()) link.write_worst(s, options.worst);
  std::printf(
      "{\"pictures\": %.0f, \"right\": %.4f, \"current\": %.4f, \"within\": %.4f, \"frame\": %.3f, \"face\": "
      "%.3f, "
      "\"longest\": %.2f, \"worst\": %.2f",
      s.pictures, s.right / s.pictures, s.current / s.pictures, s.within / s.pictures, s.frame / s.pictures,
      s.face / s.pictures, s.longest, s.worst);
  if (options.from > 0) {
    std::sort(s.joined.begin(), s.joined.end());
    const std::size_t n = s.joined.size();
    std::printf(", \"joined\": %zu, \"median_s\": %.2f, \"longest_s\": %.2f", n, n > 0 ? s.joined[n / 2] : 0,
                n > 0 ? s.joined.back() : 0);
  }
  std::printf("}\n");
}
