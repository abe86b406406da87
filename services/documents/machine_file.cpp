#include "services/documents/machine_file.hpp"

#include <algorithm>

#include "services/documents/fnv.hpp"
#include "services/documents/machine_errors.hpp"
#include "services/documents/machine_proto.hpp"
#include "services/documents/text/text_source.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {

std::expected<MachineSetup, Diagnostics> parse_machine(std::string_view text) {
    TextSource source;
    proto::Machine message;
    if (const Diagnostics errors = source.parse(text, message); !errors.empty()) { return std::unexpected(errors); }
    MachineDraft draft = machine_from_proto(message);
    if (const Diagnostics errors = machine_errors(draft, source, *message.GetDescriptor()); !errors.empty()) {
        return std::unexpected(errors);
    }
    return std::move(draft.machine);
}

std::expected<MachineSetup, Diagnostics> load_machine_file(const std::filesystem::path& path) {
    const auto text = read_text_file(path);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    return parse_machine(*text);
}

std::string machine_text(const MachineSetup& machine) {
    std::string text;
    google::protobuf::TextFormat::PrintToString(machine_to_proto(machine), &text);
    return text;
}

std::uint64_t config_hash(const MachineSetup& machine) {
    proto::Machine message = machine_to_proto(machine);
    message.clear_web();  // not a part of the machine; it may differ between hosts
    return std::max<std::uint64_t>(fnv1a(message.SerializeAsString()), 1);
}

}  // namespace lockstep
