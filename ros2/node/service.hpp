// Services as rmw_cyclonedds has them: two topics, and a header before request and reply by which they belong
// together.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <string>

#include "ros2/node/executor.hpp"
#include "ros2/node/participant.hpp"

namespace ros2 {

/// To whom a reply goes.
struct ReplyTo {
  ServiceHeader header;
  std::string client_id;  ///< as the client's endpoints announce it; empty when they do not
};

/// The server's two endpoints. Replies wait until the reader of the client that asked has been found, else it
/// would miss them; after a second they are sent all the same.
class ServiceEndpoints {
 public:
  /// A request, whole, its header included.
  using OnRequest = std::function<void(ByteView request, const std::string& client_id)>;

  ServiceEndpoints(const Participant& participant, Executor& executor, const DdsTopic& requests,
                   const DdsTopic& replies, const Qos& qos, OnRequest on_request);

  /// `reply` begins with the header of `to`.
  void reply(const ReplyTo& to, Bytes reply);
  [[nodiscard]] Gid request_gid() const { return requests_.gid(); }
  [[nodiscard]] Gid reply_gid() const { return replies_.gid(); }

 private:
  struct Waiting {
    std::string client_id;
    Bytes reply;
    std::chrono::steady_clock::time_point since;
  };
  [[nodiscard]] bool reaches(const std::string& client_id) const;
  void send_waiting();

  Reader requests_;
  Writer replies_;
  OnRequest on_request_;
  std::deque<Waiting> waiting_;
  Executor::Registration on_data_, on_match_, always_;
};

/// The client's two endpoints.
class ClientEndpoints {
 public:
  using OnReply = std::function<void(const ServiceHeader& header, ByteView reply)>;

  ClientEndpoints(const Participant& participant, Executor& executor, const DdsTopic& requests,
                  const DdsTopic& replies, const Qos& qos, OnReply on_reply);

  /// Is a server there?
  [[nodiscard]] bool ready() const { return requests_.matched() > 0 && replies_.matched() > 0; }
  /// The header for the next request.
  [[nodiscard]] ServiceHeader next() { return {client_, ++sequence_}; }
  void send(Bytes request) { requests_.write(std::move(request)); }
  [[nodiscard]] Gid request_gid() const { return requests_.gid(); }
  [[nodiscard]] Gid reply_gid() const { return replies_.gid(); }

 private:
  Writer requests_;
  Reader replies_;
  OnReply on_reply_;
  std::uint64_t client_;
  std::int64_t sequence_ = 0;
  Executor::Registration on_data_;
};

/// A name for a client or server that no other has: 16 bytes in hexadecimal, joined by dots.
[[nodiscard]] std::string new_service_id(const Participant& participant);

}  // namespace ros2
