// Messages to bytes and back: plain CDR (XCDR1) as ROS 2 sends it. Encapsulation header of 4 bytes, then the
// fields in order, each aligned to its size (at most 8), counted from after the header; strings and sequences
// begin with their length (uint32), strings end with a NUL that counts. Source: DDSI-RTPS 2.2, section 10;
// OMG CDR.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

namespace ros2 {

/// A serialised message with its encapsulation header, padded with zeros to a multiple of 4.
using Bytes = std::vector<std::uint8_t>;

/// Bytes that belong to somebody else.
struct ByteView {
  const std::uint8_t* data = nullptr;
  std::size_t size = 0;

  ByteView() = default;
  ByteView(const std::uint8_t* first, std::size_t count) : data{first}, size{count} {}
  ByteView(const Bytes& bytes) : data{bytes.data()}, size{bytes.size()} {}  // NOLINT: a view, as of a string
};

/// What stands before the message in a request and a reply of a service.
struct ServiceHeader {
  std::uint64_t client = 0;   ///< opaque to the server, which returns it
  std::int64_t sequence = 0;  ///< of the request

  template <class Self, class Visitor>
  static void visit_fields(Self& self, Visitor& visit) {
    visit("client", self.client);
    visit("sequence", self.sequence);
  }
};

/// Appends fields; a visitor for `visit_fields`.
class CdrWriter {
 public:
  CdrWriter();

  template <class Value>
  void operator()(const char* /*name*/, const Value& value) {
    write(value);
  }
  template <class Value>
  void write(const Value& value) {
    if constexpr (std::is_arithmetic_v<Value>) {
      append(&value, sizeof value, 1);
    } else {
      Value::visit_fields(value, *this);
    }
  }
  void write(const std::string& text);
  void write(const std::vector<bool>& values);
  template <class Value, std::size_t N>
  void write(const std::array<Value, N>& values) {
    write_all(values.data(), N);
  }
  template <class Value>
  void write(const std::vector<Value>& values) {
    write(static_cast<std::uint32_t>(values.size()));
    write_all(values.data(), values.size());
  }

  /// Ends the message.
  [[nodiscard]] Bytes take();

 private:
  template <class Value>
  void write_all(const Value* values, std::size_t count) {
    if constexpr (std::is_arithmetic_v<Value>) {
      append(values, sizeof(Value), count);
    } else {
      for (std::size_t i = 0; i < count; ++i) write(values[i]);
    }
  }
  /// Of `size` bytes each, which is their alignment too.
  void append(const void* values, std::size_t size, std::size_t count);

  Bytes bytes_;
};

/// Takes fields from bytes that anybody may have sent; a visitor for `visit_fields`. After the first thing
/// that does not fit, everything else is left as it was. Memory is only taken for what is really there.
class CdrReader {
 public:
  explicit CdrReader(ByteView bytes);

  template <class Value>
  void operator()(const char* name, Value& value) {
    if (!well()) return;
    read(value);
    if (!well()) name_fault(name);
  }
  template <class Value>
  void read(Value& value) {
    if constexpr (std::is_same_v<Value, bool>) {
      std::uint8_t byte = 0;
      take(&byte, 1, 1);
      value = byte != 0;
    } else if constexpr (std::is_arithmetic_v<Value>) {
      take(&value, sizeof value, 1);
    } else {
      if (well()) Value::visit_fields(value, *this);
    }
  }
  void read(std::string& text);
  void read(std::vector<bool>& values);
  template <class Value, std::size_t N>
  void read(std::array<Value, N>& values) {
    read_all(values.data(), N);
  }
  template <class Value>
  void read(std::vector<Value>& values) {
    const std::size_t count = length("elements");
    if constexpr (std::is_arithmetic_v<Value>) {
      if (!fits(count, sizeof(Value))) return;
      values.resize(count);
      read_all(values.data(), count);
    } else {
      // Elements are read before there is room for the next, so that a length alone takes no memory.
      values.clear();
      for (std::size_t i = 0; i < count && well(); ++i) read(values.emplace_back());
    }
  }

  [[nodiscard]] bool well() const { return fault_.empty(); }
  /// "status.values: 9 elements do not fit into 4 bytes"; empty when all is well.
  [[nodiscard]] std::string fault() const { return where_.empty() ? fault_ : where_ + ": " + fault_; }

 private:
  template <class Value>
  void read_all(Value* values, std::size_t count) {
    if constexpr (std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>) {
      take(values, sizeof(Value), count);
    } else {
      for (std::size_t i = 0; i < count && well(); ++i) read(values[i]);
    }
  }
  [[nodiscard]] std::size_t length(const char* of_what);
  [[nodiscard]] bool fits(std::size_t count, std::size_t size);
  void take(void* values, std::size_t size, std::size_t count);
  void name_fault(const char* name);
  [[nodiscard]] std::size_t rest() const { return bytes_.size - at_; }

  ByteView bytes_;
  std::size_t at_ = 0;    // of the next byte
  bool swapped_ = false;  // the sender's byte order is the other one
  std::string fault_;
  std::string where_;  // names of the fields, outermost first
};

template <class Message>
[[nodiscard]] Bytes to_cdr(const Message& message) {
  CdrWriter writer;
  writer.write(message);
  return writer.take();
}

/// False, with the reason in `fault`, when the bytes are no such message. More bytes than it takes are
/// allowed: senders pad.
template <class Message>
[[nodiscard]] bool from_cdr(ByteView bytes, Message& message, std::string& fault) {
  CdrReader reader{bytes};
  reader.read(message);
  fault = reader.fault();
  return reader.well();
}

/// Of a service: the header, then the request or reply, in one stream.
template <class Message>
[[nodiscard]] Bytes to_cdr(const ServiceHeader& header, const Message& message) {
  CdrWriter writer;
  writer.write(header);
  writer.write(message);
  return writer.take();
}

template <class Message>
[[nodiscard]] bool from_cdr(ByteView bytes, ServiceHeader& header, Message& message, std::string& fault) {
  CdrReader reader{bytes};
  reader.read(header);
  reader.read(message);
  fault = reader.fault();
  return reader.well();
}

}  // namespace ros2
