// The files of this folder that make up a report, embedded by embed_text.cmake. Places to fill in look like
// {{this}}.
#pragma once

#include <string_view>

namespace fbs::cli {

[[nodiscard]] std::string_view report_html();  ///< the page
[[nodiscard]] std::string_view clip_html();    ///< one clip in it
[[nodiscard]] std::string_view report_css();
[[nodiscard]] std::string_view legend_html();  ///< how to read the report

}  // namespace fbs::cli
