// A node of ROS 2's graph: publishers, subscriptions, services, clients, timers, parameters, a clock and a
// log. Names are relative to its namespace and remapped by its arguments. All nodes of a process are made by
// one thread, with all that they publish and listen to; after that each executor may run on a thread of its
// own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "ros2/node/arguments.hpp"
#include "ros2/node/executor.hpp"
#include "ros2/node/graph.hpp"
#include "ros2/node/log.hpp"
#include "ros2/node/names.hpp"
#include "ros2/node/parameters.hpp"
#include "ros2/node/service.hpp"
#include "ros2/node/time.hpp"

namespace ros2 {

/// A process in the graph: its participant, and what it was told. Outlives its nodes.
class Context {
 public:
  Context(Arguments given, const DomainOptions& options);

  Arguments arguments;
  Participant participant;
  Graph graph;
};

template <class Message>
class Publisher {
 public:
  Publisher() = default;
  explicit Publisher(std::shared_ptr<Writer> writer) : writer_{std::move(writer)} {}
  void publish(const Message& message) const { writer_->write(to_cdr(message)); }
  [[nodiscard]] int subscribers() const { return writer_->matched(); }

 private:
  std::shared_ptr<Writer> writer_;
};

/// To answer a request, now or later; once.
template <class Response>
class Reply {
 public:
  Reply(ServiceEndpoints& server, ReplyTo to) : server_{&server}, to_{std::move(to)} {}
  void send(const Response& response) const { server_->reply(to_, to_cdr(to_.header, response)); }

 private:
  ServiceEndpoints* server_;
  ReplyTo to_;
};

template <class Request, class Response>
class Client {
 public:
  using OnResponse = std::function<void(const Response&)>;
  [[nodiscard]] bool ready() const { return state_->endpoints->ready(); }
  /// `on_response` is called by the node's executor; never, when no answer comes.
  void call(const Request& request, OnResponse on_response) const {
    const ServiceHeader header = state_->endpoints->next();
    state_->waiting[header.sequence] = std::move(on_response);
    state_->endpoints->send(to_cdr(header, request));
  }

 private:
  friend class Node;
  struct State {
    std::map<std::int64_t, OnResponse> waiting;
    std::unique_ptr<ClientEndpoints> endpoints;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

class Node {
 public:
  /// `asked` may be renamed by the arguments. Throws std::invalid_argument when they, or parameters, are of
  /// no use.
  Node(Context& context, Executor& executor, const NodeName& asked);
  ~Node();
  Node(const Node&) = delete;
  Node& operator=(const Node&) = delete;

  [[nodiscard]] const NodeName& name() const { return name_; }
  [[nodiscard]] const Clock& clock() const { return clock_; }
  [[nodiscard]] Parameters& parameters() { return parameters_; }
  [[nodiscard]] const Parameters& parameters() const { return parameters_; }
  [[nodiscard]] Log& log() { return log_; }
  /// The whole name of a topic or service.
  [[nodiscard]] std::string resolve(const std::string& name) const;

  template <class Message>
  [[nodiscard]] Publisher<Message> advertise(const std::string& topic, const Qos& qos = {}) {
    return Publisher<Message>{add_writer(message_topic<Message>(resolve(topic)), qos)};
  }

  /// `callback` is called with a message, or with a message and the handle of its writer. What cannot be read
  /// is warned of and left out. The reader lives as long as the node.
  template <class Message, class Callback>
  const Reader& subscribe(const std::string& topic, const Qos& qos, Callback callback) {
    return add_reader(message_topic<Message>(resolve(topic)), qos, taker<Message>(std::move(callback)),
                      Mismatch::told);
  }
  /// Hears publishers that keep their last message for those who come later, and others that do not. The
  /// callback may be called twice with one message.
  template <class Message, class Callback>
  void subscribe_to_state(const std::string& topic, Callback callback) {
    const DdsTopic dds = message_topic<Message>(resolve(topic));
    add_reader(dds, Qos::keep_last(10), taker<Message>(callback), Mismatch::told);
    add_reader(dds, Qos::latched(), taker<Message>(callback), Mismatch::expected);
  }

