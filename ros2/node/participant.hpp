// CycloneDDS, wrapped: one participant of a domain, and its endpoints as ROS 2's other nodes expect them.
#pragma once

#include <dds/dds.h>

#include <array>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ros2/messages/cdr.hpp"
#include "ros2/node/qos.hpp"

struct ddsi_sertype;

namespace ros2 {

/// What CycloneDDS refuses: what was tried, with its reason.
class DdsError : public std::runtime_error {
 public:
  DdsError(const std::string& what, dds_return_t code);
};

/// The 16 bytes by which all know an endpoint or participant.
using Gid = std::array<std::uint8_t, 16>;

/// Owns an entity of CycloneDDS.
class Entity {
 public:
  Entity() = default;
  /// Throws DdsError when `handle` is an error; `what` was tried.
  Entity(dds_entity_t handle, const std::string& what);
  ~Entity() { reset(); }
  Entity(Entity&& other) noexcept : handle_{std::exchange(other.handle_, 0)} {}
  Entity& operator=(Entity&& other) noexcept;

  [[nodiscard]] dds_entity_t get() const { return handle_; }
  [[nodiscard]] Gid gid() const;
  void reset();

 private:
  dds_entity_t handle_ = 0;
};

/// How a participant finds others, and what it is to them.
struct DomainOptions {
  int domain_id = 0;
  bool localhost_only = false;  ///< loopback alone, without multicast
  bool wide_gids = false;       ///< gids of 24 bytes in the discovery of nodes, up to ROS 2 Humble; later 16

  /// From ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE and ROS_DISTRO. Throws
  /// std::invalid_argument that names variable, value and what it may be.
  [[nodiscard]] static DomainOptions from_environment();
};

/// A topic as DDS knows it.
struct DdsTopic {
  std::string name;       ///< "rt/robot0/odom"
  std::string type_name;  ///< "nav_msgs::msg::dds_::Odometry_"
  std::string user_data;  ///< "typehash=RIHS01_...;", of its endpoints
};

class Writer {
 public:
  Writer(dds_entity_t participant, const DdsTopic& topic, const Qos& qos);

  void write(Bytes message);
  [[nodiscard]] Gid gid() const { return writer_.gid(); }
  [[nodiscard]] dds_entity_t entity() const { return writer_.get(); }
  /// Readers that it reaches now.
  [[nodiscard]] int matched() const;
  /// USER_DATA of these.
  [[nodiscard]] std::vector<std::string> matched_user_data() const;
  /// The name of a policy for which a reader does not match it; empty when there is no new one.
  [[nodiscard]] std::string take_mismatch();

 private:
  const ddsi_sertype* type_ = nullptr;  // the topic's; set with it
  Entity topic_;
  Entity writer_;
};

class Reader {
 public:
  Reader(dds_entity_t participant, const DdsTopic& topic, const Qos& qos);

  /// Calls use(bytes, handle of the writer) for each message that is there.
  template <class Use>
  void take(Use&& use) {
    for (Sample sample{*this}; sample.take();) use(sample.bytes(), sample.writer());
  }
  [[nodiscard]] Gid gid() const { return reader_.gid(); }
  [[nodiscard]] dds_entity_t entity() const { return reader_.get(); }
  [[nodiscard]] dds_entity_t condition() const { return condition_.get(); }
  /// Writers that reach it now.
  [[nodiscard]] int matched() const;
  /// USER_DATA of a writer by its handle; empty when it is gone.
  [[nodiscard]] std::string user_data_of(dds_instance_handle_t writer) const;
  [[nodiscard]] std::string take_mismatch();

 private:
  /// Messages one after the other.
  class Sample {
   public:
    explicit Sample(const Reader& reader) : reader_{reader.reader_.get()} {}
    ~Sample() { release(); }
    Sample(const Sample&) = delete;
    Sample& operator=(const Sample&) = delete;
    [[nodiscard]] bool take();
    [[nodiscard]] ByteView bytes() const;
    [[nodiscard]] dds_instance_handle_t writer() const { return info_.publication_handle; }

   private:
    void release();
    dds_entity_t reader_;
    ddsi_serdata* sample_ = nullptr;
    dds_sample_info_t info_{};
  };

  Entity topic_;
  Entity reader_;
  Entity condition_;  // messages are there
};

class Participant {
 public:
  /// In one process participants of one domain share its settings: those of the first. Not for several
  /// threads.
  explicit Participant(const DomainOptions& options);

  [[nodiscard]] dds_entity_t entity() const { return participant_.get(); }
  [[nodiscard]] Gid gid() const { return participant_.gid(); }
  [[nodiscard]] const DomainOptions& options() const { return options_; }

 private:
  DomainOptions options_;
  std::shared_ptr<const Entity> domain_;
  Entity participant_;
};

/// CycloneDDS's settings for these options, as XML; those of CYCLONEDDS_URI come after them.
[[nodiscard]] std::string domain_settings(const DomainOptions& options);

}  // namespace ros2
