#include "ros2/node/raw_type.hpp"

#include <dds/ddsi/ddsi_keyhash.h>
#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/q_radmin.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

namespace ros2 {
namespace {

// Of the operations below, those that read or write application samples are never called: samples are written
// by dds_writecdr and taken by dds_takecdr.

struct RawType : ddsi_sertype {};

struct RawSample : ddsi_serdata {
  RawSample(const ddsi_sertype* sample_type, ddsi_serdata_kind sample_kind) : ddsi_serdata{} {
    ddsi_serdata_init(this, sample_type, sample_kind);
  }
  Bytes bytes;  // a multiple of 4
};

const RawSample* raw(const ddsi_serdata* sample) {
  return static_cast<const RawSample*>(sample);
}

/// Padded to the multiple of 4 in which CycloneDDS sends.
ddsi_serdata* finished(std::unique_ptr<RawSample> sample) {
  sample->bytes.resize((sample->bytes.size() + 3) / 4 * 4);
  return sample.release();
}

// ---- samples

bool same_key(const ddsi_serdata* /*one*/, const ddsi_serdata* /*other*/) {
  return true;
}

std::uint32_t size_of(const ddsi_serdata* sample) {
  return static_cast<std::uint32_t>(raw(sample)->bytes.size());
}

/// Fragments follow each other, and may overlap.
ddsi_serdata* from_network(const ddsi_sertype* type, ddsi_serdata_kind kind, const nn_rdata* fragment,
                           size_t size) {
  auto sample = std::make_unique<RawSample>(type, kind);
  sample->bytes.reserve(size + 3);
  for (; fragment != nullptr; fragment = fragment->nextfrag) {
    const auto have = static_cast<std::uint32_t>(sample->bytes.size());
    if (fragment->maxp1 <= have) continue;
    const unsigned char* payload = NN_RMSG_PAYLOADOFF(fragment->rmsg, NN_RDATA_PAYLOAD_OFF(fragment));
    const unsigned char* first = payload + (have - fragment->min);
    sample->bytes.insert(sample->bytes.end(), first, first + (fragment->maxp1 - have));
  }
  return finished(std::move(sample));
}

ddsi_serdata* from_parts(const ddsi_sertype* type, ddsi_serdata_kind kind, ddsrt_msg_iovlen_t count,
                         const ddsrt_iovec_t* parts, size_t size) {
  auto sample = std::make_unique<RawSample>(type, kind);
  sample->bytes.reserve(size + 3);
  for (ddsrt_msg_iovlen_t i = 0; i < count; ++i) {
    const auto* first = static_cast<const std::uint8_t*>(parts[i].iov_base);
    sample->bytes.insert(sample->bytes.end(), first, first + parts[i].iov_len);
  }
  return finished(std::move(sample));
}

ddsi_serdata* from_key(const ddsi_sertype* type, const ddsi_keyhash* /*keyhash*/) {
  return new RawSample{type, SDK_KEY};
}

ddsi_serdata* from_sample(const ddsi_sertype* type, ddsi_serdata_kind kind, const void* bytes) {
  auto sample = std::make_unique<RawSample>(type, kind);
  if (kind == SDK_DATA) sample->bytes = *static_cast<const Bytes*>(bytes);
  return finished(std::move(sample));
}

void to_network(const ddsi_serdata* sample, size_t offset, size_t size, void* to) {
  std::memcpy(to, raw(sample)->bytes.data() + offset, size);
}

ddsi_serdata* lend(const ddsi_serdata* sample, size_t offset, size_t size, ddsrt_iovec_t* reference) {
  reference->iov_base = const_cast<std::uint8_t*>(raw(sample)->bytes.data() + offset);
  reference->iov_len = static_cast<ddsrt_iov_len_t>(size);
  return ddsi_serdata_ref(sample);
}

void give_back(ddsi_serdata* sample, const ddsrt_iovec_t* /*reference*/) {
  ddsi_serdata_unref(sample);
}

bool to_sample(const ddsi_serdata* sample, void* bytes, void** /*buffer*/, void* /*end*/) {
  *static_cast<Bytes*>(bytes) = raw(sample)->bytes;
  return true;
}

ddsi_serdata* to_untyped(const ddsi_serdata* sample) {
  return new RawSample{sample->type, SDK_KEY};
}

bool untyped_to_sample(const ddsi_sertype* /*type*/, const ddsi_serdata* /*sample*/, void* bytes,
                       void** /*buffer*/, void* /*end*/) {
  static_cast<Bytes*>(bytes)->clear();
  return true;
}

void free_sample(ddsi_serdata* sample) {
  delete static_cast<RawSample*>(sample);
}

size_t print(const ddsi_sertype* type, const ddsi_serdata* sample, char* text, size_t size) {
  const int count = std::snprintf(text, size, "%s, %u bytes", type->type_name, size_of(sample));
  return count < 0 ? 0 : static_cast<size_t>(count);
}

void no_keyhash(const ddsi_serdata* /*sample*/, ddsi_keyhash* keyhash, bool /*as_md5*/) {
  std::fill(std::begin(keyhash->value), std::end(keyhash->value), static_cast<unsigned char>(0));
}

ddsi_serdata_ops sample_operations() {
  ddsi_serdata_ops operations{};
  operations.eqkey = same_key;
  operations.get_size = size_of;
  operations.from_ser = from_network;
  operations.from_ser_iov = from_parts;
  operations.from_keyhash = from_key;
  operations.from_sample = from_sample;
  operations.to_ser = to_network;
  operations.to_ser_ref = lend;
  operations.to_ser_unref = give_back;
  operations.to_sample = to_sample;
  operations.to_untyped = to_untyped;
  operations.untyped_to_sample = untyped_to_sample;
  operations.free = free_sample;
  operations.print = print;
  operations.get_keyhash = no_keyhash;
  return operations;  // no shared memory
}

// ---- types

void free_type(ddsi_sertype* type) {
  ddsi_sertype_fini(type);
  delete static_cast<RawType*>(type);
}

void zero_samples(const ddsi_sertype* /*type*/, void* samples, size_t count) {
  std::for_each_n(static_cast<Bytes*>(samples), count, [](Bytes& bytes) { bytes.clear(); });
}

void realloc_samples(void** /*pointers*/, const ddsi_sertype* /*type*/, void* /*old*/, size_t /*old_count*/,
                     size_t /*count*/) {}

void free_samples(const ddsi_sertype* /*type*/, void** /*pointers*/, size_t /*count*/,
                  dds_free_op_t /*what*/) {}

/// Types of one name are the same.
bool same_type(const ddsi_sertype* /*one*/, const ddsi_sertype* /*other*/) {
  return true;
}

std::uint32_t type_hash(const ddsi_sertype* /*type*/) {
  return 0;
}

ddsi_sertype_ops type_operations() {
  ddsi_sertype_ops operations{};
  operations.version = ddsi_sertype_v0;
  operations.free = free_type;
  operations.zero_samples = zero_samples;
  operations.realloc_samples = realloc_samples;
  operations.free_samples = free_samples;
  operations.equal = same_type;
  operations.hash = type_hash;
  return operations;  // no type information in discovery, no shared memory
}

const ddsi_serdata_ops kSampleOperations = sample_operations();
const ddsi_sertype_ops kTypeOperations = type_operations();

}  // namespace

ddsi_sertype* new_raw_type(const std::string& type_name) {
  auto* type = new RawType{};
  ddsi_sertype_init(type, type_name.c_str(), &kTypeOperations, &kSampleOperations, true);
  type->allowed_data_representation = DDS_DATA_REPRESENTATION_FLAG_XCDR1;
  return type;
}

ddsi_serdata* new_raw_sample(const ddsi_sertype* type, Bytes bytes) {
  auto sample = std::make_unique<RawSample>(type, SDK_DATA);
  sample->bytes = std::move(bytes);
  return finished(std::move(sample));
}

ByteView bytes_of(const ddsi_serdata* sample) {
  return raw(sample)->bytes;
}

}  // namespace ros2