  /// `callback` is called as (const Request&, const Reply<Response>&) and may keep the reply for later.
  template <class Request, class Response, class Callback>
  void serve_later(const std::string& service, Callback callback, const Qos& qos = Qos::services()) {
    const std::string name = resolve(service);
    add_server(name, service_topics<Request, Response>(name, "serviceid="), qos,
               [this, name, callback = std::move(callback)](ServiceEndpoints& server, ByteView bytes,
                                                            const std::string& client_id) mutable {
                 ReplyTo to;
                 Request request;
                 std::string fault;
                 to.client_id = client_id;
                 if (from_cdr(bytes, to.header, request, fault))
                   callback(request, Reply<Response>{server, to});
                 else
                   warn_of_malformed(name, fault);
               });
  }
  /// `callback` is called as (const Request&) and returns the response.
  template <class Request, class Response, class Callback>
  void serve(const std::string& service, Callback callback, const Qos& qos = Qos::services()) {
    serve_later<Request, Response>(
        service,
        [callback = std::move(callback)](const Request& request, const Reply<Response>& reply) mutable {
          reply.send(callback(request));
        },
        qos);
  }

  template <class Request, class Response>
  [[nodiscard]] Client<Request, Response> client(const std::string& service,
                                                 const Qos& qos = Qos::services()) {
    const std::string name = resolve(service);
    Client<Request, Response> client;
    auto* state = client.state_.get();
    state->endpoints = make_client(service_topics<Request, Response>(name, "clientid="), qos,
                                   [this, name, state](const ServiceHeader& header, ByteView bytes) {
                                     const auto waiting = state->waiting.find(header.sequence);
                                     if (waiting == state->waiting.end()) return;
                                     const auto on_response = std::move(waiting->second);
                                     state->waiting.erase(waiting);
                                     ServiceHeader again;
                                     Response response;
                                     std::string fault;
                                     if (!from_cdr(bytes, again, response, fault))
                                       return warn_of_malformed(name, fault);
                                     on_response(response);
                                   });
    return client;
  }

  /// Every `period` [s] of the node's clock.
  void every(double period, Executor::Callback callback);

 private:
  using TopicPair = std::pair<DdsTopic, DdsTopic>;
  /// Says what is wrong with the bytes, or nothing.
  using Take = std::function<std::string(ByteView, dds_instance_handle_t)>;
  using Serve = std::function<void(ServiceEndpoints&, ByteView, const std::string& client_id)>;
  struct Listening {
    Reader reader;
    Executor::Registration on_data, on_mismatch;
  };
  struct Telling {
    std::shared_ptr<Writer> writer;
    Executor::Registration on_mismatch;
  };

  enum class Mismatch { told, expected };

  template <class Message, class Callback>
  [[nodiscard]] static Take taker(Callback callback) {
    return [callback = std::move(callback)](ByteView bytes, dds_instance_handle_t writer) mutable {
      Message message;
      std::string fault;
      if (!from_cdr(bytes, message, fault)) return fault;
      if constexpr (std::is_invocable_v<Callback&, const Message&, dds_instance_handle_t>) {
        callback(message, writer);
      } else {
        (void)writer;
        callback(message);
      }
      return fault;
    };
  }
  template <class Request, class Response>
  [[nodiscard]] TopicPair service_topics(const std::string& name, const char* key) const {
    const std::string id = key + new_service_id(context_.participant) + ";";
    return {request_topic<Request>(name, id), reply_topic<Response>(name, id)};
  }
  [[nodiscard]] std::shared_ptr<Writer> add_writer(const DdsTopic& topic, const Qos& qos);
  const Reader& add_reader(const DdsTopic& topic, const Qos& qos, Take take, Mismatch mismatch);
  void add_server(const std::string& name, const TopicPair& topics, const Qos& qos, Serve serve);
  [[nodiscard]] std::unique_ptr<ClientEndpoints> make_client(const TopicPair& topics, const Qos& qos,
                                                             ClientEndpoints::OnReply on_reply);
  [[nodiscard]] std::shared_ptr<Writer> rosout_writer();
  void listen_to_clock();
  void serve_parameters();
  void warn_of_malformed(const std::string& name, const std::string& fault);

  Context& context_;
  Executor& executor_;
  NodeName name_;
  std::size_t number_;  // in the graph
  Clock clock_;
  Log log_;
  Parameters parameters_;
  std::vector<std::unique_ptr<Listening>> listening_;
  std::vector<std::unique_ptr<Telling>> telling_;
  std::vector<std::unique_ptr<ServiceEndpoints>> servers_;
  std::vector<Executor::Registration> timers_;
};

}  // namespace ros2
