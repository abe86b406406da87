#include "clients/scenario/model/evaluation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/scenario/model/expectation_text.hpp"
#include "clients/scenario/model/final_place.hpp"
#include "clients/scenario/model/output_course.hpp"
#include "clients/scenario/model/problems.hpp"
#include "clients/scenario/model/scenario_text.hpp"
#include "clients/session/reports.hpp"
#include "clients/text/format.hpp"

namespace lockstep::scenario {
namespace {

using Names = std::vector<std::string>;

std::string mm_text(double mm) { return fixed(mm, 4) + " mm"; }

class Evaluation {
public:
    Evaluation(const Scenario& scenario, const Observations& observed, const Evidence& evidence)
        : machine_(scenario.machine), expect_(scenario.asked.expect()), observed_(observed), evidence_(evidence) {}

    std::vector<Check> checks() {
        for (const AwaitedRest& rest : observed_.rests) { check_rest(rest); }
        for (const AwaitedOutput& output : observed_.outputs) { check_output(output); }
        for (const auto& end : expect_.final()) { check_final(end); }
        if (expect_.has_path_within_mm()) { check_path(); }
        if (expect_.has_interruptions()) { check_interruptions(); }
        if (expect_.together_size() > 0) { check_together(); }
        if (expect_.has_vetoes()) { check_vetoes(); }
        if (expect_.has_cause()) { check_cause(); }
        for (const auto& end : expect_.axis()) { check_axis(end); }
        if (expect_.has_phase()) { check_phase(); }
        if (!expect_.has_exact() || expect_.exact()) { check_exact(); }
        if (!expect_.has_complete() || expect_.complete()) { check_complete(); }
        return std::move(checks_);
    }

private:
    void add(const std::string& asked, const std::string& found, const std::string& where, bool held) {
        checks_.push_back(check_of(asked, found, where, held));
    }

    void check_rest(const AwaitedRest& rest) {
        const std::string asked =
            fmt::format("{}: {} at rest within {} frames", rest.act, listed(rest.axes), rest.within_frames);
        if (rest.axes.empty()) { return add(asked, "no axis process was running", kAsObserved, false); }
        const auto at = evidence_.record.all_at_rest(rest.axes, rest.at);
        if (!at) { return add(asked, "the record has no rest after it", kWholeLog, false); }
        const double frames =
            static_cast<double>((*at - rest.at).value) / static_cast<double>(machine_.frame_ticks().value);
        add(asked, "after " + fixed(frames, 2) + " frames", place_at(*at), frames <= rest.within_frames);
    }

    void check_output(const AwaitedOutput& output) {
        const FoundOutput found = output_after(output.asked, machine_, evidence_.record, output.at);
        add(output.act + ": " + text_of(output.asked), found.text, place_at(found.at), found.held);
    }

    /// The directory of the incident files within the kept files.
    std::string notes() const { return "state/" + machine_.name + "/record/incidents"; }

    static std::string place_at(Tick tick) { return fmt::format("{}, tick {}", kWholeLog, tick.value); }

    void check_final(const Asked::Final& end) {
        const std::string asked = text_of(end);
        if (!evidence_.analysis) { return add(asked, evidence_.analysis.error(), kWholeLog, false); }
        const AxisIndex axis = machine_.axis_named(end.axis()).value();
        const AxisConfig& config = machine_.axes[axis];
        const auto found = final_place(*evidence_.analysis, machine_, axis);
        if (!found) { return add(asked, found.error(), kWholeLog, false); }
        const std::int64_t off = std::abs(to_steps(config, found->mm) - to_steps(config, end.mm()));
        const bool held =
            end.has_within_mm() ? std::abs(found->mm - end.mm()) <= end.within_mm() : off <= found->off_rest;
        add(asked, "at " + mm_text(found->mm), place_at(found->last) + ", the last step of " + end.axis(), held);
    }

    void check_path() {
        const std::string asked = path_text(expect_);
        if (!evidence_.analysis) { return add(asked, evidence_.analysis.error(), kWholeLog, false); }
        if (!evidence_.analysis->has_largest_distance_mm()) { return add(asked, "not recorded", kWholeLog, false); }
        const double found = evidence_.analysis->largest_distance_mm();
        add(asked, mm_text(found) + " at most", kWholeLog, found <= expect_.path_within_mm());
    }

    void check_interruptions() {
        const std::string asked = interruptions_text(expect_);
        if (!evidence_.analysis) { return add(asked, evidence_.analysis.error(), kWholeLog, false); }
        std::int64_t found = 0;
        for (const auto& job : evidence_.analysis->jobs()) { found += job.interruptions(); }
        add(asked, std::to_string(found), std::string(kWholeLog) + ", jobs", found == expect_.interruptions());
    }

