#include "clients/lockstep/measure/measure_run.hpp"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "clients/lockstep/job/job.hpp"
#include "clients/session/control/lease_turn.hpp"
#include "clients/session/control/open_probe.hpp"
#include "clients/session/control/store_values.hpp"
#include "clients/session/job_plan.hpp"
#include "clients/session/measuring/keep_measurement.hpp"
#include "clients/session/measuring/measuring_stream.hpp"
#include "clients/session/move_program.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/waits.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "services/documents/heights/height_file.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

/// Fails if the file cannot be written, so that no measurement is lost.
std::expected<void, Failure> check_file(const std::string& path) {
    if (path.empty()) { return {}; }
    const auto written = write_text_file(path, std::string(kHeightColumns) + "\n");
    return written ? std::expected<void, Failure>{} : std::unexpected(bad_input(written.error()));
}

/// Sets the coordinate system or the tool. Returns what was set.
std::expected<std::string, Failure> keep(Session& session, const MeasureVerbOptions& options,
                                         const proto::Measurement& measured, const std::vector<double>& start_mm) {
    const MachineSetup& machine = session.config();
    auto values = await_values(session);
    if (!values) { return std::unexpected(values.error()); }
    gcode::KeptValues wanted = values->values;
    const bool sets_tool = measured.has_tool_length_mm();
    const Changed changed = sets_tool ? keep_in_tool(machine, options.tool, measured, wanted)
                                      : keep_in_system(machine, options.set, measured, 0, start_mm, wanted);
    if (!changed) { return std::unexpected(bad_input(changed.error())); }
    if (const auto stored = store_values(session, *values, wanted); !stored) { return std::unexpected(stored.error()); }
    return sets_tool ? fmt::format("; the length of tool {} is set", options.tool) : "; " + options.set + " is set";
}

std::vector<double> touches_z(const MachineSetup& machine, const proto::RunReport& report) {
    const auto z = find_axis(machine, "Z");
    std::vector<double> places;
    for (const proto::ProbeReport& touch : report.probes()) {
        places.push_back(touch.places(static_cast<int>(z.value())).position_mm());
    }
    return places;
}

/// Everything that can be refused is refused here, before anything moves.
std::expected<MeasuringProgram, Failure> prepare(const MeasureVerbOptions& options, const Session& session,
                                                 const std::vector<double>& start_mm) {
    const MachineSetup& machine = session.config();
    auto program = measuring_program(machine, start_mm, options.measure);
    if (!program) { return std::unexpected(bad_input(text_of(program.error()))); }
    gcode::KeptValues unused;
    if (!options.set.empty()) {
        if (const auto known = set_offset(machine, options.set, {"R=0"}, unused); !known) {
            return std::unexpected(bad_input("--set: " + known.error()));
        }
    }
    if (const auto open = check_open(session, program->probe); !open) { return std::unexpected(open.error()); }
    if (const auto file = check_file(options.csv); !file) { return std::unexpected(file.error()); }
    return *std::move(program);
}

}  // namespace

ExitCode run_measurement(const MeasureVerbOptions& options) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    auto session = Session::open(*machine, Purpose::Command);
    if (!session) { return output.fail(session.error()); }
    const auto start_mm = start_places(*session);
    if (!start_mm) { return output.fail(start_mm.error()); }
    const auto program = prepare(options, *session, *start_mm);
    if (!program) { return output.fail(program.error()); }
    const auto values = await_values(*session);
    if (!values) { return output.fail(values.error()); }
    const std::string name = title_of(options.measure.kind);
    ProgramStream stream =
        measuring_stream(session->config(), *start_mm, options.measure.kind, *program, values->revision);
    if (const auto read = stream.read_first(); !read) { return output.fail(bad_file(name, read.error())); }
    const auto conclude = [&](proto::RunReport& report) -> std::expected<std::string, Failure> {
        const auto measured = measurement_of(
            options.measure, *program, [&](auto value) { return stream.global(value); },
            touches_z(session->config(), report));
        if (!measured) { return std::unexpected(failed(name + ": the program ended without a result")); }
        *report.mutable_measured() = *measured;
        std::string text = text_of(*measured);
        if (!options.csv.empty()) {
            const auto written = write_text_file(options.csv, csv_of(*measured));
            if (!written) { return std::unexpected(failed(written.error())); }
            text += "; written to " + options.csv;
        }
        if (options.set.empty() && options.tool == 0) { return text; }
        const auto kept = keep(*session, options, *measured, *start_mm);
        return kept ? std::expected<std::string, Failure>(text + *kept) : std::unexpected(kept.error());
    };
    const Job job{.command = CommandKind::Run,
                  .kind = "probe",
                  .name = std::string(name_of(options.measure.kind)),
                  .stream = &stream,
                  .take = options.take,
                  .conclude = conclude};
    return run_job(*session, job, output);
}

}  // namespace lockstep
