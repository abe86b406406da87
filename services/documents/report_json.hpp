// Writes a report as JSON, with protobuf's own mapping and the key names of report.proto. It writes zeros too.
#pragma once

#include <google/protobuf/message.h>

#include <string>
#include <vector>

namespace lockstep {

/// The text is indented, with a newline at the end.
std::string report_json(const google::protobuf::Message& report);

/// The same with the key `warnings`, a list of texts, at its end. Without warnings the key is absent.
std::string report_json(const google::protobuf::Message& report, const std::vector<std::string>& warnings);

}  // namespace lockstep
