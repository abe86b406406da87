#include "clients/lockstep/job/approach_text.hpp"

#include "clients/text/format.hpp"

namespace lockstep {

std::string approach_text(const Program& program, const std::vector<ApproachMove>& moves) {
    if (moves.empty()) { return "  begins where the machine stands\n"; }
    std::string text;
    for (const ApproachMove& step : moves) {
        text += "  " + step.what + " to";
        for (std::size_t i = 0; i < program.axes.size(); ++i) {
            text += " " + program.axes[i] + "=" + fixed(step.move.target_mm[i], 3);
        }
        text += ", " + fixed(step.length_mm, 3) + " mm, " +
                (step.move.rapid ? "as fast as it can" : "F" + fixed(step.move.feed_mm_s * 60, 0)) + "\n";
    }
    return text;
}

std::string modal_text(const MachineConfig& machine, const ModalState& modal) {
    std::string text =
        std::string("  begins with ") + (modal.inches ? "G20" : "G21") + (modal.relative ? " G91" : " G90");
    text += modal.feed_mm_min ? " F" + fixed(*modal.feed_mm_min / (modal.inches ? 25.4 : 1), 1) : ", no feed yet";
    std::string offsets;
    for (const AxisIndex i : axis_indices(machine.axes.size())) {
        if (modal.offset_mm[i] != 0) { offsets += " " + machine.axes[i].name + "=" + fixed(modal.offset_mm[i], 3); }
    }
    return text + (offsets.empty() ? ", no offset" : ", its 0 at" + offsets);
}

void fill_approach(const Program& program, const std::vector<ApproachMove>& moves, proto::RunReport& report) {
    for (const ApproachMove& step : moves) {
        proto::ApproachStep& out = *report.add_approach();
        out.set_what(step.what);
        out.set_length_mm(step.length_mm);
        if (!step.move.rapid) { out.set_feed_mm_min(step.move.feed_mm_s * 60); }
        for (std::size_t i = 0; i < program.axes.size(); ++i) {
            proto::FinalPosition& place = *out.add_to();
            place.set_name(program.axes[i]);
            place.set_position_mm(step.move.target_mm[i]);
        }
    }
}

}  // namespace lockstep
