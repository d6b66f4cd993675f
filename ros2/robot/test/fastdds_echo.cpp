// fastdds_echo DOMAIN TYPE... : a peer on Fast DDS, the other implementation of DDS that ROS 2 uses, on
// loopback. What it hears on the topic rt/to/N, of the N-th type, it sends back on rt/back/N, byte for byte.
// Runs until it is ended.
#include <unistd.h>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>
#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <memory>
#include <string>
#include <vector>

namespace {

namespace fast = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;
using Bytes = std::vector<unsigned char>;

/// Messages are bytes with their encapsulation header.
class RawType : public fast::TopicDataType {
 public:
  explicit RawType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1024;  // payloads grow where they must
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool serialize(void* data, rtps::SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<std::uint32_t>(bytes.size());
    std::memcpy(payload->data, bytes.data(), bytes.size());
    return true;
  }
  bool deserialize(rtps::SerializedPayload_t* payload, void* data) override {
    static_cast<Bytes*>(data)->assign(payload->data, payload->data + payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override {
    return [data] { return static_cast<std::uint32_t>(static_cast<Bytes*>(data)->size()); };
  }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

class Echo : public fast::DataReaderListener {
 public:
  fast::DataWriter* writer = nullptr;

  void on_data_available(fast::DataReader* reader) override {
    Bytes bytes;
    fast::SampleInfo info;
    while (reader->take_next_sample(&bytes, &info) == eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK)
      if (info.valid_data) writer->write(&bytes);
  }
};

fast::DomainParticipantQos on_loopback() {
  fast::DomainParticipantQos qos;
  qos.transport().use_builtin_transports = false;
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().user_transports.push_back(udp);
  rtps::Locator_t peer;
  rtps::IPLocator::setIPv4(peer, "127.0.0.1");
  qos.wire_protocol().builtin.initialPeersList.push_back(peer);
  return qos;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  auto* participant = fast::DomainParticipantFactory::get_instance()->create_participant(
      static_cast<std::uint32_t>(std::stoi(argv[1])), on_loopback());
  if (participant == nullptr) return 1;
  fast::Publisher* publisher = participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  fast::Subscriber* subscriber = participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  fast::DataWriterQos writing;
  writing.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  writing.durability().kind = fast::VOLATILE_DURABILITY_QOS;
  writing.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  fast::DataReaderQos reading;
  reading.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
  reading.durability().kind = fast::VOLATILE_DURABILITY_QOS;
  reading.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
  std::vector<std::unique_ptr<Echo>> echoes;
  for (int i = 2; i < argc; ++i) {
    fast::TypeSupport type{new RawType{argv[i]}};
    participant->register_type(type);
    const std::string number = std::to_string(i - 2);
    const auto topic = [&](const std::string& name) {
      return participant->create_topic(name + number, argv[i], fast::TOPIC_QOS_DEFAULT);
    };
    Echo& echo = *echoes.emplace_back(std::make_unique<Echo>());
    echo.writer = publisher->create_datawriter(topic("rt/back/t"), writing);
    if (echo.writer == nullptr || subscriber->create_datareader(topic("rt/to/t"), reading, &echo) == nullptr)
      return 1;
  }
  while (true) pause();
}
