#include "services/documents/machine_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <tuple>

namespace lockstep {
namespace {

using Problems = std::vector<Problem>;

constexpr std::size_t kMaxMachineErrors = 50;

/// Maps the keys of a machine to places in the text.
struct Text {
    const TextSource& source;
    const google::protobuf::Descriptor& document;
    const std::string& block;

    TextSource::Place place_of(const Problem& problem) const {
        const auto& [axis, key] = problem.field;
        const std::string parent = axis ? fmt::format("{}axis[{}]", block, *axis) : block;
        const bool needs_point = axis && !key.empty();
        return source.place_of(document, parent + (needs_point ? "." : "") + key);
    }
};

/// A default can be wrong only because of a written value. So the problem of a default is reported only if no written
/// value has one.
Problems axis_problems(const MachineConfig& machine, std::size_t axis, const Text& text) {
    Problems problems = axis_problems(machine, axis);
    const auto is_written = [&](const Problem& problem) { return text.place_of(problem).is_of_key; };
    if (std::ranges::any_of(problems, is_written)) { std::erase_if(problems, std::not_fn(is_written)); }
    return problems;
}

/// Returns the missing keys first. A block that lacks a key is not checked further.
Problems problems_of(const MachineDraft& draft, const Text& text) {
    Problems problems = draft.missing;
    const auto is_whole = [&](std::optional<std::size_t> axis) {
        return std::ranges::none_of(draft.missing, [&](const Problem& missing) { return missing.field.axis == axis; });
    };
    const auto add = [&](const Problems& more) { problems.insert(problems.end(), more.begin(), more.end()); };
    if (is_whole({})) { add(machine_problems(draft.machine)); }
    for (std::size_t axis = 0; axis < std::min(draft.machine.axes.size(), kMaxAxes); ++axis) {
        if (!is_whole(axis)) { continue; }
        add(axis_problems(draft.machine, axis, text));
        add(motor_problems(draft.machine, axis));
    }
    if (problems.empty()) { add(board_problems(draft.machine)); }
    if (problems.empty()) { add(screw_problems(draft.machine)); }
    if (problems.empty()) { add(board_link_problems(draft.machine)); }
    if (problems.empty()) { add(kinematics_problems(draft.machine)); }
    if (problems.empty()) { add(backlash_problems(draft.machine)); }
    if (problems.empty()) {
        add(correction_problems(draft.machine));
        add(pin_problems(draft.machine));
        add(input_problems(draft.machine));
        add(output_problems(draft.machine));
        add(workpiece_problems(draft.machine));
    }
    return problems;
}

}  // namespace

Diagnostics machine_errors(const MachineDraft& draft, const TextSource& source,
                           const google::protobuf::Descriptor& document, const std::string& block) {
    const Text text{source, document, block};
    Diagnostics errors;
    for (const Problem& problem : problems_of(draft, text)) {
        const auto place = text.place_of(problem);
        errors.push_back({place.line, place.column, problem.message});
    }
    std::ranges::stable_sort(errors, {}, [](const Diagnostic& d) { return std::tuple(d.line, d.column); });
    if (errors.size() > kMaxMachineErrors) { errors.resize(kMaxMachineErrors); }
    return errors;
}

}  // namespace lockstep
