#include "encoder/scene/scene_span.h"

#include <algorithm>
#include <utility>

#include "bitstream/payload/return_payload.h"
#include "bitstream/payload/setup_payload.h"

namespace fbs {
namespace {

/// The picture of the stream from which on a packet shows its scene; nothing if it is of no such type.
std::optional<std::uint64_t> begin_of(const TypedPayload& packet) {
  const auto& [type, payload] = packet;
  if (type == PacketType::kSetup) return decode_setup(payload)->before.pictures;
  if (type == PacketType::kReturn) return decode_return(payload)->before.pictures;
  return std::nullopt;
}

}  // namespace

Result<void> SceneSpan::begin(std::unique_ptr<SceneEncoder> scene, std::uint64_t picture) {
  if (open_.empty()) begin_ = picture;
  const auto left = leave(picture);
  if (!left) return fail(left.error());
  scene->ring(bell_);
  members_.push_back(std::make_unique<Member>(Member{std::move(scene), picture}));
  present_ = members_.back().get();
  present_->packets.feed(kSignature);
  visits_.push_back({present_, picture, *left});
  return {};
}

Result<bool> SceneSpan::return_to(const Picture& picture, const StreamPosition& at) {
  const auto found = std::find_if(open_.rbegin(), open_.rend(), [&](Member* member) {
    member->scene->cut();
    return member->scene->recognises(picture);
  });
  if (found == open_.rend()) return false;
  Member* const member = *found;
  open_.erase(std::next(found).base());
  const auto left = leave(at.pictures);
  if (!left) return fail(left.error());
  if (auto gone_on = member->scene->go_on(at); !gone_on) return fail(gone_on.error());
  present_ = member;
  visits_.push_back({member, at.pictures, *left});
  return true;
}

Result<SceneSpan::Member*> SceneSpan::leave(std::uint64_t picture) {
  if (present_ == nullptr) return nullptr;
  Member* const left = std::exchange(present_, nullptr);
  if (!left->scene->can_go_on() || ended_ == picture) {
    if (auto ended = end(*left); !ended) return fail(ended.error());
    return nullptr;
  }
  if (open_.size() == kKeptScenes) {
    if (auto ended = end(*open_.front()); !ended) return fail(ended.error());
    open_.pop_front();
  }
  open_.push_back(left);
  if (auto done = left->scene->leave(); !done) return fail(done.error());
  return left;
}

bool SceneSpan::has_ended(const Member& member) {
  return !member.scene || (member.ends && !member.scene->is_coding());
}

Result<void> SceneSpan::end(Member& member) {
  member.ends = true;
  ending_.push_back(&member);
  if (auto done = member.scene->finish(); !done) return done;
  return wait(together_ - 1);
}

Result<void> SceneSpan::wait(std::size_t ending) {
  while (ending_.size() > ending || (!ending_.empty() && has_ended(*ending_.front()))) {
    Member& member = *ending_.front();
    if (auto done = member.scene->wait(); !done) return done;
    member.packets.feed(member.scene->take());
    if (&member != present_) member.scene.reset();  // its patterns take much memory
    ending_.pop_front();
  }
  return {};
}

Result<void> SceneSpan::close() {
  for (Member* member : open_)
    if (auto ended = end(*member); !ended) return ended;
  open_.clear();
  return {};
}

Result<void> SceneSpan::end_span(std::uint64_t picture) {
  if (open_.empty() || picture - begin_ < most_) return wait(together_);
  if (auto closed = close(); !closed) return closed;
  ended_ = picture;
  return present_->scene->finish();
}

Result<void> SceneSpan::finish() {
  if (auto closed = close(); !closed) return closed;
  if (auto ended = end(*present_); !ended) return ended;
  return wait(0);
}

bool SceneSpan::returns(const Member* member) const {
  return std::ranges::find(open_, member) != open_.end() ||
         std::any_of(visits_.begin() + 1, visits_.end(),
                     [&](const Visit& later) { return later.shown == member; });
}

bool SceneSpan::read_next(Member& member) {
  if (member.next) return true;
  if (member.scene) member.packets.feed(member.scene->take());
  const auto read = member.packets.next();
  if (!read || read->status != ReadStatus::kPacket) return false;
  member.next.emplace(read->packet.type,
                      std::vector(read->packet.payload.begin(), read->packet.payload.end()));
  return true;
}

void SceneSpan::write_next(std::vector<std::uint8_t>& out) {
  const Visit& visit = visits_.front();
  Member& member = *visit.shown;
  auto& [type, payload] = *member.next;
  const bool aside = begin_of(*member.next) == visit.begin && visit.left != nullptr && returns(visit.left);
  if (type == PacketType::kSetup) {
    Setup setup = *decode_setup(payload);
    const bool keeps = std::ranges::any_of(members_, [&](const auto& other) {
      return other.get() != &member && other->begin < setup.before.pictures && returns(other.get());
    });
    setup.keeps = aside ? SceneKeeping::kAndPresent : keeps ? SceneKeeping::kAside : SceneKeeping::kNone;
    payload = *encode_setup(setup);
    member.in_head = true;
  } else if (type == PacketType::kReturn) {
    Return to = *decode_return(payload);
    to.scene = member.check;
    to.aside = aside;
    payload = encode_return(to);
  }
  const std::uint32_t check = writer_.write(out, type, payload);
  if (type == PacketType::kPattern && std::exchange(member.in_head, false)) member.check = check;
  member.next.reset();
}

std::vector<std::uint8_t> SceneSpan::take() {
  std::vector<std::uint8_t> out;
  while (!visits_.empty()) {
    Member& member = *visits_.front().shown;
    const bool last = visits_.size() == 1, all_ready = has_ended(member);
    while (read_next(member) && (last || begin_of(*member.next) < visits_[1].begin)) write_next(out);
    if (last || (!member.next && !all_ready)) break;
    visits_.pop_front();
  }
  std::erase_if(members_, [&](const auto& member) {
    return !member->scene && std::ranges::none_of(visits_, [&](const Visit& visit) {
      return visit.shown == member.get() || visit.left == member.get();
    });
  });
  return out;
}

bool SceneSpan::is_coding() const {
  return std::ranges::any_of(members_,
                             [](const auto& member) { return member->scene && member->scene->is_coding(); });
}

}  // namespace fbs
