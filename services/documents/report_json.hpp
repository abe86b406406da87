// A report as JSON: protobuf's own mapping, with report.proto's key names; zeros are written too.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace lockstep {

/// Indented, with a newline at the end.
std::string report_json(const google::protobuf::Message& report);

}  // namespace lockstep
