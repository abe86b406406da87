#include "services/documents/program_document.hpp"

#include <fmt/format.h>
#include <google/protobuf/stubs/logging.h>

#include "services/documents/program_proto.hpp"
#include "services/documents/text/text_source.hpp"
#include "services/documents/values/values_document.hpp"

namespace lockstep {
namespace {

std::expected<std::optional<gcode::ProgramValues>, std::string> values_of(const proto::Program& message) {
    if (!message.has_values_revision() && !message.has_values_after()) { return std::nullopt; }
    gcode::ProgramValues values{
        .revision = message.values_revision(), .after = {}, .at_once = message.values_at_once()};
    if (!message.has_values_after()) { return values; }
    auto after = values_from_proto(message.values_after());
    if (!after) { return std::unexpected(after.error()); }
    values.after = std::move(after->values);
    return values;
}

}  // namespace

void set_values(proto::Program& message, const std::optional<gcode::ProgramValues>& values) {
    if (!values) { return; }
    message.set_values_revision(values->revision);
    message.set_values_at_once(values->at_once);
    if (values->after) { *message.mutable_values_after() = values_to_proto({0, *values->after}); }
}

std::vector<std::uint8_t> program_bytes(const Program& program, const std::optional<gcode::ProgramValues>& values) {
    proto::Program message = program_to_proto(program);
    set_values(message, values);
    std::vector<std::uint8_t> bytes(message.ByteSizeLong());
    message.SerializeWithCachedSizesToArray(bytes.data());
    return bytes;
}

std::expected<ProgramDocument, std::string> program_document_from_bytes(std::span<const std::uint8_t> bytes,
                                                                        std::optional<std::size_t> axes) {
    if (bytes.size() > kMaxProgramBytes) {
        return std::unexpected(fmt::format("the program has {} bytes; at most {}", bytes.size(), kMaxProgramBytes));
    }
    const google::protobuf::LogSilencer what_is_wrong_is_the_answer;
    proto::Program message;
    if (!message.ParseFromArray(bytes.data(), static_cast<int>(bytes.size()))) {
        return std::unexpected("these bytes are not a program");
    }
    auto program = program_from_proto(message, axes);
    if (!program) { return std::unexpected(program.error()); }
    auto values = values_of(message);
    if (!values) { return std::unexpected(values.error()); }
    return ProgramDocument{*std::move(program), *std::move(values), message.cut()};
}

std::expected<Program, std::string> program_from_bytes(std::span<const std::uint8_t> bytes) {
    auto document = program_document_from_bytes(bytes);
    if (!document) { return std::unexpected(document.error()); }
    return std::move(document->program);
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

struct ProgramPartWriter::Message {
    proto::Program part;
};

ProgramPartWriter::ProgramPartWriter(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values)
    : message_(std::make_unique<Message>()) {
    message_->part = program_to_proto({head.name, head.axes, head.start_mm, {}});
    set_values(message_->part, values);
    bytes_ = message_->part.ByteSizeLong();
}

ProgramPartWriter::~ProgramPartWriter() = default;
ProgramPartWriter::ProgramPartWriter(ProgramPartWriter&&) noexcept = default;
ProgramPartWriter& ProgramPartWriter::operator=(ProgramPartWriter&&) noexcept = default;

void ProgramPartWriter::add(const Block& block) {
    constexpr std::size_t kTagAndLength = 4;
    proto::Block& written = *message_->part.add_blocks();
    block_to_proto(block, written);
    bytes_ += written.ByteSizeLong() + kTagAndLength;
    ++blocks_;
}

void ProgramPartWriter::add_values(const gcode::KeptValues& after) {
    *message_->part.mutable_values_after() = values_to_proto({0, after});
}

void ProgramPartWriter::add_cut(const std::string& why) { message_->part.set_cut(why); }

std::vector<std::uint8_t> ProgramPartWriter::take() {
    std::vector<std::uint8_t> bytes(message_->part.ByteSizeLong());
    message_->part.SerializeWithCachedSizesToArray(bytes.data());
    message_->part.Clear();
    bytes_ = blocks_ = 0;
    return bytes;
}

}  // namespace lockstep
