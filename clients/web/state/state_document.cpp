#include "clients/web/state/state_document.hpp"

#include <algorithm>

#include "clients/web/state/alarm_list.hpp"
#include "clients/web/state/axis_document.hpp"
#include "clients/web/state/devices_document.hpp"
#include "clients/web/state/inputs_document.hpp"
#include "clients/web/state/measurement_document.hpp"
#include "clients/web/state/outputs_document.hpp"
#include "clients/web/state/pause_document.hpp"
#include "clients/web/state/writer_document.hpp"
#include "core/gcode/motion.hpp"
#include "core/gcode/system_names.hpp"
#include "core/protocol/names.hpp"

namespace lockstep::web {
namespace {

using nlohmann::json;

constexpr double kNearEnd = 1e-6;

const char* kind_name(JobKind kind) {
    switch (kind) {
        case JobKind::Home: return "home";
        case JobKind::Move: return "move";
        case JobKind::Run: return "run";
        case JobKind::MoveOwn: return "own-move";
        case JobKind::Return: return "return";
        case JobKind::Jog: break;
    }
    return "jog";
}

json outcome_json(const std::optional<JobOutcome>& outcome) {
    if (!outcome) { return {}; }
    return *outcome == JobOutcome::Done ? "Done" : *outcome == JobOutcome::Stopped ? "Stopped" : "Failed";
}

json line_json(std::optional<std::int32_t> line) { return line ? json(*line) : json(); }

/// The number of blocks on lines before the one in motion; null if lines do not distinguish blocks.
json blocks_done(const ProgramFacts& program, const MachineState& state) {
    if (state.outcome == JobOutcome::Done) { return program.block_lines.size(); }
    if (!program.rises || !state.line) { return {}; }
    return std::ranges::lower_bound(program.block_lines, *state.line) - program.block_lines.begin();
}

bool is_measured(const MachineState& state) {
    return (state.job_kind == JobKind::Run || state.job_kind == JobKind::Move) && !state.outcome;
}

json job_json(const Snapshot& snapshot) {
    if (!snapshot.machine || snapshot.machine->value.job == 0) { return {}; }
    const MachineState& state = snapshot.machine->value;
    const bool is_own = snapshot.job && snapshot.job->number == state.job && snapshot.job->program;
    const ProgramFacts* program = is_own ? snapshot.job->program.get() : nullptr;
    const bool measured = is_measured(state);
    const double done_s = state.progress < 1 - kNearEnd
                              ? state.remaining_s * state.progress / (1 - std::min(state.progress, 1 - kNearEnd))
                              : 0;
    const bool has_done = measured && state.progress < 1 - kNearEnd;
    return {{"number", state.job},
            {"kind", is_own          ? json("run")
                     : state.outcome ? json()
                                     : json(kind_name(state.job_kind))},
            {"name", program != nullptr ? json(program->name) : json()},
            {"line", line_json(state.line)},
            {"blocks_done", program != nullptr ? blocks_done(*program, state) : json()},
            {"blocks_known", program != nullptr ? json(program->block_lines.size()) : json()},
            {"progress", measured ? json(rounded(state.progress, 4)) : json()},
            {"time_done_s", has_done ? json(rounded(done_s, 1)) : json()},
            {"time_left_s", measured ? json(rounded(state.remaining_s, 1)) : json()},
            {"waits_for_program", state.lacks_blocks},
            {"outcome", outcome_json(state.outcome)},
            {"ended_by", state.job_fault != FaultCode::None ? fault_json(state.job_fault, {}) : json()}};
}

json hold_json(const Snapshot& snapshot) {
    if (!snapshot.machine) { return {}; }
    const MachineState& state = snapshot.machine->value;
    if (state.phase != MachinePhase::Holding && state.phase != MachinePhase::Paused) { return {}; }
    const bool rests = std::ranges::all_of(
        snapshot.axes, [](const AxisSnapshot& axis) { return axis.state && axis.state->value.at_rest; });
    return {{"state", rests ? "held" : "braking"}, {"line", line_json(state.line)}};
}

json place_json(const gcode::Point& point, const MachineConfig& machine) {
    json place = json::object();
    for (std::size_t i = 0; i < gcode::kAxes; ++i) {
        const std::string letter(1, gcode::kAxisLetters[i]);
        const bool has_axis =
            std::ranges::any_of(machine.axes, [&](const AxisConfig& axis) { return axis.name == letter; });
        if (has_axis || point[i] != 0) { place[letter] = rounded(point[i], 6); }
    }
    return place;
}

json offsets_json(const Snapshot& snapshot, const MachineConfig& machine, const LineModes& modes) {
    if (!snapshot.values) { return {}; }
    const gcode::KeptValues& values = snapshot.values->values;
    json systems = json::object();
    for (std::size_t i = 0; i < values.systems.size(); ++i) {
        systems[name_of_system(i)] = {{"origin", place_json(values.systems[i].origin, machine)},
                                      {"rotation_deg", values.systems[i].rotation}};
    }
    return {{"revision", snapshot.values->revision},
            {"active", name_of_system(modes.system)},
            {"systems", systems},
            {"g92", values.g92_applies ? place_json(values.g92, machine) : json()}};
}

json tools_json(const Snapshot& snapshot, const MachineConfig& machine) {
    if (!snapshot.values) { return {}; }
    json tools = json::object();
    for (const auto& [number, tool] : snapshot.values->values.tools) {
        tools[std::to_string(number)] = {{"pocket", tool.pocket},
                                         {"offset", place_json(tool.offset, machine)},
                                         {"diameter", rounded(tool.diameter, 6)}};
    }
    return tools;
}

json link_json(const Snapshot& snapshot) {
    return {{"age_ms", snapshot.machine ? json(age_ms(snapshot.machine->time, snapshot.time)) : json()},
            {"standby", snapshot.has_standby},
            {"config_differs", snapshot.config_differs}};
}

}  // namespace

json program_json(const ProgramFacts& program) {
    json notes = json::array();
    for (const ProgramFacts::Note& note : program.notes) {
        notes.push_back({{"line", note.line}, {"text", note.text}});
    }
    return {{"id", program.id},       {"name", program.name}, {"bytes", program.bytes},
            {"lines", program.lines}, {"notes", notes},       {"blocks", program.block_lines.size()}};
}

json state_document(const Snapshot& snapshot, const MachineConfig& machine, const ProgramFacts* loaded,
                    const LineModes& modes, std::size_t viewers) {
    const Overrides overrides = snapshot.machine ? snapshot.machine->value.overrides : Overrides{};
    return {{"machine", machine.name},
            {"mode", snapshot.is_silent || !snapshot.machine ? "Unreachable" : name_of(snapshot.machine->value.phase)},
            {"link", link_json(snapshot)},
            {"job", job_json(snapshot)},
            {"program", loaded != nullptr ? program_json(*loaded) : json()},
            {"hold", hold_json(snapshot)},
            {"pause", pause_document(snapshot, machine)},
            {"override", {{"feed_percent", overrides.feed_percent}, {"rapid_percent", overrides.rapid_percent}}},
            {"alarms", alarm_list(snapshot, machine)},
            {"axes", axes_document(snapshot, machine)},
            {"motors", motors_document(snapshot, machine)},
            {"boards", boards_document(snapshot, machine)},
            {"inputs", inputs_document(snapshot, machine)},
            {"outputs", outputs_document(snapshot, machine)},
            {"offsets", offsets_json(snapshot, machine, modes)},
            {"tools", tools_json(snapshot, machine)},
            {"devices", snapshot.machine ? devices_document(snapshot.machine->value.devices) : json()},
            {"writer", snapshot.writer ? writer_json(*snapshot.writer) : json()},
            {"measurement", snapshot.measurement ? measurement_document(*snapshot.measurement) : json()},
            {"modes", modes.words},
            {"viewers", viewers}};
}

}  // namespace lockstep::web
