#include "clients/web/program/mdi_session.hpp"

#include "core/gcode/session/probe_touch.hpp"
#include "services/documents/program_file.hpp"

namespace lockstep::web {
namespace {

constexpr const char* kName = "mdi";

Problem line_waits() { return refused(FaultCode::Busy, "the line before is not answered yet"); }

std::shared_ptr<const ProgramFacts> facts_of(const std::string& text, const SessionLine& line) {
    auto facts = std::make_shared<ProgramFacts>(ProgramFacts{.name = kName, .bytes = text.size(), .lines = 1});
    facts->block_lines.assign(line.blocks.size(), 1);
    for (const GcodeNote& note : line.notes) { facts->notes.push_back({note.line, note.text}); }
    return facts;
}

}  // namespace

MdiSession::MdiSession(const MachineSetup& machine)
    : machine_(machine), session_(session_setup(machine, kName), machine) {}

std::expected<std::optional<ReadyProgram>, Problem> MdiSession::read(const std::string& line,
                                                                     const ProgramStart& start) {
    const std::lock_guard lock(mutex_);
    if (is_waiting_) { return std::unexpected(line_waits()); }
    auto read = session_.read(line, {start.place_mm, start.values.values});
    if (!read) { return std::unexpected(wrong_program(to_diagnostics({read.error()}))); }
    is_waiting_ = true;
    probing_job_.reset();
    std::optional<ReadyProgram> program;
    if (read->changes_values || !read->blocks.empty()) {
        const auto facts = facts_of(line, *read);
        gcode::ProgramValues values{.revision = start.values.revision, .after = {}};
        if (read->changes_values) { values.after = read->values; }
        program = ReadyProgram{read->head, std::move(values), feed_of(std::move(read->blocks)), facts};
    }
    waiting_ = *std::move(read);
    return program;
}

void MdiSession::answer(bool is_accepted, std::optional<std::uint64_t> job) {
    const std::lock_guard lock(mutex_);
    if (waiting_ && is_accepted) {
        session_.commit(*waiting_);
        if (waiting_->awaits_touch) { probing_job_ = job; }
    }
    waiting_.reset();
    is_waiting_ = false;
}

void MdiSession::note(const std::string& line, bool is_accepted) {
    const std::lock_guard lock(mutex_);
    lines_.emplace_back(line, is_accepted);
    if (lines_.size() > kMostLines) { lines_.pop_front(); }
}

void MdiSession::see(const Snapshot& snapshot) {
    if (!snapshot.machine) { return; }
    if (snapshot.machine->value.phase == MachinePhase::Fault) { reset(); }
    const std::lock_guard lock(mutex_);
    session_.set_devices(snapshot.machine->value.devices);
    take_touch(snapshot);
}

/// The result may be known before all axes are at rest. If it is not of this machine, the next line is the first one.
void MdiSession::take_touch(const Snapshot& snapshot) {
    const MachineState& machine = snapshot.machine->value;
    if (!probing_job_ || !machine.probe || machine.probe->job != *probing_job_) { return; }
    if (machine.phase != MachinePhase::Idle) { return; }
    std::vector<double> rest_mm;
    for (std::size_t i = 0; i < snapshot.axes.size(); ++i) {
        const auto& axis = snapshot.axes[i].state;
        if (!axis || !axis->value.at_rest) { return; }
        rest_mm.push_back(to_mm(machine_.axes[i], static_cast<double>(axis->value.position.count())));
    }
    const auto touch = touch_from(*machine.probe, std::move(rest_mm));
    touch ? session_.touched(*touch) : session_.reset();
    probing_job_.reset();
}

void MdiSession::end_program() {
    const std::lock_guard lock(mutex_);
    session_.end_program();
}

void MdiSession::reset() {
    const std::lock_guard lock(mutex_);
    session_.reset();
    waiting_.reset();
}

LineModes MdiSession::modes() const {
    const std::lock_guard lock(mutex_);
    return {active_words(session_.state()), session_.state().modal.system};
}

std::deque<std::pair<std::string, bool>> MdiSession::lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
}

}  // namespace lockstep::web
