#include "services/documents/report_json.hpp"

#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/util/json_util.h>

#include "idl/proto/report.pb.h"

namespace lockstep {

std::string report_json(const google::protobuf::Message& report) {
    const google::protobuf::LogSilencer of_texts_that_are_no_utf8;
    google::protobuf::util::JsonPrintOptions options;
    options.add_whitespace = true;
    options.always_print_primitive_fields = true;
    options.preserve_proto_field_names = true;
    std::string text;
    (void)google::protobuf::util::MessageToJsonString(report, &text, options);  // fails only for Any
    return text;
}

std::string report_json(const google::protobuf::Message& report, const std::vector<std::string>& warnings) {
    std::string text = report_json(report);
    if (warnings.empty()) { return text; }
    proto::Warnings message;
    for (const std::string& warning : warnings) { message.add_warnings(warning); }
    const std::string list = report_json(message);
    const std::size_t end = text.find_last_not_of("}\n ");  // of the last value, or the opening brace
    const std::string separator = text[end] == '{' ? "" : ",";
    return text.substr(0, end + 1) + separator + list.substr(list.find('{') + 1);
}

}  // namespace lockstep
