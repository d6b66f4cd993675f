// What a node answers to those who ask for its parameters, or set them (rcl_interfaces/srv).
#pragma once

#include <ros2_messages/rcl_interfaces/DescribeParameters.hpp>
#include <ros2_messages/rcl_interfaces/GetParameterTypes.hpp>
#include <ros2_messages/rcl_interfaces/GetParameters.hpp>
#include <ros2_messages/rcl_interfaces/ListParameters.hpp>
#include <ros2_messages/rcl_interfaces/SetParameters.hpp>
#include <ros2_messages/rcl_interfaces/SetParametersAtomically.hpp>

#include "ros2/node/parameters.hpp"

namespace ros2 {

/// What is not declared is "not set".
[[nodiscard]] rcl_interfaces::GetParameters_Response answer(
    Parameters& parameters, const rcl_interfaces::GetParameters_Request& request);
[[nodiscard]] rcl_interfaces::GetParameterTypes_Response answer(
    Parameters& parameters, const rcl_interfaces::GetParameterTypes_Request& request);
/// Each by itself.
[[nodiscard]] rcl_interfaces::SetParameters_Response answer(
    Parameters& parameters, const rcl_interfaces::SetParameters_Request& request);
[[nodiscard]] rcl_interfaces::SetParametersAtomically_Response answer(
    Parameters& parameters, const rcl_interfaces::SetParametersAtomically_Request& request);
[[nodiscard]] rcl_interfaces::DescribeParameters_Response answer(
    Parameters& parameters, const rcl_interfaces::DescribeParameters_Request& request);
[[nodiscard]] rcl_interfaces::ListParameters_Response answer(
    Parameters& parameters, const rcl_interfaces::ListParameters_Request& request);

[[nodiscard]] std::vector<rcl_interfaces::Parameter> to_messages(const std::vector<Parameters::Named>& named);

}  // namespace ros2
