#include "services/documents/program_document.hpp"

#include <google/protobuf/stubs/logging.h>

#include "services/documents/program_proto.hpp"
#include "services/documents/text_source.hpp"

namespace lockstep {

std::vector<std::uint8_t> program_bytes(const Program& program) {
    const proto::Program message = program_to_proto(program);
    std::vector<std::uint8_t> bytes(message.ByteSizeLong());
    message.SerializeWithCachedSizesToArray(bytes.data());
    return bytes;
}

std::expected<Program, std::string> program_from_bytes(std::span<const std::uint8_t> bytes) {
    if (bytes.size() > kMaxProgramBytes) {
        return std::unexpected("the program has " + std::to_string(bytes.size()) + " bytes; at most " +
                               std::to_string(kMaxProgramBytes));
    }
    const google::protobuf::LogSilencer what_is_wrong_is_the_answer;
    proto::Program message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        return std::unexpected("these bytes are not a program");
    }
    return program_from_proto(message);
}

std::string program_text(const Program& program) {
    std::string text;
    google::protobuf::TextFormat::PrintToString(program_to_proto(program), &text);
    return text;
}

std::expected<Program, std::string> program_from_text(std::string_view text) {
    proto::Program message;
    TextSource source;
    if (const Diagnostics errors = source.parse(text, message); !errors.empty()) {
        return std::unexpected(to_text("program", errors.front()));
    }
    return program_from_proto(message);
}

}  // namespace lockstep
