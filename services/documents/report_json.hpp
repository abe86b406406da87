// A report as JSON: protobuf's own mapping, keys as report.proto writes them, numbers that are 0 written too.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace lockstep {

/// Indented, with a newline at the end.
std::string report_json(const google::protobuf::Message& report);

}  // namespace lockstep
