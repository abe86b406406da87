// Writes a report as JSON, with protobuf's own mapping and the key names of report.proto. It writes zeros too.
#pragma once

#include <google/protobuf/message.h>

#include <string>

namespace lockstep {

/// The text is indented, with a newline at the end.
std::string report_json(const google::protobuf::Message& report);

}  // namespace lockstep
