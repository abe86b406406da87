#include "core/gcode/run/context.hpp"

#include <cmath>
#include <vector>

namespace lockstep::gcode {

std::unexpected<GcodeError> Context::refuse(char letter, const std::string& what) const {
    return std::unexpected(line.error(block.place(letter), word_text(line, block.place(letter)) + what));
}

std::unexpected<GcodeError> Context::refuse(Group group, const std::string& what) const {
    return std::unexpected(line.error(block.place(group), word_text(line, block.place(group)) + what));
}

std::unexpected<GcodeError> Context::refuse_motion(const std::string& what) const {
    if (block.has(Group::Motion)) { return refuse(Group::Motion, what); }
    for (const char letter : std::string_view("XYZABCUVWIJK")) {
        if (block.has(letter)) {
            const std::string code =
                "G" + std::to_string(motion / 10) + (motion % 10 == 0 ? "" : "." + std::to_string(motion % 10));
            return std::unexpected(line.error(block.place(letter), code + what));
        }
    }
    return std::unexpected(line.error(0, what));
}

Result Context::refuse_compensated(Group group) const {
    if (!is_compensated()) { return {}; }
    return refuse(group, " is not possible while cutter compensation is on; write G40 before it");
}

void Context::emit(const Action& action) const {
    std::vector<Waiting>& waiting = state.cutter.waiting;
    if (waiting.empty()) { return sink(action, line.number()); }
    waiting.push_back({line.number(), action});
}

std::optional<double> Context::axis_word(std::size_t axis) const {
    const auto value = block.find(kAxisLetters[axis]);
    return value ? std::optional(place(axis, *value)) : std::nullopt;
}

Point Context::target() const {
    Point result = state.program;
    for (std::size_t axis = 0; axis < kAxes; ++axis) {
        if (const auto word = axis_word(axis)) { result[axis] = state.modal.relative ? result[axis] + *word : *word; }
    }
    return result;
}

std::optional<int> whole(double value) {
    const double nearest = std::round(value);
    return std::abs(value - nearest) < 1e-4 ? std::optional(static_cast<int>(nearest)) : std::nullopt;
}

}  // namespace lockstep::gcode
