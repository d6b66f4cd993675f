// Files as bytes, when they are regular and not too large.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace spf {

struct FileBytes {
  std::optional<std::string> bytes;  ///< none when the file cannot be read
  std::string why;  ///< then: "is no file: there is none of that name", "is larger than 128 MiB"
};

[[nodiscard]] FileBytes read_file_bytes(const std::string& path, std::uintmax_t most_bytes);

}  // namespace spf
