#include "services/documents/machine_file.hpp"

#include <algorithm>
#include <functional>
#include <tuple>

#include "services/documents/fnv.hpp"
#include "services/documents/machine_proto.hpp"
#include "services/documents/text_file.hpp"
#include "services/documents/text_source.hpp"

namespace lockstep {
namespace {

using Problems = std::vector<Problem>;

constexpr std::size_t kMaxDiagnostics = 50;

TextSource::Place place_of(const Problem& problem, const TextSource& source) {
    return source.place_of(*proto::Machine::descriptor(), problem.field);
}

/// What is wrong with a default comes of what is written, and is said only where nothing written is wrong.
Problems axis_problems(const MachineConfig& machine, std::size_t axis, const TextSource& source) {
    Problems problems = axis_problems(machine, axis);
    const auto is_written = [&](const Problem& problem) { return place_of(problem, source).is_of_key; };
    if (std::ranges::any_of(problems, is_written)) { std::erase_if(problems, std::not_fn(is_written)); }
    return problems;
}

/// Missing keys first; a block that lacks one is judged no further.
Problems problems_of(const MachineDraft& draft, const TextSource& source) {
    Problems problems = draft.missing;
    const auto is_whole = [&](std::optional<std::size_t> axis) {
        return std::ranges::none_of(draft.missing, [&](const Problem& missing) { return missing.field.axis == axis; });
    };
    const auto add = [&](const Problems& more) { problems.insert(problems.end(), more.begin(), more.end()); };
    if (is_whole({})) { add(machine_problems(draft.machine)); }
    for (std::size_t axis = 0; axis < std::min(draft.machine.axes.size(), kMaxAxes); ++axis) {
        if (is_whole(axis)) { add(axis_problems(draft.machine, axis, source)); }
    }
    return problems;
}

/// In the order of the text.
Diagnostics placed(const Problems& problems, const TextSource& source) {
    Diagnostics diagnostics;
    for (const Problem& problem : problems) {
        const auto place = place_of(problem, source);
        diagnostics.push_back({place.line, place.column, problem.message});
    }
    std::ranges::stable_sort(diagnostics, {}, [](const Diagnostic& d) { return std::tuple(d.line, d.column); });
    if (diagnostics.size() > kMaxDiagnostics) { diagnostics.resize(kMaxDiagnostics); }
    return diagnostics;
}

}  // namespace

std::expected<MachineConfig, Diagnostics> parse_machine(std::string_view text) {
    TextSource source;
    proto::Machine message;
    if (Diagnostics errors = source.parse(text, message); !errors.empty()) { return std::unexpected(errors); }
    MachineDraft draft = machine_from_proto(message);
    const Problems problems = problems_of(draft, source);
    if (!problems.empty()) { return std::unexpected(placed(problems, source)); }
    return std::move(draft.machine);
}

std::expected<MachineConfig, Diagnostics> load_machine_file(const std::filesystem::path& path) {
    const auto text = read_text_file(path);
    if (!text) { return std::unexpected(Diagnostics{text.error()}); }
    return parse_machine(*text);
}

std::string machine_text(const MachineConfig& machine) {
    std::string text;
    google::protobuf::TextFormat::PrintToString(machine_to_proto(machine), &text);
    return text;
}

std::uint64_t config_hash(const MachineConfig& machine) {
    return std::max<std::uint64_t>(fnv1a(machine_to_proto(machine).SerializeAsString()), 1);
}

}  // namespace lockstep
