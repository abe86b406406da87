#include "clients/analysis/sorter.hpp"

#include <utility>

#include "services/documents/machine_file.hpp"
#include "services/documents/names.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::analysis {

void Sorter::take(const StepMessage& message, LogPlace place) {
    Lane* of = lane(message.machine, message.axis, place);
    if (of == nullptr) { return; }
    const auto& batch = message.batch;
    if (!batch) { return on_damage(place, batch.error()); }
    end_.saw(RecordKind::Steps, message.machine, message.axis, batch->incarnation, batch->sequence);
    of->log->take(in_machine_time(*batch));
}

void Sorter::on_position(const axis_position_t& message, LogPlace place) {
    Lane* of = lane(message.machine, message.axis, place);
    if (of == nullptr) { return; }
    const auto position = to_position(message);
    if (!position) { return on_damage(place, "a position with impossible numbers"); }
    end_.saw(RecordKind::Position, message.machine, message.axis, message.incarnation, message.sequence);
    of->log->numbers().positions.add(message.incarnation, message.sequence);
    listener_.on_position(message);
    of->log->take(*position);
}

void Sorter::on_health(const axis_health_t& message, LogPlace place) {
    Lane* of = lane(message.machine, message.axis, place);
    if (of == nullptr) { return; }
    if (!is_countable(message.tick) || !is_message_number(message.sequence)) {
        return on_damage(place, "figures with impossible numbers");
    }
    end_.saw(RecordKind::Health, message.machine, message.axis, message.incarnation, message.sequence);
    of->log->numbers().figures.add(message.incarnation, message.sequence);
    if (message.setpoints > 0) { of->log->take_slack({Tick{message.tick}, message.setpoint_slack_min_ms}); }
}

void Sorter::take(const RunMessage& message, LogPlace place) {
    const Lane* of = lane(message.machine, message.axis, place);
    if (of == nullptr) { return; }
    ++runs_;
    const auto& run = message.run;
    if (!run) { return on_damage(place, run.error()); }
    end_.saw(RecordKind::Run, message.machine, message.axis, run->incarnation, run->sequence);
    of->log->take(*run);
    listener_.on_run(of->number, *run);
}

void Sorter::on_job(const RecordedJob& message, LogPlace place) {
    if (!is_ours(message.machine)) { return; }
    if (!is_countable(message.utime) || !is_countable(message.start_tick) || !is_message_number(message.sequence)) {
        return on_damage(place, "a job with impossible numbers");
    }
    job_numbers_.add(message.coordinator, message.sequence);
    end_.saw(RecordKind::Job, message.machine, "", message.coordinator, message.sequence);
    set_config(message.config);
    listener_.on_job(message, place);
}

void Sorter::on_event(const program_event_t& message, LogPlace place) {
    if (!is_ours(message.machine)) { return; }
    if (!is_message_number(message.sequence)) { return on_damage(place, "an event with an impossible number"); }
    job_numbers_.add(message.coordinator, message.sequence);
    end_.saw(RecordKind::Event, message.machine, "", message.coordinator, message.sequence);
    const auto event = event_of(message);
    if (!event || !is_countable(message.tick)) {
        return on_damage(place, "an event of unknown kind or with impossible numbers");
    }
    listener_.on_event(message, *event);
}

void Sorter::on_program_part(const program_part_t& message, LogPlace /*place*/) {
    if (!is_ours(message.machine) || !is_message_number(message.sequence)) { return; }
    end_.saw(RecordKind::ProgramPart, message.machine, "", message.coordinator, message.sequence);
}

void Sorter::on_mark(const RecordedMark& message, LogPlace /*place*/) {
    if (is_ours(message.machine)) { end_.take(message); }
}

void Sorter::on_channel(const channel_event_t& message, LogPlace place) {
    Lane* of = lane(message.machine, message.axis, place);
    if (of == nullptr) { return; }
    if (!is_message_number(message.sequence)) {
        return on_damage(place, "a change of an input or output with an impossible number");
    }
    end_.saw(RecordKind::Channels, message.machine, message.axis, message.incarnation, message.sequence);
    of->log->numbers().changes.add(message.incarnation, message.sequence);
    listener_.on_channel(message);
}

void Sorter::on_foreign(std::string_view channel) { ++foreign_[std::string(channel)]; }

void Sorter::on_damage(LogPlace place, std::string what) { listener_.on_damage(place, what); }

/// Whether the message is of the analyzed machine. If none was chosen, the first message selects it.
bool Sorter::is_ours(const std::string& machine) {
    if (!machine_) { machine_ = machine; }
    if (machine == *machine_) { return true; }
    on_foreign("machine " + machine);
    return false;
}

/// Returns null if the message is of another machine or has an impossible axis.
Sorter::Lane* Sorter::lane(const std::string& machine, const std::string& axis, LogPlace place) {
    if (!is_axis_name(axis)) {
        on_damage(place, "an axis's name is not valid");
        return nullptr;
    }
    if (!is_ours(machine)) { return nullptr; }
    const auto known = lanes_.find(axis);
    if (known != lanes_.end()) { return &known->second; }
    if (lanes_.size() == kMaxAxes) {
        on_damage(place, "more axes than a machine can have");
        return nullptr;
    }
    const std::size_t number = lanes_.size();
    Lane lane{number, std::make_unique<AxisLog>(axis, options_.keeps_curves(), listener_, number)};
    if (options_.csv_dir) { note_error(lane.log->write_csv(*options_.csv_dir)); }
    if (config_) { lane.log->set_machine(*config_); }
    listener_.on_axis(axis);
    return &(lanes_[axis] = std::move(lane));
}

void Sorter::set_config(const std::string& text) {
    if (config_ || text.empty()) { return; }
    auto parsed = parse_machine(text);
    if (!parsed) { return; }
    config_ = std::move(*parsed);
    for (auto& [name, lane] : lanes_) { lane.log->set_machine(*config_); }
}

void Sorter::note_error(const std::expected<void, std::string>& result) {
    if (!result && !write_error_) { write_error_ = result.error(); }
}

std::expected<void, std::string> Sorter::finish() {
    for (auto& [name, lane] : lanes_) { note_error(lane.log->finish()); }
    if (write_error_) { return std::unexpected(*write_error_); }
    return {};
}

void Sorter::give(Analysis& analysis) {
    for (auto& [name, lane] : lanes_) { analysis.axes.push_back(std::move(lane.log)); }
    analysis.machine = machine_.value_or("");
    analysis.foreign = std::move(foreign_);
    analysis.runs = runs_;
    analysis.missing_job_events = job_numbers_.missing_within();
    analysis.end = end_.finish();
}

}  // namespace lockstep::analysis