    void check_together() {
        const Names axes{expect_.together().begin(), expect_.together().end()};
        const auto parting = evidence_.record.parting(axes);
        const auto epochs = evidence_.record.epochs_of(axes);
        add(together_text(expect_), parting ? *parting : fmt::format("the same in all {} epochs", epochs),
            std::string(kWholeLog) + ", runs", !parting && epochs > 0);
    }

    void check_vetoes() {
        Names asked{expect_.vetoes().by().begin(), expect_.vetoes().by().end()};
        std::ranges::sort(asked);
        const Names found{evidence_.vetoed_by.begin(), evidence_.vetoed_by.end()};
        const bool held = std::ranges::includes(asked, found) && found.empty() == asked.empty();
        add(text_of(expect_.vetoes()), "by " + listed_or_none(found), notes(), held);
    }

    void check_cause() {
        const Asked::Cause& cause = expect_.cause();
        const auto is_asked = [&](const FoundCause& found) {
            return found.kind == cause.kind() && (!cause.has_process() || found.process == cause.process());
        };
        std::string found;
        for (const FoundCause& one : evidence_.causes) {
            found += (found.empty() ? "" : "; ") + one.kind + ": " + one.text;
        }
        add(text_of(cause), found.empty() ? "no incident is recorded" : found, notes(),
            std::ranges::any_of(evidence_.causes, is_asked));
    }

    void check_axis(const Asked::AxisEnd& end) {
        const auto rows = rows_of(observed_.status);
        const auto found = std::ranges::find_if(rows, [&](const auto* row) { return row->name() == end.name(); });
        const proto::AxisStatus* const axis = found == rows.end() ? nullptr : *found;
        const bool is_present = axis != nullptr && axis->present();
        const auto add_fact = [&](const std::string& asked, bool is_asked, bool is_found, const std::string& what) {
            add(asked, is_found ? what : "not " + what, "status at the end", is_asked == is_found);
        };
        if (end.has_heard()) { add_fact(received_text(end), end.heard(), is_present, "received"); }
        if (end.has_homed()) { add_fact(homed_text(end), end.homed(), is_present && axis->homed(), "homed"); }
        if (end.has_corrected_steps()) {
            const std::uint64_t found_steps = axis != nullptr ? axis->corrected_steps() : 0;
            add(corrected_text(end), fmt::format("{} steps", found_steps), "status at the end",
                std::cmp_equal(found_steps, end.corrected_steps()));
        }
        if (!end.has_fault()) { return; }
        const std::string fault = !is_present ? "not received" : axis->has_fault() ? axis->fault().name() : "none";
        add(fault_text(end), fault, "status at the end", fault == end.fault());
    }

    void check_phase() {
        const std::string found = observed_.status.phase();
        add(phase_text(expect_), found.empty() ? "not received" : found, "status at the end",
            expect_.phase() == Asked::ANY || found == text_of(expect_.phase()));
    }

    void check_exact() {
        const std::string asked = kExactText;
        if (!evidence_.verified) { return add(asked, evidence_.verified.error(), kWholeLog, false); }
        const proto::VerifyReport& report = *evidence_.verified;
        const bool differs = report.has_first_difference();
        const std::string found = differs ? report.first_difference().text()
                                          : fmt::format("{} steps compared, none differs", report.steps_compared());
        add(asked, found, kWholeLog, !differs);
    }

    void check_complete() {
        const std::string asked = kCompleteText;
        if (!evidence_.merged) { return add(asked, evidence_.merged.error(), kWholeLog, false); }
        const proto::MergeReport& report = *evidence_.merged;
        std::string found = fmt::format("{} messages, none missing", report.messages());
        if (!report.complete()) {
            found = "missing:";
            for (const auto& axis : report.axes()) {
                found += fmt::format(" {} {} of steps, {} of runs, {} of changes;", axis.axis(),
                                     axis.missing_step_messages(), axis.missing_runs(),
                                     axis.missing_channel_messages() + axis.changes_lost_by_device());
            }
            found += fmt::format(" {} of jobs", report.missing_job_events());
        }
        add(asked, found, kWholeLog, report.complete());
    }

    const MachineConfig& machine_;
    const Asked::Expect& expect_;
    const Observations& observed_;
    const Evidence& evidence_;
    std::vector<Check> checks_;
};

}  // namespace

std::vector<Check> evaluate(const Scenario& scenario, const Observations& observed, const Evidence& evidence) {
    return Evaluation(scenario, observed, evidence).checks();
}

}  // namespace lockstep::scenario
