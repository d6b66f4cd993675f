#include "ros2/node/participant.hpp"

#include <dds/ddsi/ddsi_serdata.h>
#include <dds/ddsi/ddsi_sertype.h>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <utility>

#include "ros2/node/raw_type.hpp"

namespace ros2 {
namespace {

constexpr int kLargestDomain = 232;  // whose ports are below 65536

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPointer = std::unique_ptr<dds_qos_t, QosDeleter>;

void set_user_data(dds_qos_t* qos, const std::string& text) {
  dds_qset_userdata(qos, text.data(), text.size());
}

std::string user_data(const dds_qos_t* qos) {
  void* data = nullptr;
  size_t size = 0;
  if (qos == nullptr || !dds_qget_userdata(qos, &data, &size) || data == nullptr) return {};
  std::string text(static_cast<const char*>(data), size);
  dds_free(data);
  return text;
}

QosPointer endpoint_qos(const DdsTopic& topic, const Qos& qos) {
  QosPointer dds{dds_create_qos()};
  dds_qset_reliability(dds.get(), qos.reliable ? DDS_RELIABILITY_RELIABLE : DDS_RELIABILITY_BEST_EFFORT,
                       qos.reliable ? DDS_INFINITY : 0);
  const dds_history_kind_t history = qos.depth > 0 ? DDS_HISTORY_KEEP_LAST : DDS_HISTORY_KEEP_ALL;
  dds_qset_history(dds.get(), history, std::max(qos.depth, 1));
  dds_qset_durability(dds.get(),
                      qos.transient_local ? DDS_DURABILITY_TRANSIENT_LOCAL : DDS_DURABILITY_VOLATILE);
  if (qos.transient_local)
    dds_qset_durability_service(dds.get(), 0, history, std::max(qos.depth, 1), DDS_LENGTH_UNLIMITED,
                                DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
  if (qos.lifespan > 0.0) dds_qset_lifespan(dds.get(), static_cast<dds_duration_t>(1e9 * qos.lifespan));
  dds_qset_writer_data_lifecycle(dds.get(), false);
  const dds_data_representation_id_t representation = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(dds.get(), 1, &representation);
  set_user_data(dds.get(), topic.user_data);
  return dds;
}

/// `type` stays valid as long as the topic.
Entity make_topic(dds_entity_t participant, const DdsTopic& topic, const ddsi_sertype** type = nullptr) {
  ddsi_sertype* sertype = new_raw_type(topic.type_name);
  const dds_entity_t made =
      dds_create_topic_sertype(participant, topic.name.c_str(), &sertype, nullptr, nullptr, nullptr);
  if (made < 0) ddsi_sertype_unref(sertype);
  if (type != nullptr) *type = sertype;
  return Entity{made, "topic " + topic.name};
}

/// The policies that ROS 2 sets; others by number.
std::string policy_name(std::uint32_t policy) {
  switch (policy) {
    case DDS_DURABILITY_QOS_POLICY_ID:
      return "durability";
    case DDS_RELIABILITY_QOS_POLICY_ID:
      return "reliability";
    case DDS_DATA_REPRESENTATION_QOS_POLICY_ID:
      return "data representation";
    case DDS_DEADLINE_QOS_POLICY_ID:
      return "deadline";
    case DDS_LIVELINESS_QOS_POLICY_ID:
      return "liveliness";
    case DDS_OWNERSHIP_QOS_POLICY_ID:
      return "ownership";
    default:
      return "policy " + std::to_string(policy);
  }
}

std::string variable(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? std::string{} : std::string{value};
}

int domain_from_environment() {
  const std::string text = variable("ROS_DOMAIN_ID");
  if (text.empty()) return 0;
  const bool digits = text.size() <= 3 && text.find_first_not_of("0123456789") == std::string::npos;
  if (digits && std::stoi(text) <= kLargestDomain) return std::stoi(text);
  throw std::invalid_argument{"ROS_DOMAIN_ID = " + text + " must be a whole number from 0 to " +
                              std::to_string(kLargestDomain)};
}

bool localhost_from_environment() {
  const std::string only = variable("ROS_LOCALHOST_ONLY");
  if (!only.empty() && only != "0" && only != "1")
    throw std::invalid_argument{"ROS_LOCALHOST_ONLY = " + only + " must be 0 or 1"};
  const std::string range = variable("ROS_AUTOMATIC_DISCOVERY_RANGE");
  if (!range.empty() && range != "SUBNET" && range != "LOCALHOST" && range != "SYSTEM_DEFAULT")
    throw std::invalid_argument{"ROS_AUTOMATIC_DISCOVERY_RANGE = " + range +
                                " must be one of SUBNET, LOCALHOST, SYSTEM_DEFAULT"};
  return only == "1" || range == "LOCALHOST";
}

/// Settings hold for a domain in a process, so participants of a domain share it.
std::shared_ptr<const Entity> domain_of(const DomainOptions& options) {
  static std::map<int, std::weak_ptr<const Entity>> domains;
  std::weak_ptr<const Entity>& known = domains[options.domain_id];
  if (std::shared_ptr<const Entity> domain = known.lock()) return domain;
  const dds_entity_t made =
      dds_create_domain(static_cast<dds_domainid_t>(options.domain_id), domain_settings(options).c_str());
  auto domain = std::make_shared<const Entity>(made, "domain " + std::to_string(options.domain_id));
  known = domain;
  return domain;
}

}  // namespace

DdsError::DdsError(const std::string& what, dds_return_t code)
    : std::runtime_error{"DDS: " + what + ": " + dds_strretcode(code)} {}

// ---- entities

Entity::Entity(dds_entity_t handle, const std::string& what) : handle_{handle} {
  if (handle < 0) throw DdsError{what, handle};
}

Entity& Entity::operator=(Entity&& other) noexcept {
  std::swap(handle_, other.handle_);
  return *this;
}

void Entity::reset() {
  if (handle_ > 0) dds_delete(handle_);
  handle_ = 0;
}

Gid Entity::gid() const {
  dds_guid_t guid{};
  if (const dds_return_t code = dds_get_guid(handle_, &guid); code < 0) throw DdsError{"guid", code};
  Gid result{};
  std::copy(std::begin(guid.v), std::end(guid.v), result.begin());
  return result;
}

// ---- writers

Writer::Writer(dds_entity_t participant, const DdsTopic& topic, const Qos& qos)
    : topic_{make_topic(participant, topic, &type_)},
      writer_{dds_create_writer(participant, topic_.get(), endpoint_qos(topic, qos).get(), nullptr),
              "writer of " + topic.name} {}

void Writer::write(Bytes message) {
  const dds_return_t code = dds_writecdr(writer_.get(), new_raw_sample(type_, std::move(message)));
  if (code < 0) throw DdsError{"write", code};
}

int Writer::matched() const {
  dds_publication_matched_status_t status{};
  dds_get_publication_matched_status(writer_.get(), &status);
  return static_cast<int>(status.current_count);
}

std::vector<std::string> Writer::matched_user_data() const {
  std::vector<dds_instance_handle_t> handles(64);
  dds_return_t count = dds_get_matched_subscriptions(writer_.get(), handles.data(), handles.size());
  if (count > static_cast<dds_return_t>(handles.size())) {
    handles.resize(static_cast<std::size_t>(count));
    count = dds_get_matched_subscriptions(writer_.get(), handles.data(), handles.size());
  }
  handles.resize(std::min(handles.size(), static_cast<std::size_t>(std::max(count, 0))));
  std::vector<std::string> found;
  for (const dds_instance_handle_t handle : handles)
    if (dds_builtintopic_endpoint_t* endpoint = dds_get_matched_subscription_data(writer_.get(), handle)) {
      found.push_back(user_data(endpoint->qos));
      dds_builtintopic_free_endpoint(endpoint);
    }
  return found;
}

std::string Writer::take_mismatch() {
  dds_offered_incompatible_qos_status_t status{};
  dds_get_offered_incompatible_qos_status(writer_.get(), &status);
  return status.total_count_change > 0 ? policy_name(status.last_policy_id) : std::string{};
}

// ---- readers

Reader::Reader(dds_entity_t participant, const DdsTopic& topic, const Qos& qos)
    : topic_{make_topic(participant, topic)},
      reader_{dds_create_reader(participant, topic_.get(), endpoint_qos(topic, qos).get(), nullptr),
              "reader of " + topic.name},
      condition_{dds_create_readcondition(reader_.get(), DDS_ANY_STATE), "condition of " + topic.name} {}

int Reader::matched() const {
  dds_subscription_matched_status_t status{};
  dds_get_subscription_matched_status(reader_.get(), &status);
  return static_cast<int>(status.current_count);
}

std::string Reader::user_data_of(dds_instance_handle_t writer) const {
  dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader_.get(), writer);
  if (endpoint == nullptr) return {};
  std::string text = user_data(endpoint->qos);
  dds_builtintopic_free_endpoint(endpoint);
  return text;
}

std::string Reader::take_mismatch() {
  dds_requested_incompatible_qos_status_t status{};
  dds_get_requested_incompatible_qos_status(reader_.get(), &status);
  return status.total_count_change > 0 ? policy_name(status.last_policy_id) : std::string{};
}

/// A sample without data says that a writer is gone.
bool Reader::Sample::take() {
  do {
    release();
    if (dds_takecdr(reader_, &sample_, 1, &info_, DDS_ANY_STATE) <= 0) return false;
  } while (!info_.valid_data);
  return true;
}

ByteView Reader::Sample::bytes() const {
  return bytes_of(sample_);
}

void Reader::Sample::release() {
  if (sample_ != nullptr) ddsi_serdata_unref(std::exchange(sample_, nullptr));
}

// ---- participants

DomainOptions DomainOptions::from_environment() {
  DomainOptions options;
  options.domain_id = domain_from_environment();
  options.localhost_only = localhost_from_environment();
  const std::string distribution = variable("ROS_DISTRO");
  for (const char* old : {"dashing", "eloquent", "foxy", "galactic", "humble"})
    options.wide_gids = options.wide_gids || distribution == old;
  return options;
}

std::string domain_settings(const DomainOptions& options) {
  std::string xml = "<CycloneDDS><Domain>";
  if (options.localhost_only)
    xml +=
        "<General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
        "<AllowMulticast>false</AllowMulticast></General>";
  xml += "<Discovery>";
  // Not by its name, which a bare machine does not know.
  if (options.localhost_only) xml += "<Peers><Peer address=\"127.0.0.1\"/></Peers>";
  // As many as there are ports for in a domain: ROS 2's own 32 would end with ten robots of three processes
  // on a host. Who looks at 32 alone is found by us, and answers.
  xml += "<ParticipantIndex>auto</ParticipantIndex><MaxAutoParticipantIndex>119</MaxAutoParticipantIndex>";
  xml += "</Discovery>";
  // One thread receives: several are woken at the end by a packet that each sends to itself, for which they
  // wait for ever where the network is down.
  xml += "<Internal><MultipleReceiveThreads>false</MultipleReceiveThreads></Internal></Domain></CycloneDDS>";
  const std::string more = variable("CYCLONEDDS_URI");
  return more.empty() ? xml : xml + "," + more;
}

Participant::Participant(const DomainOptions& options) : options_{options}, domain_{domain_of(options)} {
  const QosPointer qos{dds_create_qos()};
  set_user_data(qos.get(), "enclave=/;");
  participant_ =
      Entity{dds_create_participant(static_cast<dds_domainid_t>(options.domain_id), qos.get(), nullptr),
             "participant"};
}

}  // namespace ros2
