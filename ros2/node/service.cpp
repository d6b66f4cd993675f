#include "ros2/node/service.hpp"

#include <dds/dds.h>

#include <algorithm>
#include <cstdio>
#include <utility>

#include "ros2/node/names.hpp"

namespace ros2 {
namespace {

constexpr auto kLongestHold = std::chrono::seconds{1};

}  // namespace

ServiceEndpoints::ServiceEndpoints(const Participant& participant, Executor& executor,
                                   const DdsTopic& requests, const DdsTopic& replies, const Qos& qos,
                                   OnRequest on_request)
    : requests_{participant.entity(), requests, qos},
      replies_{participant.entity(), replies, qos},
      on_request_{std::move(on_request)} {
  on_data_ = executor.when(requests_.condition(), [this] {
    requests_.take([this](ByteView request, dds_instance_handle_t writer) {
      on_request_(request, user_data_value(requests_.user_data_of(writer), "clientid").value_or(""));
    });
  });
  dds_set_status_mask(replies_.entity(), DDS_PUBLICATION_MATCHED_STATUS);
  on_match_ = executor.when(replies_.entity(), [this] {
    (void)replies_.matched();  // which takes the status
    send_waiting();
  });
  always_ = executor.always([this] { send_waiting(); });
}

bool ServiceEndpoints::reaches(const std::string& client_id) const {
  const std::vector<std::string> readers = replies_.matched_user_data();
  if (client_id.empty()) return !readers.empty();
  return std::any_of(readers.begin(), readers.end(), [&](const std::string& reader) {
    return user_data_value(reader, "clientid") == client_id;
  });
}

void ServiceEndpoints::reply(const ReplyTo& to, Bytes reply) {
  waiting_.push_back({to.client_id, std::move(reply), std::chrono::steady_clock::now()});
  send_waiting();
}

void ServiceEndpoints::send_waiting() {
  const auto now = std::chrono::steady_clock::now();
  for (auto item = waiting_.begin(); item != waiting_.end();) {
    if (reaches(item->client_id) || now - item->since > kLongestHold) {
      replies_.write(std::move(item->reply));
      item = waiting_.erase(item);
    } else {
      ++item;
    }
  }
}

ClientEndpoints::ClientEndpoints(const Participant& participant, Executor& executor, const DdsTopic& requests,
                                 const DdsTopic& replies, const Qos& qos, OnReply on_reply)
    : requests_{participant.entity(), requests, qos},
      replies_{participant.entity(), replies, qos},
      on_reply_{std::move(on_reply)} {
  dds_instance_handle_t handle = 0;
  dds_get_instance_handle(requests_.entity(), &handle);
  client_ = handle;
  on_data_ = executor.when(replies_.condition(), [this] {
    replies_.take([this](ByteView reply, dds_instance_handle_t /*writer*/) {
      CdrReader reader{reply};
      ServiceHeader header;
      reader.read(header);
      if (reader.well() && header.client == client_) on_reply_(header, reply);
    });
  });
}

std::string new_service_id(const Participant& participant) {
  static std::uint32_t count = 0;
  Gid id = participant.gid();
  ++count;
  for (std::size_t i = 0; i < 4; ++i) id[12 + i] = static_cast<std::uint8_t>(count >> (24 - 8 * i));
  std::string text;
  char part[4];
  for (const std::uint8_t byte : id) {
    std::snprintf(part, sizeof part, "%x", static_cast<unsigned>(byte));
    text += (text.empty() ? "" : ".") + std::string{part};
  }
  return text;
}

}  // namespace ros2
