#include "ros2/messages/cdr.hpp"

namespace ros2 {
namespace {

constexpr std::size_t kHeader = 4;  // [bytes] of the encapsulation: representation (big endian), options
#if __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__
constexpr std::uint8_t kOwnOrder = 1;
#else
constexpr std::uint8_t kOwnOrder = 0;
#endif

/// Bytes to skip before a value of this size; alignment counts from after the header, whose 4 bytes shift it.
std::size_t padding(std::size_t at, std::size_t size) {
  return (size - (at - kHeader) % size) % size;
}

}  // namespace

CdrWriter::CdrWriter() : bytes_{0, kOwnOrder, 0, 0} {}

void CdrWriter::append(const void* values, std::size_t size, std::size_t count) {
  if (count == 0) return;
  bytes_.resize(bytes_.size() + padding(bytes_.size(), size));
  const auto* first = static_cast<const std::uint8_t*>(values);
  bytes_.insert(bytes_.end(), first, first + size * count);
}

void CdrWriter::write(const std::string& text) {
  write(static_cast<std::uint32_t>(text.size() + 1));
  append(text.c_str(), 1, text.size() + 1);
}

void CdrWriter::write(const std::vector<bool>& values) {
  write(static_cast<std::uint32_t>(values.size()));
  for (const bool value : values) write(value);
}

Bytes CdrWriter::take() {
  bytes_.resize(bytes_.size() + padding(bytes_.size(), 4));
  return std::move(bytes_);
}

CdrReader::CdrReader(ByteView bytes) : bytes_{bytes}, at_{kHeader} {
  if (bytes.size < kHeader) {
    at_ = bytes.size;
    fault_ = std::to_string(bytes.size) + " bytes, which is less than a header";
  } else if (bytes.data[0] != 0 || bytes.data[1] > 1) {
    fault_ = "encapsulation " + std::to_string(bytes.data[0] * 256 + bytes.data[1]) +
             " is not plain CDR, which is 0 or 1";
  } else {
    swapped_ = bytes.data[1] != kOwnOrder;
  }
}

bool CdrReader::fits(std::size_t count, std::size_t size) {
  if (!well()) return false;
  if (count <= rest() / size) return true;
  fault_ = std::to_string(count) + " elements of " + std::to_string(size) + " bytes do not fit into the " +
           std::to_string(rest()) + " that are left";
  return false;
}

void CdrReader::take(void* values, std::size_t size, std::size_t count) {
  if (!well() || count == 0) return;
  at_ += std::min(padding(at_, size), rest());
  if (!fits(count, size)) return;
  auto* to = static_cast<std::uint8_t*>(values);
  std::memcpy(to, bytes_.data + at_, size * count);
  at_ += size * count;
  if (swapped_ && size > 1)
    for (std::size_t i = 0; i < count; ++i) std::reverse(to + i * size, to + (i + 1) * size);
}

/// At least one byte stands for each element.
std::size_t CdrReader::length(const char* of_what) {
  std::uint32_t count = 0;
  take(&count, sizeof count, 1);
  if (!well()) return 0;
  if (count <= rest()) return count;
  fault_ = std::to_string(count) + " " + of_what + " do not fit into " + std::to_string(rest()) + " bytes";
  return 0;
}

void CdrReader::read(std::string& text) {
  const std::size_t count = length("characters");
  if (!well()) return;
  if (count == 0 || bytes_.data[at_ + count - 1] != 0) {
    fault_ = "a string without its final NUL";
    return;
  }
  text.assign(reinterpret_cast<const char*>(bytes_.data + at_), count - 1);
  at_ += count;
}

void CdrReader::read(std::vector<bool>& values) {
  const std::size_t count = length("elements");
  values.clear();
  for (std::size_t i = 0; i < count && well(); ++i) {
    bool value = false;
    read(value);
    values.push_back(value);
  }
}

/// The innermost field names itself first, those around it before it.
void CdrReader::name_fault(const char* name) {
  where_ = where_.empty() ? name : name + ("." + where_);
}

}  // namespace ros2
