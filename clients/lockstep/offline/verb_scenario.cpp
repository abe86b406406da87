// lockstep scenario
#include <fmt/format.h>

#include <memory>

#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/scenario/model/report.hpp"
#include "clients/scenario/model/scenario_text.hpp"
#include "clients/scenario/runner/scenario_runner.hpp"
#include "clients/text/colour.hpp"
#include "clients/text/output.hpp"
#include "services/files/text_file.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using scenario::Scenario;

struct ScenarioOptions {
    std::vector<std::string> files;
    std::string place;  // empty: as each scenario's file says
    std::string image = scenario::RunnerOptions{}.image;
    int at_a_time = 1;
    std::string keep;
    std::string junit;
    bool events = false;
    bool json = false;
};

/// Combines the failures of several files into one.
Failure as_one(const std::vector<Failure>& failures) {
    if (failures.size() == 1) { return failures.front(); }
    Failure all{.exit = kExitBadInput};
    for (const Failure& failure : failures) {
        for (const Diagnostic& error : failure.errors) {
            all.errors.push_back({.message = to_text(failure.file, error)});
        }
    }
    return all;
}

std::optional<scenario::Asked::Place> place_of(const ScenarioOptions& options) {
    scenario::Asked::Place place{};
    if (!scenario::Asked::Place_Parse(options.place, &place)) { return std::nullopt; }
    return place;
}

/// Returns nullopt if a file has errors. Prints all errors of all files.
std::optional<std::vector<Scenario>> read_all(const ScenarioOptions& options, Output& output) {
    std::vector<Scenario> scenarios;
    std::vector<Failure> failures;
    for (const std::string& file : options.files) {
        auto scenario = scenario::load_scenario(file, place_of(options));
        if (scenario) {
            scenarios.push_back(*std::move(scenario));
        } else {
            failures.push_back(bad_file(file, scenario.error()));
        }
    }
    if (failures.empty()) { return scenarios; }
    (void)output.fail(as_one(failures));
    return std::nullopt;
}

std::string coloured(const proto::ScenarioReport& report, bool events) {
    std::string text = scenario::to_text(report, events);
    if (!wants_colour()) { return text; }
    const std::size_t end = text.find('\n');
    return painted(text.substr(0, end), report.held() ? kGood : kBad) + (end == text.npos ? "" : text.substr(end));
}

ExitCode end(const ScenarioOptions& options, const proto::ScenarioRunReport& report, Output& output) {
    output.report(report);
    output.print(fmt::format("{} of {} scenarios passed", report.held(), report.scenarios_size()));
    const auto written = options.junit.empty() ? std::expected<void, std::string>{}
                                               : write_text_file(options.junit, scenario::junit_xml(report));
    if (!written) { output.warn("no JUnit file: " + written.error()); }
    return written && report.failed() == 0 ? kExitDone : kExitFailed;
}

ExitCode run(const ScenarioOptions& options) {
    Output output(options.json);
    const auto scenarios = read_all(options, output);
    if (!scenarios) { return kExitBadInput; }
    const StopSignal stop;
    scenario::RunnerOptions runner{.at_a_time = options.at_a_time, .image = options.image};
    if (!options.keep.empty()) { runner.keep = options.keep; }
    runner.progress = [&](const std::string& line) { output.progress(line); };
    runner.finished = [&](const proto::ScenarioReport& report) { output.print(coloured(report, options.events)); };
    runner.interrupted = [&] { return stop.requested(); };
    const auto report = scenario::run_scenarios(*scenarios, runner);
    if (!report) { return output.fail(bad_input(report.error())); }
    if (stop.requested()) { output.warn("interrupted; the running scenarios are ended"); }
    return end(options, *report, output);
}

ExitCode check(const ScenarioOptions& options) {
    Output output(options.json);
    const auto scenarios = read_all(options, output);
    if (!scenarios) { return kExitBadInput; }
    proto::ScenarioRunReport report;
    for (const Scenario& one : *scenarios) {
        std::string text = scenario::outline(one);
        text.pop_back();
        output.print(text);
        report.add_scenarios()->set_file(one.file.string());
        report.mutable_scenarios()->rbegin()->set_shows(one.asked.shows());
    }
    output.report(report);
    return kExitDone;
}

Verb add_part(Verb verb, const char* name, const char* what, const std::shared_ptr<ScenarioOptions>& options) {
    const Verb part = verb.add_verb(name, what);
    part.add_option("files", options->files, "scenarios, in protobuf's text format").required();
    part.add_option("--place", options->place,
                    "run all scenarios in this kind of place instead of the place in their files: PROCESS, NAMESPACE "
                    "or CONTAINER")
        .one_of({"PROCESS", "NAMESPACE", "CONTAINER"});
    add_json(part, options->json);
    return part;
}

void add_scenario_run(Verb verb) {
    const auto options = std::make_shared<ScenarioOptions>();
    const Verb part = add_part(verb, "run", "run scenarios on machines of real processes, and evaluate them", options);
    part.add_option("--jobs", options->at_a_time, "the number of scenarios that run at the same time")
        .in_range(1, 16)
        .with_default();
    part.add_option("--image", options->image, "podman's image for containers, of deploy/Dockerfile").with_default();
    part.add_option("--keep", options->keep,
                    "keep the logs and the report page whole.html of each scenario in this directory, in a "
                    "subdirectory with its name");
    part.add_option("--junit", options->junit, "also write the results as JUnit's XML into this file");
    part.add_flag("--story", options->events, "also print what happened, with times");
    part.footer(
        "Each scenario runs in network, process and mount namespaces of its own. This requires root and leaves\n"
        "nothing behind.\n" +
        footer("  lockstep scenario run deploy/scenarios/axis-killed.textproto\n"
               "  lockstep scenario run deploy/scenarios/*.textproto --jobs 3 --junit scenarios.xml\n"
               "  lockstep scenario run mine.textproto --story --keep logs\n"
               "  lockstep scenario run deploy/scenarios/axis-killed.textproto --place CONTAINER\n",
               "0 all passed; 1 a scenario failed or could not run; 2 bad usage, or a scenario cannot be read\n"
               "(nothing ran)"));
    part.action([options] { return run(*options); });
}

void add_scenario_check(Verb verb) {
    const auto options = std::make_shared<ScenarioOptions>();
    const Verb part =
        add_part(verb, "check", "read scenarios and print what they would do, without running them", options);
    part.footer(footer("  lockstep scenario check deploy/scenarios/axis-killed.textproto\n",
                       "0 the scenarios can run; 2 bad usage, or a scenario cannot be read"));
    part.action([options] { return check(*options); });
}

}  // namespace

void add_scenario(Verb command) {
    const Verb verb =
        command.add_verb("scenario",
                         "run or check scripted tests of a whole machine\n"
                         "A scenario contains the machine's actions, the faults to inject and what must be "
                         "true.");
    verb.footer("idl/proto/scenario.proto describes scenarios; deploy/scenarios/ has examples.\n" +
                group_footer("  lockstep scenario run deploy/scenarios/axis-killed.textproto\n", "scenario run"));
    add_scenario_run(verb);
    add_scenario_check(verb);
}

}  // namespace lockstep
