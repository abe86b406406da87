#include "clients/lockstep/offline/program_input.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "clients/lockstep/height_option.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/planning/program_text.hpp"
#include "clients/planning/read_ahead.hpp"
#include "clients/session/program_start.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/format.hpp"
#include "services/documents/program_file.hpp"
#include "services/documents/values/values_document.hpp"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {

namespace {

std::expected<gcode::KeptValues, Failure> values_of(const ProgramOptions& options, const MachineSetup& machine) {
    const std::filesystem::path file = options.values.empty() ? values_file(machine.name).string() : options.values;
    if (const auto text = read_text_file(file); !options.values.empty() && !text) {
        return std::unexpected(bad_file(file, {text.error()}));
    }
    auto values = read_values(file);
    if (!values) { return std::unexpected(bad_file(file, values.error())); }
    return std::move(values->values);
}

/// The machine, its start position and its values, which are needed to read a program.
struct ReadingSetup {
    MachineSetup machine;
    std::vector<double> start_mm;
    gcode::KeptValues values;
    GcodeSwitches switches;
};

std::expected<ReadingSetup, Failure> reading_setup(const ProgramOptions& options) {
    auto machine = choose_machine(options.machine_file);
    if (!machine) { return std::unexpected(machine.error()); }
    auto places = places_at_start(machine->config, options.start);
    if (!places) { return std::unexpected(bad_input("--start: " + places.error())); }
    auto values = values_of(options, machine->config);
    if (!values) { return std::unexpected(values.error()); }
    GcodeSwitches switches = options.switches;
    if (auto heights = read_heights(options.height_map, switches); !heights) {
        return std::unexpected(heights.error());
    }
    return ReadingSetup{std::move(machine->config), *std::move(places), *std::move(values), std::move(switches)};
}

Failure not_planned(const std::string& file, const PlanError& error) {
    return bad_file(file, {{.line = error.line.value_or(0), .message = error.text}});
}

/// Shows progress for each percent of the file.
class Progress {
public:
    Progress(std::string name, const ReadAhead& text, double ticks_per_s, Output& output)
        : name_(std::move(name)), text_(text), ticks_per_s_(ticks_per_s), output_(output) {}

    void show(Ticks motion) {
        const auto share = static_cast<int>(100 * text_.share_read());
        if (std::exchange(shown_, share) == share) { return; }
        output_.progress(fmt::format("{}: {} %, {} lines, {} of motion", name_, share, text_.lines(),
                                     duration_text(static_cast<double>(motion.value) / ticks_per_s_)));
    }

private:
    std::string name_;
    const ReadAhead& text_;
    double ticks_per_s_;
    Output& output_;
    int shown_ = 0;
};

/// Reads in a thread of its own. Returns when that has ended.
std::expected<ProgramPlan, PlanError> plan_as_read(const MachineSetup& machine,
                                                   const std::shared_ptr<ProgramText>& text, const std::string& file,
                                                   Output& output, const OnSetup& on_setup) {
    const ProgramHead head = text->head();
    const auto blocks = std::make_shared<ReadAhead>(text);
    Progress progress(file, *blocks, machine.ticks_per_second(), output);
    auto plan = plan_blocks(machine, head, blocks,
                            {.start = start_counts(machine, head),
                             .overrides = {},
                             .each_frame = on_setup ? on_setup(machine) : OnPlannedFrame{},
                             .progress = [&](Ticks motion) { progress.show(motion); }});
    blocks->stop();
    return plan;
}

/// The text has an error before the one of the plan. It was read some thousand lines farther than it was planned.
bool has_error_before(ProgramText& text, const PlanError& error) {
    return !text.errors().empty() && (!error.line || text.errors().front().line <= *error.line);
}

int lines_in(std::string_view text) {
    const bool ends_open = !text.empty() && text.back() != '\n';
    return static_cast<int>(std::ranges::count(text, '\n')) + (ends_open ? 1 : 0);
}

/// The whole text of a file that is not long: its subroutines may be behind their calls, and all its errors are
/// reported before one of the plan. Empty for a long file.
std::expected<std::string, Diagnostic> text_if_short(const std::string& file) {
    return is_long_program(file) ? std::string() : read_text_file(file);
}

}  // namespace

void add_program_options(Verb verb, ProgramOptions& options) {
    verb.add_option("file", options.file, "the G-code file").required();
    verb.add_option("--machine", options.machine_file, "the machine's configuration file; default: $LOCKSTEP_MACHINE");
    verb.add_option("--values", options.values,
                    "a file of offsets and tools; default: those that the coordinator keeps on this host, if any");
    verb.add_flag("--ignore-unassigned", options.switches.ignore_unassigned,
                  "ignore words for devices that the machine does not have, instead of refusing them");
    add_height_map(verb, options.height_map);
    add_json(verb, options.json);
}

void add_start(Verb verb, ProgramOptions& options) {
    verb.add_option("--start", options.start,
                    "the start position in mm: X=10,Y=5; axes that are not named are at their park positions");
}

std::expected<ProgramInput, Failure> read_program(const ProgramOptions& options, const OnSetup& on_setup) {
    const std::string& file = options.file;
    if (const auto text = read_text_file(file); !text) { return std::unexpected(bad_file(file, {text.error()})); }
    auto setup = reading_setup(options);
    if (!setup) { return std::unexpected(setup.error()); }
    auto read = read_program_file(file, setup->machine, setup->start_mm, setup->switches, setup->values);
    if (!read) { return std::unexpected(bad_file(file, read.error())); }
    auto plan =
        plan_program(setup->machine, read->reading.program, on_setup ? on_setup(setup->machine) : OnPlannedFrame{});
    if (!plan) { return std::unexpected(not_planned(file, plan.error())); }
    const int lines = lines_in(read->text);
    return ProgramInput{
        {std::move(setup->machine), *std::move(plan), lines, std::move(read->reading.notes), std::move(read->setup)},
        std::move(read->reading.program),
        std::move(read->text)};
}

std::expected<PlannedFile, Failure> plan_file(const ProgramOptions& options, Output& output, const OnSetup& on_setup) {
    const auto whole = text_if_short(options.file);
    if (!whole) { return std::unexpected(bad_file(options.file, {whole.error()})); }
    auto setup = reading_setup(options);
    if (!setup) { return std::unexpected(setup.error()); }
    auto lines = LineReader::open(options.file);
    if (!lines) { return std::unexpected(bad_file(options.file, {{.message = lines.error()}})); }
    GcodeSetup reading = program_setup(options.file, setup->machine, setup->start_mm, setup->switches, setup->values);
    const auto text = std::make_shared<ProgramText>(*std::move(lines), reading, *whole);
    auto plan = plan_as_read(setup->machine, text, options.file, output, on_setup);
    if (!whole->empty() && (!plan || !text->errors().empty() || text->passed() > kMaxProgramBlocks)) {
        const std::vector<GcodeError> errors = check_gcode(*whole, reading);
        if (!errors.empty()) { return std::unexpected(bad_file(options.file, to_diagnostics(errors))); }
    }
    if (!plan && !has_error_before(*text, plan.error())) {
        return std::unexpected(not_planned(options.file, plan.error()));
    }
    if (!text->errors().empty()) { return std::unexpected(bad_file(options.file, text->errors())); }
    const int line_count = whole->empty() ? text->lines() : lines_in(*whole);
    return PlannedFile{std::move(setup->machine), *std::move(plan), line_count, text->notes(), std::move(reading)};
}

}  // namespace lockstep
