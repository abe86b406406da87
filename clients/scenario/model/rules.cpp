#include "clients/scenario/model/rules.hpp"

#include <fmt/format.h>

#include "clients/incident/cause.hpp"
#include "clients/planning/plan_summary.hpp"
#include "clients/scenario/model/act_rules.hpp"
#include "clients/scenario/model/problems.hpp"
#include "clients/session/move_program.hpp"
#include "core/faults.hpp"

namespace lockstep::scenario {
namespace {

constexpr double kMostSeconds = 60;
constexpr int kMostFrames = 1000;
constexpr int kMostSteps = 100;

class Rules {
public:
    Rules(const Scenario& scenario, const TextSource& source)
        : scenario_(scenario),
          asked_(scenario.asked),
          machine_(scenario.machine),
          processes_(processes_of(asked_, machine_)),
          axes_(machine_.axis_names()),
          problems_(source) {}

    Diagnostics errors() {
        check_setup();
        for (int i = 0; i < asked_.wrong_clock_size(); ++i) {
            check_clock(asked_.wrong_clock(i), nth("wrong_clock", i));
        }
        problems_.require(asked_.step_size() > 0, "", "there is no step; add one, such as step { home {} }");
        problems_.require(asked_.step_size() <= kMostSteps, nth("step", kMostSteps),
                          fmt::format("there are {} steps; at most {} are allowed", asked_.step_size(), kMostSteps));
        for (int i = 0; i < asked_.step_size(); ++i) { check_step(asked_.step(i), nth("step", i)); }
        check_expectations(asked_.expect());
        return problems_.take();
    }

private:
    void check_setup() {
        problems_.require(!asked_.shows().empty(), "shows",
                          "shows is missing; describe in one sentence what this scenario shows");
        problems_.require(asked_.standby() || !asked_.continues(), "continues",
                          "continues is only for a scenario with standby; without one, no coordinator takes over");
        const bool may_stand_by = !asked_.standby() || machine_.timing.time_source != TimeSource::Network;
        problems_.require(may_stand_by, "standby",
                          "standby needs time_source SHARED or PTP; with NETWORK the time is that of one coordinator");
    }

    void check_clock(const Asked::WrongClock& clock, const std::string& path) {
        require_axis(path + ".axis", clock.axis());
        const auto& clocks = asked_.wrong_clock();
        const auto of_axis = [&](const Asked::WrongClock& other) { return other.axis() == clock.axis(); };
        problems_.require(&*std::ranges::find_if(clocks, of_axis) == &clock, path + ".axis",
                          "axis " + clock.axis() + " already has a clock; combine both blocks");
        problems_.require(
            machine_.timing.time_source == TimeSource::Network, path,
            "a wrong clock needs a clock for each process; set timing { time_source: NETWORK } in the machine");
        problems_.require(!asked_.separate_devices(), path,
                          "a wrong clock needs devices in the axes' processes; remove separate_devices");
        problems_.require_range(path, "offset_s", clock.offset_s(), -1e6, 1e6);
        problems_.require_range(path, "ppm", clock.ppm(), -1000, 1000);
        problems_.require_range(path, "step_s", clock.step_s(), -1000, 1000);
        problems_.require_range(path, "step_at_s", clock.step_at_s(), 0, 600);
    }

    void check_step(const Asked::Step& step, const std::string& path) {
        switch (step.what_case()) {
            case Asked::Step::kHome: check_home(step.home(), path + ".home"); break;
            case Asked::Step::kRun: check_run(step.run(), path + ".run"); break;
            case Asked::Step::kMove: check_move(step.move(), path + ".move"); break;
            case Asked::Step::kWait: check_wait(step.wait(), path + ".wait"); break;
            case Asked::Step::kAct: check_act(step.act(), path + ".act", asked_, processes_, problems_); break;
            case Asked::Step::WHAT_NOT_SET:
                problems_.add(path, "this step is empty; use one of: home, run, move, wait or act");
        }
        const bool is_job = !step.has_wait() && !step.has_act();
        problems_.require(is_job || step.during_size() == 0, path + ".during",
                          "during is only for home, run and move; make it a separate step");
        problems_.require(is_job || !step.has_ends(), path + ".ends", "ends is only for home, run and move");
        problems_.require(!step.has_act() || !step.has_fault(), path + ".fault", "fault is only for jobs and wait");
        if (step.has_fault()) { require_fault(path + ".fault", step.fault()); }
        for (int i = 0; i < step.during_size(); ++i) { check_during(step, i, path + "." + nth("during", i)); }
    }

    void check_home(const Asked::Home& home, const std::string& path) {
        for (int i = 0; i < home.axis_size(); ++i) { require_axis(path + "." + nth("axis", i), home.axis(i)); }
    }

    /// Checks the program from the position of a homed machine. It is parsed again from the actual position when it
    /// runs.
    void check_run(const Asked::Run& run, const std::string& path) {
        if (run.has_file() == run.has_gcode()) {
            return problems_.add(path, "a run needs one program; set file: \"FILE\" or gcode: \"G1 X10 F600\"");
        }
        const auto program = program_of(run, scenario_.folder(), machine_, parked_mm(machine_));
        if (program) { return; }
        const std::string key = run.has_file() ? ".file" : ".gcode";
        const std::string name = run.has_file() ? (scenario_.folder() / run.file()).string() : "gcode";
        for (const Diagnostic& error : program.error()) { problems_.add(path + key, to_text(name, error)); }
    }

