#include "mcap/writer.hpp"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <stdexcept>

namespace spf::mcap {
namespace {

constexpr std::string_view kMagic{"\x89MCAP0\r\n", 8};

enum class Opcode : std::uint8_t {
  header = 0x01,
  footer = 0x02,
  schema = 0x03,
  channel = 0x04,
  message = 0x05,
  chunk = 0x06,
  message_index = 0x07,
  chunk_index = 0x08,
  statistics = 0x0B,
  summary_offset = 0x0E,
  data_end = 0x0F,
};

/// Fields of a record: numbers little-endian, texts and lists with their length in bytes.
class Fields {
 public:
  template <class Number>
  Fields& number(Number value) {
    for (std::size_t i = 0; i < sizeof value; ++i)
      bytes_.push_back(static_cast<char>(static_cast<std::uint64_t>(value) >> (8U * i)));
    return *this;
  }
  Fields& text(std::string_view value) {
    number(static_cast<std::uint32_t>(value.size()));
    bytes_.append(value);
    return *this;
  }
  Fields& raw(std::string_view value) {
    bytes_.append(value);
    return *this;
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

std::string record(Opcode opcode, const std::string& content) {
  return Fields{}
      .number(static_cast<std::uint8_t>(opcode))
      .number(static_cast<std::uint64_t>(content.size()))
      .raw(content)
      .bytes();
}

std::uint32_t checksum(std::string_view bytes, std::uint32_t before = 0) {
  return static_cast<std::uint32_t>(
      crc32_z(before, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()));
}

}  // namespace

void Writer::Times::add(std::uint64_t time, bool only) {
  first = only ? time : std::min(first, time);
  last = only ? time : std::max(last, time);
}

Writer::Writer(const std::string& path, const std::string& profile, std::size_t chunk_size)
    : path_{path}, file_{path, std::ios::binary | std::ios::trunc}, chunk_size_{chunk_size} {
  if (!file_) throw std::runtime_error{path + " cannot be written"};
  put(kMagic);
  put(record(Opcode::header, Fields{}.text(profile).text("spf").bytes()));
}

Writer::~Writer() {
  try {
    close();
  } catch (const std::exception&) {  // NOLINT: whoever wants to know calls close()
  }
}

void Writer::put(std::string_view bytes) {
  file_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  position_ += bytes.size();
}

Writer::Id Writer::add_schema(const Schema& schema) {
  const auto known = std::find(schema_names_.begin(), schema_names_.end(), schema.name);
  if (known != schema_names_.end()) return static_cast<Id>(known - schema_names_.begin() + 1);
  if (schemas_.size() == std::numeric_limits<Id>::max()) throw std::length_error{"too many schemas"};
  const Id id = static_cast<Id>(schemas_.size() + 1);
  schema_names_.push_back(schema.name);
  schemas_told_.push_back(false);
  schemas_.push_back(
      record(Opcode::schema,
             Fields{}.number(id).text(schema.name).text(schema.encoding).text(schema.definition).bytes()));
  return id;
}

Writer::Id Writer::add_channel(Id schema, const std::string& topic, const std::string& encoding) {
  if (channels_.size() == std::numeric_limits<Id>::max()) throw std::length_error{"too many channels"};
  const Id id = static_cast<Id>(channels_.size() + 1);
  Channel& channel = channels_.emplace_back();
  channel.schema = schema;
  const std::uint32_t no_metadata = 0;
  channel.record =
      record(Opcode::channel,
             Fields{}.number(id).number(schema).text(topic).text(encoding).number(no_metadata).bytes());
  return id;
}

void Writer::write(Id id, std::uint64_t time, std::string_view message) {
  Channel& channel = channels_.at(static_cast<std::size_t>(id) - 1);
  if (!channel.told) {
    const std::size_t schema = static_cast<std::size_t>(channel.schema) - 1;
    if (!schemas_told_.at(schema)) chunk_.records += schemas_[schema];
    schemas_told_[schema] = channel.told = true;
    chunk_.records += channel.record;
  }
  chunk_.times.add(time, chunk_.index.empty());
  times_.add(time, messages_ == 0);
  chunk_.index[id].emplace_back(time, chunk_.records.size());
  chunk_.records +=
      record(Opcode::message,
             Fields{}.number(id).number(channel.sequence++).number(time).number(time).raw(message).bytes());
  ++channel.count;
  ++messages_;
  if (chunk_.records.size() >= chunk_size_) end_chunk();
}

void Writer::end_chunk() {
  if (chunk_.records.empty()) return;
  const std::uint64_t start = position_, size = chunk_.records.size();
  put(record(Opcode::chunk, Fields{}
                                .number(chunk_.times.first)
                                .number(chunk_.times.last)
                                .number(size)
                                .number(checksum(chunk_.records))
                                .text("")  // not compressed
                                .number(size)
                                .raw(chunk_.records)
                                .bytes()));
  const std::uint64_t length = position_ - start;
  Fields offsets;
  for (const auto& [channel, entries] : chunk_.index) {
    offsets.number(channel).number(position_);
    Fields pairs;
    for (const auto& [time, offset] : entries) pairs.number(time).number(static_cast<std::uint64_t>(offset));
    put(record(Opcode::message_index, Fields{}.number(channel).text(pairs.bytes()).bytes()));
  }
  chunk_indices_.push_back(record(Opcode::chunk_index, Fields{}
                                                           .number(chunk_.times.first)
                                                           .number(chunk_.times.last)
                                                           .number(start)
                                                           .number(length)
                                                           .text(offsets.bytes())
                                                           .number(position_ - start - length)
                                                           .text("")
                                                           .number(size)
                                                           .number(size)
                                                           .bytes()));
  chunk_.records.clear();
  chunk_.index.clear();
}

std::string Writer::statistics() const {
  Fields counts;
  for (std::size_t i = 0; i < channels_.size(); ++i)
    if (channels_[i].count > 0) counts.number(static_cast<Id>(i + 1)).number(channels_[i].count);
  const std::uint32_t none = 0;  // attachments, metadata
  return record(Opcode::statistics, Fields{}
                                        .number(messages_)
                                        .number(static_cast<std::uint16_t>(schemas_.size()))
                                        .number(static_cast<std::uint32_t>(channels_.size()))
                                        .number(none)
                                        .number(none)
                                        .number(static_cast<std::uint32_t>(chunk_indices_.size()))
                                        .number(times_.first)
                                        .number(times_.last)
                                        .text(counts.bytes())
                                        .bytes());
}

/// Groups of records, where each group begins, and a checksum over all.
void Writer::write_summary() {
  const std::uint64_t begin = position_;
  std::string summary, offsets;
  const auto group = [&](Opcode opcode, const std::string& records) {
    if (records.empty()) return;
    offsets += record(Opcode::summary_offset, Fields{}
                                                  .number(static_cast<std::uint8_t>(opcode))
                                                  .number(begin + summary.size())
                                                  .number(static_cast<std::uint64_t>(records.size()))
                                                  .bytes());
    summary += records;
  };
  std::string schemas, channels, chunks;
  for (const std::string& schema : schemas_) schemas += schema;
  for (const Channel& channel : channels_) channels += channel.record;
  for (const std::string& index : chunk_indices_) chunks += index;
  group(Opcode::schema, schemas);
  group(Opcode::channel, channels);
  group(Opcode::statistics, statistics());
  group(Opcode::chunk_index, chunks);
  const std::uint64_t offset_start = begin + summary.size();
  constexpr std::uint64_t kFooterLength = 8 + 8 + 4;
  const std::string footer = Fields{}
                                 .number(static_cast<std::uint8_t>(Opcode::footer))
                                 .number(kFooterLength)
                                 .number(begin)
                                 .number(offset_start)
                                 .bytes();
  const std::string all = summary + offsets + footer;
  put(all);
  put(Fields{}.number(checksum(all)).bytes());
}

void Writer::close() {
  if (closed_) return;
  closed_ = true;
  end_chunk();
  const std::uint32_t no_checksum = 0;
  put(record(Opcode::data_end, Fields{}.number(no_checksum).bytes()));
  write_summary();
  put(kMagic);
  file_.close();
  if (!file_) throw std::runtime_error{path_ + " could not be written"};
}

}  // namespace spf::mcap
