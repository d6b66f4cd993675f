// CycloneDDS's view of a message: a type without key whose samples are bytes that it carries unread. Messages
// are made of the bytes and back by ros2/messages/cdr.hpp, so no type of CycloneDDS's own generator is
// needed.
#pragma once

#include <dds/dds.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <string>

#include "ros2/messages/cdr.hpp"

namespace ros2 {

/// A new type of this name, with one reference, which dds_create_topic_sertype takes over.
[[nodiscard]] ddsi_sertype* new_raw_type(const std::string& type_name);

/// A sample for dds_writecdr, which takes over its one reference. `type` is that of the topic.
[[nodiscard]] ddsi_serdata* new_raw_sample(const ddsi_sertype* type, Bytes bytes);

/// Of a sample that dds_takecdr gave, as long as that is held.
[[nodiscard]] ByteView bytes_of(const ddsi_serdata* sample);

}  // namespace ros2
