#include "services/documents/values/values_document.hpp"

#include <google/protobuf/stubs/logging.h>

#include "idl/proto/values.pb.h"
#include "services/documents/text/text_source.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {

std::string values_text(const RevisedValues& values) {
    std::string text;
    google::protobuf::TextFormat::PrintToString(values_to_proto(values), &text);
    return text;
}

std::expected<RevisedValues, Diagnostics> values_from_text(std::string_view text) {
    proto::KeptValues message;
    TextSource source;
    if (const Diagnostics errors = source.parse(text, message); !errors.empty()) { return std::unexpected(errors); }
    auto values = values_from_proto(message);
    if (!values) { return std::unexpected(Diagnostics{{.message = values.error()}}); }
    return *std::move(values);
}

std::expected<RevisedValues, Diagnostics> read_values(const std::filesystem::path& file) {
    std::error_code error;
    if (std::filesystem::status(file, error).type() == std::filesystem::file_type::not_found) {
        return RevisedValues{};
    }
    const auto text = read_text_file(file);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    return values_from_text(*text);
}

std::vector<std::uint8_t> values_bytes(const RevisedValues& values) {
    const proto::KeptValues message = values_to_proto(values);
    std::vector<std::uint8_t> bytes(message.ByteSizeLong());
    message.SerializeWithCachedSizesToArray(bytes.data());
    return bytes;
}

std::expected<RevisedValues, std::string> values_from_bytes(std::span<const std::uint8_t> bytes) {
    const google::protobuf::LogSilencer what_is_wrong_is_the_answer;
    proto::KeptValues message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        return std::unexpected("these bytes are not a machine's values");
    }
    return values_from_proto(message);
}

}  // namespace lockstep
