#include "core/gcode/flow/call_stack.hpp"

namespace lockstep::gcode {

std::string CallStack::subroutine() const {
    std::string label;
    for (const Level& level : levels_) { label = level.is_call ? level.run.body().label : label; }
    return label;
}

void CallStack::call(const Body& subroutine, const Arguments& arguments) {
    returned_.reset();
    parameters_.enter(arguments);
    kept_.emplace_back();
    levels_.push_back({.run = BodyRun(subroutine, 1), .is_call = true});
}

Result CallStack::leave(Reader& reader) {
    if (reader.peek() == '[') { returned_ = reader.expression(); }
    innermost().leave();
    return nothing_follows(reader);
}

std::optional<Modal> CallStack::modes_behind() const {
    const bool restores = levels_.back().is_call && kept_.back().restores_at_return;
    return restores ? kept_.back().modal : std::nullopt;
}

void CallStack::end() {
    if (levels_.back().is_call) {
        parameters_.leave();
        kept_.pop_back();
    }
    levels_.pop_back();
}

void CallStack::end_all() {
    while (!levels_.empty()) { end(); }
}

}  // namespace lockstep::gcode