    void check_move(const Asked::Move& move, const std::string& path) {
        if (move.to().empty()) { return problems_.add(path, "a move needs a target; set to: \"X=10\""); }
        MoveOptions options{.targets = {move.to().begin(), move.to().end()}};
        if (move.has_feed_mm_min()) { options.feed_mm_min = move.feed_mm_min(); }
        const auto program = move_program(machine_, parked_mm(machine_), options);
        if (!program) { problems_.add(path + ".to[0]", program.error()); }
    }

    void check_wait(const Asked::Wait& wait, const std::string& path) {
        problems_.require(wait.has_seconds() != wait.has_phase(), path,
                          "a wait needs one condition; set seconds: 0.5 or phase: IDLE");
        if (wait.has_seconds()) { problems_.require_range(path, "seconds", wait.seconds(), 0, kMostSeconds); }
    }

    void check_during(const Asked::Step& step, int index, const std::string& path) {
        const Asked::During& during = step.during(index);
        problems_.require(during.has_act(), path, "this event injects nothing; add act { kill: \"axis-X\" }");
        problems_.require(!during.has_line() || step.has_run(), path + ".line",
                          "only a run has lines; use another event, or after_s alone");
        problems_.require(!during.has_line() || during.line() >= 1, path + ".line",
                          fmt::format("line is {}; lines are numbered from 1", during.line()));
        if (during.has_passes()) { require_place(during.passes(), path + ".passes"); }
        if (during.has_after_s()) { problems_.require_range(path, "after_s", during.after_s(), 0, kMostSeconds); }
        if (during.has_rests_within_frames()) {
            problems_.require_range(path, "rests_within_frames", during.rests_within_frames(), 1, kMostFrames);
        }
        if (during.has_act()) { check_act(during.act(), path + ".act", asked_, processes_, problems_); }
    }

    void check_expectations(const Asked::Expect& expect) {
        const std::string path = "expect";
        for (int i = 0; i < expect.final_size(); ++i) { check_final(expect.final(i), path + "." + nth("final", i)); }
        problems_.require(
            !expect.has_path_within_mm() || expect.path_within_mm() > 0, "expect.path_within_mm",
            "path_within_mm is " + number_text(expect.path_within_mm()) +
                "; it must be above 0; the smallest distance that can be kept is a step, 1 / steps_per_mm");
        problems_.require(expect.interruptions() >= 0, "expect.interruptions",
                          fmt::format("interruptions is {}; it must be at least 0", expect.interruptions()));
        problems_.require(expect.together_size() != 1, "expect.together[0]", "this compares axes; name at least two");
        for (int i = 0; i < expect.together_size(); ++i) {
            require_axis(nth("expect.together", i), expect.together(i));
        }
        for (int i = 0; i < expect.vetoes().by_size(); ++i) {
            require_axis(nth("expect.vetoes.by", i), expect.vetoes().by(i));
        }
        if (expect.has_cause()) { check_cause(expect.cause()); }
        for (int i = 0; i < expect.axis_size(); ++i) {
            const std::string axis = path + "." + nth("axis", i);
            require_axis(axis + ".name", expect.axis(i).name());
            if (expect.axis(i).has_fault()) { require_fault(axis + ".fault", expect.axis(i).fault(), true); }
        }
    }

    void check_final(const Asked::Final& end, const std::string& path) {
        Asked::Target target;
        target.set_axis(end.axis());
        if (end.has_mm()) { target.set_mm(end.mm()); }
        require_place(target, path);
        problems_.require(!end.has_within_mm() || end.within_mm() > 0, path + ".within_mm",
                          "within_mm is " + number_text(end.within_mm()) +
                              "; it must be above 0; remove it to require the exact step");
    }

    void check_cause(const Asked::Cause& cause) {
        std::vector<std::string> kinds;
        for (int i = 0; i <= static_cast<int>(incident::CauseKind::Unknown); ++i) {
            kinds.emplace_back(name_of(static_cast<incident::CauseKind>(i)));
        }
        problems_.require_one_of("expect.cause.kind", cause.kind(), kinds, "cause");
        if (cause.has_process()) {
            problems_.require_one_of("expect.cause.process", cause.process(), processes_, "process");
        }
    }

    void require_axis(const std::string& path, const std::string& name) {
        problems_.require_one_of(path, name, axes_, "axis");
    }

    void require_place(const Asked::Target& target, const std::string& path) {
        require_axis(path + ".axis", target.axis());
        const auto axis = std::ranges::find(machine_.axes, target.axis(), &AxisConfig::name);
        if (axis == machine_.axes.end()) { return; }
        problems_.require(target.has_mm(), path, "mm is missing; set the position in machine coordinates");
        if (target.has_mm()) {
            problems_.require_range(path, "mm", target.mm(), axis->position_min_mm, axis->position_max_mm);
        }
    }

    void require_fault(const std::string& path, const std::string& name, bool may_be_none = false) {
        const bool is_one = find_fault(name) != nullptr || (may_be_none && name == "none");
        problems_.require(is_one, path,
                          "there is no fault '" + name + "'; use its name in lockstep status, such as axis-lost");
    }

    const Scenario& scenario_;
    const Asked& asked_;
    const MachineConfig& machine_;
    std::vector<std::string> processes_;
    std::vector<std::string> axes_;
    Problems problems_;
};

}  // namespace

Diagnostics rule_errors(const Scenario& scenario, const TextSource& source) { return Rules(scenario, source).errors(); }

}  // namespace lockstep::scenario
