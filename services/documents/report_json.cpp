#include "services/documents/report_json.hpp"

#include <google/protobuf/stubs/logging.h>
#include <google/protobuf/util/json_util.h>

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

}  // namespace lockstep
