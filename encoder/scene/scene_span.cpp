#include "encoder/scene/scene_span.h"

#include <algorithm>
#include <limits>
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
  const bool aside = can_return(picture);
  if (aside && open_.empty()) begin_ = picture;
  if (auto left = leave(aside); !left) return left;
  members_.push_back(std::make_unique<Member>(Member{std::move(scene)}));
  members_.back()->packets.feed(kSignature);
  return show(*members_.back(), {members_.back().get(), picture, false, aside});
}

Result<bool> SceneSpan::return_to(const Picture& picture, const StreamPosition& at) {
  const auto found = std::find_if(open_.rbegin(), open_.rend(), [&](Member* member) {
    member->scene->cut();
    return member->scene->recognises(picture);
  });
  if (found == open_.rend()) return false;
  Member& member = **found;
  open_.erase(std::next(found).base());
  const bool aside = can_return(at.pictures);
  if (auto left = leave(aside); !left) return fail(left.error());
  if (auto gone_on = member.scene->go_on(at); !gone_on) return fail(gone_on.error());
  if (auto shown = show(member, {&member, at.pictures, true, aside}); !shown) return fail(shown.error());
  return true;
}

bool SceneSpan::can_return(std::uint64_t picture) const {
  return present_ != nullptr && present_->scene->can_go_on() && ended_ != picture;
}

Result<void> SceneSpan::leave(bool aside) {
  if (present_ == nullptr) return {};
  if (!aside) return finish(*present_);
  open_.push_back(present_);
  if (open_.size() > kKeptScenes) {
    if (auto finished = finish(*open_.front()); !finished) return finished;
    open_.pop_front();
  }
  return present_->scene->leave();
}

Result<void> SceneSpan::show(Member& member, Visit visit) {
  present_ = &member;
  visits_.push_back(visit);
  return open_.empty() ? Result<void>{} : member.scene->set_keepings(keepings(false));
}

Result<void> SceneSpan::finish(Member& member) {
  member.finished = true;
  return member.scene->finish();
}

SceneKeepings SceneSpan::keepings(bool final) const {
  SceneKeepings out{begin_, final ? begin_ : std::numeric_limits<std::uint64_t>::max(), {}};
  for (auto v = visits_.begin(); v != visits_.end(); ++v) {
    if (final && v->returns) out.end = std::max(out.end, v->begin);
    const bool known = final && v != visits_.begin();
    const bool goes_on = !known || std::any_of(v, visits_.end(), [&](const Visit& later) {
      return later.shown == std::prev(v)->shown;
    });
    if (v->aside && goes_on) out.aside.push_back(v->begin);
  }
  return out;
}

Result<void> SceneSpan::close() {
  if (open_.empty()) return {};
  open_.push_back(present_);
  const SceneKeepings known = keepings(true);
  for (const Member* member : open_)
    if (auto set = member->scene->set_keepings(known); !set) return set;
  open_.pop_back();
  for (Member* member : open_)
    if (auto finished = finish(*member); !finished) return finished;
  open_.clear();
  return {};
}

Result<void> SceneSpan::end_span(std::uint64_t picture) {
  if (open_.empty() || picture - begin_ < most_) return {};
  if (auto closed = close(); !closed) return closed;
  ended_ = picture;
  return present_->scene->request_scene();
}

Result<void> SceneSpan::finish() {
  if (auto closed = close(); !closed) return closed;
  return finish(*present_);
}

bool SceneSpan::read_next(Member& member) {
  if (member.next) return true;
  member.packets.feed(member.scene->take());
  const auto read = member.packets.next();
  if (!read || read->status != ReadStatus::kPacket) return false;
  member.next.emplace(read->packet.type,
                      std::vector(read->packet.payload.begin(), read->packet.payload.end()));
  return true;
}

std::vector<std::uint8_t> SceneSpan::take() {
  std::vector<std::uint8_t> out;
  while (!visits_.empty()) {
    Member& member = *visits_.front().shown;
    const bool last = visits_.size() == 1;
    const auto is_later = [&] { return !last && begin_of(*member.next) >= visits_[1].begin; };
    while (read_next(member) && !is_later()) {
      const auto& [type, payload] = *member.next;
      writer_.write(out, type, payload);
      member.next.reset();
    }
    if (last || (!member.next && !member.finished)) break;
    visits_.pop_front();
    const auto shows = [&](const Visit& visit) { return visit.shown == &member; };
    if (member.finished && std::ranges::none_of(visits_, shows))
      std::erase_if(members_, [&](const auto& m) { return m.get() == &member; });
  }
  return out;
}

bool SceneSpan::is_coding() const {
  return std::ranges::any_of(members_, [](const auto& member) { return member->scene->is_coding(); });
}

}  // namespace fbs
