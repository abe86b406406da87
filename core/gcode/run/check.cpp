// Checks of a block before it is run: which words may be together, and which motion it runs.
#include <algorithm>

#include "core/gcode/run/steps.hpp"

namespace lockstep::gcode {
namespace {

constexpr int kCancelCycles = 800;  // G80
constexpr std::string_view kLettersOfCodes = "DEHIJKLPQR";

/// G10 G28 G30 G52 G92 use the block's axis words, so a motion of the block cannot use them.
bool uses_axes(int non_modal) {
    constexpr std::array kWithAxes{100, 280, 300, 520, 920};
    return std::ranges::find(kWithAxes, non_modal) != kWithAxes.end();
}

bool is_arc(int motion) { return motion == 20 || motion == 30; }

std::unexpected<GcodeError> no_motion(const Context& context) {
    const LineWords& block = context.block;
    for (const char letter : kAxisLetters) {
        if (block.has(letter)) {
            return context.refuse(letter, " needs a motion mode; write G0 or G1 before the first axis word");
        }
    }
    return std::unexpected(context.line.error(0, "@ or ^ needs a motion mode; write G0 or G1"));
}

std::string_view letters_of(int motion) {
    const Code* code = motion == kNoMotion ? nullptr : find_code('G', motion);
    return code == nullptr ? std::string_view{} : code->letters;
}

bool is_m(Group group) { return group >= Group::Stop; }

bool is_used(const Context& context, char letter) {
    if (letters_of(context.motion).contains(letter)) { return true; }
    for (std::size_t i = 0; i < kGroups; ++i) {
        const auto group = static_cast<Group>(i);
        if (!context.block.has(group)) { continue; }
        const Code* code = find_code(is_m(group) ? 'M' : 'G', context.block.code(group));
        if (code->letters.contains(letter)) { return true; }
    }
    return false;
}

}  // namespace

Result choose_motion(Context& context) {
    const LineWords& block = context.block;
    const int code = block.code(Group::Motion);
    const int other = block.code(Group::NonModal);
    const int length = block.code(Group::ToolLength);
    const bool axes = block.has_axes();
    const bool taken = uses_axes(other) || length == 431 || length == 432;
    if (code != LineWords::kNoCode && code != kCancelCycles) {
        if (uses_axes(other)) {
            return context.refuse(Group::Motion, " and " + word_text(context.line, block.place(Group::NonModal)) +
                                                     " both use the block's axis words; use two lines");
        }
        context.motion = code;
        return {};
    }
    if (axes && !taken) {
        const int motion = code == kCancelCycles ? kNoMotion : context.state.modal.motion;
        if (motion == kNoMotion) { return no_motion(context); }
        context.motion = motion;
    } else if (code == LineWords::kNoCode && is_arc(context.state.modal.motion) && !taken && block.has_any("IJK")) {
        context.motion = context.state.modal.motion;
    }
    return {};
}

Result check_letters(Context& context) {
    if (context.block.code(Group::NonModal) == 40 && is_arc(context.motion)) {
        return context.refuse(Group::NonModal, " is in the same block as an arc, and both use P; use two lines");
    }
    for (const char letter : kLettersOfCodes) {
        if (!context.block.has(letter) || is_used(context, letter)) { continue; }
        return context.refuse(letter, std::string(" belongs to no code of this block; remove it, or write the code "
                                                  "that ") +
                                          letter + " is for");
    }
    return {};
}

}  // namespace lockstep::gcode
