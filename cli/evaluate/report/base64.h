// Base64 (RFC 4648), for images inside a page.
#pragma once

#include <string>
#include <string_view>

namespace fbs::cli {

[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace fbs::cli
