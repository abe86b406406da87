#include "clients/web/program/program_reading.hpp"

#include <fmt/format.h>
#include <sys/mman.h>

#include <algorithm>

#include "clients/planning/plan_summary.hpp"
#include "clients/planning/program_text.hpp"
#include "clients/session/program_stream.hpp"
#include "services/documents/program_file.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

constexpr std::size_t kShort_bytes = 2'000'000;  // as in `lockstep run`: read as a whole before anything moves
constexpr std::size_t kMostNotes = 100;

bool is_picture(std::string_view bytes) {
    return bytes.starts_with("\x89PNG") || bytes.starts_with("\xff\xd8") || bytes.starts_with("GIF8");
}

bool is_text(std::string_view text) {
    return !is_picture(text) && std::ranges::none_of(text, [](char c) {
        const bool is_control = static_cast<unsigned char>(c) < ' ';
        return is_control && c != '\t' && c != '\n' && c != '\r' && c != '\f' && c != '\x1a';
    });
}

Problem no_text(std::string_view text) {
    return {.status = 415,
            .code = "not-text",
            .title = "the body is not text",
            .detail = is_picture(text) ? "the body is a picture" : "the body has bytes that text does not contain",
            .place = "body",
            .limit = "a program in G-code",
            .remedy = "choose the program's file"};
}

std::string in_words(const Diagnostic& error) {
    return fmt::format("line {}, column {}: {}", error.line, error.column, error.message);
}

GcodeSetup setup_of(const std::string& name, const MachineSetup& machine, const ProgramStart& start) {
    // Uses only the last part of the program's name: subroutines come only from the machine's directory.
    const std::filesystem::path directory =
        machine.subroutine_directory.empty() ? "/dev/null" : machine.subroutine_directory;
    return program_setup(directory / std::filesystem::path(name).filename(), machine, start.place_mm, {},
                         start.values.values);
}

std::size_t lines_of(std::string_view text) {
    const auto breaks = static_cast<std::size_t>(std::ranges::count(text, '\n'));
    return breaks + (!text.empty() && text.back() != '\n' ? 1 : 0);
}

std::shared_ptr<const ProgramFacts> facts_of(std::string_view text, const std::string& name, std::uint64_t id,
                                             const GcodeReading& reading) {
    auto facts = std::make_shared<ProgramFacts>(
        ProgramFacts{.id = id, .name = name, .bytes = text.size(), .lines = lines_of(text)});
    for (const Block& block : reading.program.blocks) { facts->block_lines.push_back(block.line.value_or(0)); }
    facts->rises = std::ranges::is_sorted(facts->block_lines);
    for (const GcodeNote& note : reading.notes) {
        if (facts->notes.size() < kMostNotes) { facts->notes.push_back({note.line, note.text}); }
    }
    return facts;
}

/// Reads the text from a file in memory, which ends with its last reader.
std::expected<LineReader, std::string> lines_of_text(const std::string& text) {
    const Descriptor file(memfd_create("lockstep-program", MFD_CLOEXEC));
    if (!write_all(file, text)) { return std::unexpected("no memory is left for the program"); }
    return LineReader::open(fmt::format("/proc/self/fd/{}", file.get()));
}

std::expected<ReadyProgram, Problem> ready_lines(const LoadedProgram& program, const GcodeSetup& setup,
                                                 const ProgramStart& start) {
    auto lines = lines_of_text(*program.text);
    if (!lines) { return std::unexpected(wrong_program({{.message = lines.error()}})); }
    return ready_stream(std::make_shared<ProgramStream>(*std::move(lines), setup, start.values.revision),
                        program.facts);
}

std::expected<void, Problem> check_phase(const Snapshot& snapshot) {
    if (snapshot.is_silent || !snapshot.machine) {
        return std::unexpected(
            unanswered("no messages are received from a coordinator, so the machine's position is not known"));
    }
    switch (snapshot.machine->value.phase) {
        case MachinePhase::Fault: return std::unexpected(refused(FaultCode::InFault, ""));
        case MachinePhase::Holding:
        case MachinePhase::Paused: return std::unexpected(refused(FaultCode::Held, ""));
        case MachinePhase::Waiting: return std::unexpected(refused(FaultCode::NotReady, ""));
        case MachinePhase::Idle: return {};
        default: return std::unexpected(refused(FaultCode::Busy, ""));
    }
}

}  // namespace

Problem wrong_program(const Diagnostics& errors) {
    const std::string more = errors.size() > 1 ? fmt::format(", and {} more", errors.size() - 1) : "";
    return {.status = 422,
            .code = "bad-program",
            .title = "the program has errors",
            .detail = errors.empty() ? "" : in_words(errors.front()) + more,
            .place = "body",
            .remedy = "correct the lines and send it again",
            .errors = errors};
}

