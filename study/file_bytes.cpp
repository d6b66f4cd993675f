#include "study/file_bytes.hpp"

#include <filesystem>
#include <fstream>
#include <system_error>

namespace spf {

FileBytes read_file_bytes(const std::string& path, std::uintmax_t most_bytes) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(path, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return {std::nullopt, "is no file: there is none of that name"};
  if (error) return {std::nullopt, "cannot be read: " + error.message()};
  if (!std::filesystem::is_regular_file(status)) return {std::nullopt, "is not a regular file"};
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (!error && size > most_bytes)
    return {std::nullopt, "is larger than " + std::to_string(most_bytes >> 20) + " MiB"};
  std::ifstream file{path, std::ios::binary};
  std::string bytes(error ? 0 : static_cast<std::size_t>(size), '\0');
  if (file) file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (error || !file) return {std::nullopt, "cannot be opened for reading"};
  return {std::move(bytes), ""};
}

}  // namespace spf
