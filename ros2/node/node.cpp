#include "ros2/node/node.hpp"

#include <ros2_messages/rcl_interfaces/DescribeParameters.hpp>
#include <ros2_messages/rcl_interfaces/GetParameterTypes.hpp>
#include <ros2_messages/rcl_interfaces/GetParameters.hpp>
#include <ros2_messages/rcl_interfaces/ListParameters.hpp>
#include <ros2_messages/rcl_interfaces/Log.hpp>
#include <ros2_messages/rcl_interfaces/ParameterEvent.hpp>
#include <ros2_messages/rcl_interfaces/SetParameters.hpp>
#include <ros2_messages/rcl_interfaces/SetParametersAtomically.hpp>
#include <ros2_messages/rosgraph_msgs/Clock.hpp>

#include "ros2/node/parameter_services.hpp"

namespace ros2 {

Context::Context(Arguments given, const DomainOptions& options)
    : arguments{std::move(given)}, participant{options}, graph{participant} {}

Node::Node(Context& context, Executor& executor, const NodeName& asked)
    : context_{context},
      executor_{executor},
      name_{resolved_node(asked, context.arguments.remaps)},
      number_{context.graph.add_node(name_)},
      log_{name_.full(), context.arguments.log_level, clock_, rosout_writer()},
      parameters_{context.arguments.parameters_for(name_.full())} {
  serve_parameters();
  if (parameters_.declare_as("use_sim_time", false, {"time is what /clock says", true, {}, {}}))
    listen_to_clock();
}

Node::~Node() {
  timers_.clear();
  try {
    context_.graph.remove_node(number_);
  } catch (const DdsError&) {  // the end of its endpoints says the same
  }
}

std::string Node::resolve(const std::string& name) const {
  return resolved(name, name_, context_.arguments.remaps);
}

std::shared_ptr<Writer> Node::rosout_writer() {
  if (!context_.arguments.rosout) return nullptr;
  auto writer = std::make_shared<Writer>(context_.participant.entity(),
                                         message_topic<rcl_interfaces::Log>("/rosout"), Qos::rosout());
  context_.graph.add_writer(number_, writer->gid());
  return writer;
}

void Node::listen_to_clock() {
  clock_.set_simulated(true);
  subscribe<rosgraph_msgs::Clock>("/clock", Qos::clock(), [this](const rosgraph_msgs::Clock& clock) {
    clock_.set(nanoseconds_of(clock.clock));
  });
}

void Node::every(double period, Executor::Callback callback) {
  timers_.push_back(executor_.every(nanoseconds_of(period), clock_, std::move(callback)));
}

void Node::warn_of_malformed(const std::string& name, const std::string& fault) {
  log_.warn_now_and_then(name + ": a malformed message: " + fault);
}

// ---- endpoints

std::shared_ptr<Writer> Node::add_writer(const DdsTopic& topic, const Qos& qos) {
  auto telling = std::make_unique<Telling>();
  telling->writer = std::make_shared<Writer>(context_.participant.entity(), topic, qos);
  Writer& writer = *telling->writer;
  dds_set_status_mask(writer.entity(), DDS_OFFERED_INCOMPATIBLE_QOS_STATUS);
  telling->on_mismatch = executor_.when(writer.entity(), [this, &writer, name = topic.name.substr(2)] {
    if (const std::string policy = writer.take_mismatch(); !policy.empty())
      log_.warn(name + ": somebody listens with an incompatible QoS and gets nothing; policy: " + policy);
  });
  context_.graph.add_writer(number_, writer.gid());
  context_.graph.announce();
  telling_.push_back(std::move(telling));
  return telling_.back()->writer;
}

const Reader& Node::add_reader(const DdsTopic& topic, const Qos& qos, Take take, Mismatch mismatch) {
  const std::string name = topic.name.substr(2);
  auto listening =
      std::make_unique<Listening>(Listening{Reader{context_.participant.entity(), topic, qos}, {}, {}});
  Reader& reader = listening->reader;
  dds_set_status_mask(reader.entity(), DDS_REQUESTED_INCOMPATIBLE_QOS_STATUS);
  listening->on_mismatch = executor_.when(reader.entity(), [this, &reader, name, mismatch] {
    const std::string policy = reader.take_mismatch();
    if (!policy.empty() && mismatch == Mismatch::told)
      log_.warn(name + ": somebody publishes with an incompatible QoS and is not heard; policy: " + policy);
  });
  listening->on_data = executor_.when(reader.condition(), [this, &reader, name, take = std::move(take)] {
    reader.take([&](ByteView bytes, dds_instance_handle_t writer) {
      if (const std::string fault = take(bytes, writer); !fault.empty()) warn_of_malformed(name, fault);
    });
  });
  context_.graph.add_reader(number_, reader.gid());
  context_.graph.announce();
  listening_.push_back(std::move(listening));
  return reader;
}

void Node::add_server(const std::string& /*name*/, const TopicPair& topics, const Qos& qos, Serve serve) {
  const std::size_t place = servers_.size();
  servers_.push_back(std::make_unique<ServiceEndpoints>(
      context_.participant, executor_, topics.first, topics.second, qos,
      [this, place, serve = std::move(serve)](ByteView request, const std::string& client_id) {
        serve(*servers_[place], request, client_id);
      }));
  context_.graph.add_reader(number_, servers_.back()->request_gid());
  context_.graph.add_writer(number_, servers_.back()->reply_gid());
  context_.graph.announce();
}

std::unique_ptr<ClientEndpoints> Node::make_client(const TopicPair& topics, const Qos& qos,
                                                   ClientEndpoints::OnReply on_reply) {
  auto client = std::make_unique<ClientEndpoints>(context_.participant, executor_, topics.first,
                                                  topics.second, qos, std::move(on_reply));
  context_.graph.add_writer(number_, client->request_gid());
  context_.graph.add_reader(number_, client->reply_gid());
  context_.graph.announce();
  return client;
}

// ---- parameters

void Node::serve_parameters() {
  using namespace rcl_interfaces;  // NOLINT: six services of one package
  const Qos qos = Qos::parameters();
  serve<GetParameters_Request, GetParameters_Response>(
      "~/get_parameters", [this](const auto& request) { return answer(parameters_, request); }, qos);
  serve<GetParameterTypes_Request, GetParameterTypes_Response>(
      "~/get_parameter_types", [this](const auto& request) { return answer(parameters_, request); }, qos);
  serve<SetParameters_Request, SetParameters_Response>(
      "~/set_parameters", [this](const auto& request) { return answer(parameters_, request); }, qos);
  serve<SetParametersAtomically_Request, SetParametersAtomically_Response>(
      "~/set_parameters_atomically", [this](const auto& request) { return answer(parameters_, request); },
      qos);
  serve<DescribeParameters_Request, DescribeParameters_Response>(
      "~/describe_parameters", [this](const auto& request) { return answer(parameters_, request); }, qos);
  serve<ListParameters_Request, ListParameters_Response>(
      "~/list_parameters", [this](const auto& request) { return answer(parameters_, request); }, qos);
  parameters_.on_event([this, events = advertise<ParameterEvent>("/parameter_events", qos)](
                           const auto& declared, const auto& changed) {
    ParameterEvent event;
    event.stamp = clock_.stamp();
    event.node = name_.full();
    event.new_parameters = to_messages(declared);
    event.changed_parameters = to_messages(changed);
    events.publish(event);
  });
}

}  // namespace ros2
