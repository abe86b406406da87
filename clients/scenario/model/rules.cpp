#include "clients/scenario/model/rules.hpp"

#include <fmt/format.h>

#include "clients/planning/plan_summary.hpp"
#include "clients/scenario/model/act_rules.hpp"
#include "clients/scenario/model/expectation_rules.hpp"
#include "clients/scenario/model/name_rules.hpp"
#include "clients/scenario/model/output_rules.hpp"
#include "clients/scenario/model/problems.hpp"
#include "clients/session/move_program.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::scenario {
namespace {

constexpr double kMostSeconds = 60;
constexpr int kMostFrames = 1000;
constexpr int kMostSteps = 100;

/// 0 if the program does nothing.
std::int32_t last_line_of(const Program& program) {
    std::int32_t last = 0;
    for (const Block& block : program.blocks) { last = std::max(last, block.line.value_or(0)); }
    return last;
}

/// Each probing move is taken to touch at its end.
std::expected<Program, Diagnostics> parse(const ProgramOfRun& program) {
    auto parsed = parse_gcode(program.text, program.setup);
    return parsed ? std::expected<Program, Diagnostics>(*std::move(parsed))
                  : std::unexpected(to_diagnostics(parsed.error()));
}

class Rules {
public:
    Rules(const Scenario& scenario, const TextSource& source)
        : scenario_(scenario),
          asked_(scenario.asked),
          machine_(scenario.machine),
          processes_(processes_of(asked_, machine_)),
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
        check_expectations(asked_.expect(), machine_, problems_);
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
        require_axis(problems_, machine_, path + ".axis", clock.axis());
        const auto& clocks = asked_.wrong_clock();
        const auto of_axis = [&](const Asked::WrongClock& other) { return other.axis() == clock.axis(); };
        problems_.require(&*std::ranges::find_if(clocks, of_axis) == &clock, path + ".axis",
                          "axis " + clock.axis() + " already has a clock; combine both blocks");
        problems_.require(
            machine_.timing.time_source == TimeSource::Network, path,
            "a wrong clock needs a clock for each process; set timing { time_source: NETWORK } in the machine");
        problems_.require(clock.has_offset_s() || clock.has_ppm() || clock.has_step_s(), path,
                          "this clock is not wrong; set offset_s, ppm or step_s");
        problems_.require(clock.has_step_s() || !clock.has_step_at_s(), path + ".step_at_s",
                          "step_at_s is only for a clock with step_s; set how far it is set forward");
        problems_.require(!asked_.separate_devices(), path,
                          "a wrong clock needs devices in the axes' processes; remove separate_devices");
        problems_.require_range(path, "offset_s", clock.offset_s(), -1e6, 1e6);
        problems_.require_range(path, "ppm", clock.ppm(), -1000, 1000);
        problems_.require_range(path, "step_s", clock.step_s(), -1000, 1000);
        problems_.require_range(path, "step_at_s", clock.step_at_s(), 0, 600);
    }

    void check_step(const Asked::Step& step, const std::string& path) {
        last_line_.reset();
        switch (step.what_case()) {
            case Asked::Step::kHome: check_home(step.home(), path + ".home"); break;
            case Asked::Step::kRun: check_run(step.run(), path + ".run"); break;
            case Asked::Step::kMove: check_move(step.move(), path + ".move"); break;
            case Asked::Step::kWait: check_wait(step.wait(), path + ".wait"); break;
            case Asked::Step::kAct:
                check_act(step.act(), path + ".act", asked_, machine_, processes_, problems_);
                break;
            case Asked::Step::WHAT_NOT_SET:
                problems_.add(path, "this step is empty; use one of: home, run, move, wait or act");
        }
        const bool is_job = !step.has_wait() && !step.has_act();
        problems_.require(is_job || step.during_size() == 0, path + ".during",
                          "during is only for home, run and move; make it a separate step");
        problems_.require(is_job || !step.has_ends(), path + ".ends", "ends is only for home, run and move");
        problems_.require(!step.has_act() || !step.has_fault(), path + ".fault", "fault is only for jobs and wait");
        if (step.has_fault()) { require_fault(problems_, path + ".fault", step.fault()); }
        if (is_job) { check_ending(step, path); }
        for (int i = 0; i < step.during_size(); ++i) { check_during(step, i, path + "." + nth("during", i)); }
    }

    /// What the job's end makes impossible.
    void check_ending(const Asked::Step& step, const std::string& path) {
        const bool is_good = step.ends() == Asked::Step::DONE;
        problems_.require(!step.has_fault() || (!is_good && step.ends() != Asked::Step::SILENT), path + ".fault",
                          is_good
                              ? "fault contradicts an end that is DONE; set ends: FAILED or REFUSED, or remove fault"
                              : "fault contradicts an end that is SILENT: no state is received; remove fault");
        problems_.require(
            step.ends() != Asked::Step::REFUSED || step.during_size() == 0, path + ".during[0]",
            "a job that is REFUSED does not begin, so this event never happens; remove it or change ends");
    }

    void check_home(const Asked::Home& home, const std::string& path) {
        for (int i = 0; i < home.axis_size(); ++i) {
            require_axis(problems_, machine_, path + "." + nth("axis", i), home.axis(i));
        }
    }

    /// Checks the program from the position of a homed machine. It is parsed again from the actual position when it
    /// runs.
    void check_run(const Asked::Run& run, const std::string& path) {
        if (run.has_file() == run.has_gcode()) {
            return problems_.add(path, "a run needs one program; set file: \"FILE\" or gcode: \"G1 X10 F600\"");
        }
        const auto program = program_of(run, scenario_.folder(), machine_, parked_mm(machine_));
        const auto parsed = program ? parse(*program) : std::unexpected(program.error());
        if (parsed) {
            last_line_ = last_line_of(*parsed);
            return;
        }
        const std::string key = run.has_file() ? ".file" : ".gcode";
        const std::string name = run.has_file() ? (scenario_.folder() / run.file()).string() : "gcode";
        for (const Diagnostic& error : parsed.error()) { problems_.add(path + key, to_text(name, error)); }
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
        problems_.require(!during.has_line() || !last_line_ || during.line() <= *last_line_, path + ".line",
                          fmt::format("line is {}; the program's last line that does something is {}, so this event "
                                      "never happens; use a line from 1 to {}",
                                      during.line(), last_line_.value_or(0), last_line_.value_or(0)));
        if (during.has_passes()) { require_place(problems_, machine_, path + ".passes", during.passes()); }
        if (during.has_after_s()) { problems_.require_range(path, "after_s", during.after_s(), 0, kMostSeconds); }
        if (during.has_rests_within_frames()) {
            problems_.require_range(path, "rests_within_frames", during.rests_within_frames(), 1, kMostFrames);
        }
        if (during.has_act()) { check_act(during.act(), path + ".act", asked_, machine_, processes_, problems_); }
        check_outputs(during, path, scenario_, problems_);
    }

    const Scenario& scenario_;
    const Asked& asked_;
    const MachineSetup& machine_;
    std::vector<std::string> processes_;
    std::optional<std::int32_t> last_line_;  // of the program of the step; nullopt if it has none, or errors
    Problems problems_;
};

}  // namespace

Diagnostics rule_errors(const Scenario& scenario, const TextSource& source) { return Rules(scenario, source).errors(); }

}  // namespace lockstep::scenario
