// Checks that a text is well-formed UTF-8 without control characters.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>

namespace spf {

/// Offset of the first byte that is not part of well-formed UTF-8 (overlong forms and surrogates are not), or
/// that is a control character other than tab, line feed and carriage return. Empty when there is none.
[[nodiscard]] std::optional<std::size_t> first_bad_byte(std::string_view text);

}  // namespace spf
