// Text made safe for HTML and SVG.
#pragma once

#include <string>
#include <string_view>

namespace spf {

/// For element content and quoted attributes: & < > " ' are spelled out; control characters that XML forbids
/// are left out.
[[nodiscard]] std::string escape_html(std::string_view text);

}  // namespace spf
