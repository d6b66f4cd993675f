// The request of a plan as Python sees it: its own, or a view of one that is valid during a call.
#pragma once

#include <memory>

#include "python/bind.hpp"
#include "spf/planning/planner.hpp"

namespace spf::python {

/// Handed to a method written in Python; after the call every access throws std::invalid_argument.
class RequestView {
 public:
  explicit RequestView(const PlanRequest& request) : request_{&request} {}
  [[nodiscard]] const PlanRequest& get() const {
    if (request_ == nullptr)
      throw std::invalid_argument("request: it is valid during the call of plan() alone");
    return *request_;
  }
  void expire() { request_ = nullptr; }

 private:
  const PlanRequest* request_;
};

}  // namespace spf::python
