#include "cli/source_part.h"

namespace fbs::cli {

Result<std::optional<TimedPicture>> SourcePart::next() {
  if (ended_ || stop_.raised()) return std::nullopt;
  auto picture = source_->next();
  ended_ = !picture || !*picture;
  // A read that the signal interrupted fails. What it had read of a picture is lost.
  if (stop_.raised() && !picture) return std::nullopt;
  return picture;
}

}  // namespace fbs::cli