std::expected<ReadyProgram, Problem> ready_stream(std::shared_ptr<ProgramStream> stream,
                                                  std::shared_ptr<const ProgramFacts> facts,
                                                  std::shared_ptr<const MeasurePlan> measures) {
    if (auto read = stream->read_first(); !read) { return std::unexpected(wrong_program(read.error())); }
    return ReadyProgram{
        stream->head(),   stream->values(), [stream](ProgramSender& sender) { stream->feed(sender, monotonic_now()); },
        std::move(facts), stream,           std::move(measures)};
}

ProgramUpload::Feed feed_of(std::vector<Block>&& blocks) {
    return [blocks = std::make_shared<const std::vector<Block>>(std::move(blocks)),
            next = std::size_t{0}](ProgramSender& sender) mutable {
        for (std::size_t n = sender.free_blocks(); n > 0 && next < blocks->size(); --n) {
            sender.append((*blocks)[next++]);
        }
        if (next == blocks->size()) { sender.end(); }
    };
}

ProgramStart checked_start(const Snapshot& snapshot, const MachineSetup& machine) {
    ProgramStart start{parked_mm(machine), snapshot.values.value_or(RevisedValues{})};
    for (std::size_t i = 0; i < snapshot.axes.size(); ++i) {
        const auto& axis = snapshot.axes[i].state;
        if (!axis || !axis->value.homed || !snapshot.axes[i].is_present) { continue; }
        start.place_mm[i] = to_mm(machine.axes[i], static_cast<double>(axis->value.position.count()));
    }
    return start;
}

std::expected<ProgramStart, Problem> real_start(const Snapshot& snapshot, const MachineSetup& machine) {
    if (auto ready = check_phase(snapshot); !ready) { return std::unexpected(ready.error()); }
    ProgramStart start;
    for (std::size_t i = 0; i < snapshot.axes.size(); ++i) {
        const AxisSnapshot& axis = snapshot.axes[i];
        const std::string name = "axis " + machine.axes[i].name;
        if (!axis.state || !axis.is_present) {
            return std::unexpected(refused(FaultCode::AxisMissing, "no messages are received from " + name));
        }
        if (!axis.state->value.homed) { return std::unexpected(refused(FaultCode::NotHomed, name + " is not homed")); }
        if (!axis.state->value.at_rest) {
            return std::unexpected(refused(FaultCode::NotReady, name + " is in motion"));
        }
        start.place_mm.push_back(to_mm(machine.axes[i], static_cast<double>(axis.state->value.position.count())));
    }
    if (!snapshot.values) {
        return std::unexpected(unanswered("the coordinator has not reported the machine's offsets and tools yet"));
    }
    start.values = *snapshot.values;
    return start;
}

std::expected<LoadedProgram, Problem> load_program(std::string text, const std::string& name, std::uint64_t id,
                                                   const MachineSetup& machine, const ProgramStart& start) {
    if (!is_text(text)) { return std::unexpected(no_text(text)); }
    if (text.empty()) { return std::unexpected(wrong_program({{.message = "the program is empty"}})); }
    const GcodeSetup setup = setup_of(name, machine, start);
    const auto reading = read_gcode(text, setup);
    if (!reading) { return std::unexpected(wrong_program(to_diagnostics(reading.error()))); }
    auto facts = facts_of(text, setup.program_name, id, *reading);
    auto path = std::make_shared<const std::vector<PathPoint>>(path_points(reading->program));
    return LoadedProgram{std::move(facts), std::make_shared<const std::string>(std::move(text)), std::move(path)};
}

std::expected<ReadyProgram, Problem> ready_program(const LoadedProgram& program, const MachineSetup& machine,
                                                   const ProgramStart& start) {
    const GcodeSetup setup = setup_of(program.facts->name, machine, start);
    if (program.text->size() > kShort_bytes) { return ready_lines(program, setup, start); }
    auto reading = read_gcode(*program.text, setup);
    if (!reading) { return std::unexpected(wrong_program(to_diagnostics(reading.error()))); }
    if (does_probe(reading->program)) { return ready_lines(program, setup, start); }
    gcode::ProgramValues values{.revision = start.values.revision, .after = {}};
    if (reading->values != start.values.values) { values.after = std::move(reading->values); }
    const ProgramHead head = reading->program.head();
    return ReadyProgram{head, std::move(values), feed_of(std::move(reading->program.blocks)), program.facts};
}

}  // namespace lockstep::web
