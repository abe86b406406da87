#include "clients/merge/missing.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/kinematics.hpp"
#include "services/documents/machine_file.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/wire/lcm/lcm_decode.hpp"

namespace lockstep::merge {

using analysis::Break;
using analysis::Numbers;
using analysis::StepBatch;

namespace {

template <typename Message>
analysis::RecordingProcess publisher_in(const std::vector<std::uint8_t>& data) {
    const auto message = decode_lcm<Message>(data);
    if (!message) { return {}; }
    if constexpr (requires { message->axis; }) {
        return {message->machine, message->axis, message->incarnation};
    } else {
        return {message->machine, "", message->coordinator};
    }
}

analysis::RecordingProcess publisher_of(RecordKind kind, const std::vector<std::uint8_t>& data) {
    switch (kind) {
        case RecordKind::Steps: return publisher_in<step_batch_t>(data);
        case RecordKind::Run: return publisher_in<run_t>(data);
        case RecordKind::Position: return publisher_in<axis_position_t>(data);
        case RecordKind::Health: return publisher_in<axis_health_t>(data);
        case RecordKind::Channels: return publisher_in<channel_event_t>(data);
        case RecordKind::Job: return publisher_in<job_t>(data);
        case RecordKind::Event: return publisher_in<program_event_t>(data);
        case RecordKind::ProgramPart: return publisher_in<program_part_t>(data);
        default: return {};
    }
}

}  // namespace

/// Receives an axis's steps in order, with their gaps.
class MissingWatch::Axis final : public analysis::StepListener {
public:
    Axis(const std::string& machine, const std::string& name, bool begins_late)
        : record{.machine = machine, .axis = name}, begins_late_(begins_late) {}
    Axis(const Axis&) = delete;
    Axis& operator=(const Axis&) = delete;

    void on_break(const Break& what) override {
        if (what.missing_batches == 0 || (begins_late_ && !what.from)) { return; }
        record.missing_step_messages += what.missing_batches;
        if (record.missing_steps.size() == kListed) { return; }
        record.missing_steps.push_back({.axis = record.axis,
                                        .messages = what.missing_batches,
                                        .from_step = position_,
                                        .from_tick = what.from,
                                        .to_step = {},
                                        .to_tick = what.to});
        awaits_end_ = true;
    }

    void on_batch(const StepBatch& batch) override {
        if (awaits_end_) { record.missing_steps.back().to_step = batch.position_before_steps; }
        awaits_end_ = false;
        position_ = batch.position_before_steps + batch.steps.change();
    }

    void on_contradiction(const analysis::Contradiction& what) override {
        if (record.contradictions.size() < kListed) { record.contradictions.push_back(sentence(what)); }
    }

    AxisRecord record;
    analysis::StepStream stream{{this}};

private:
    bool begins_late_;
    std::optional<std::int64_t> position_;
    bool awaits_end_ = false;
};

MissingWatch::MissingWatch(bool begins_late) : begins_late_(begins_late) {}
MissingWatch::~MissingWatch() = default;

bool MissingWatch::is_new(const MessageId& id) { return !id.number || seen_[whose(id)].add(id.number->sequence); }

/// Events and jobs of a coordinator share one numbering, so events count as messages of the job channel.
MissingWatch::Whose MissingWatch::whose(const MessageId& id) {
    constexpr std::string_view kEvents = "EVENTS";
    std::string channel = id.channel;
    if (kind_of(channel) == RecordKind::Event) {
        channel.replace(channel.size() - kEvents.size(), kEvents.size(), "JOB");
    }
    return {std::move(channel), id.number->incarnation};
}

MissingWatch::Axis& MissingWatch::axis(const std::string& machine, const std::string& name) {
    auto& axis = axes_[{machine, name}];
    if (!axis) { axis = std::make_unique<Axis>(machine, name, begins_late_); }
    return *axis;
}

void MissingWatch::note_steps(const step_batch_t& message) {
    if (auto batch = analysis::to_batch(message)) {
        axis(message.machine, message.axis).stream.take(analysis::in_machine_time(std::move(*batch)));
    }
}

void MissingWatch::take(const MessageId& id, const std::vector<std::uint8_t>& data) {
    const RecordKind kind = kind_of(id.channel);
    if (kind == RecordKind::Mark) {
        if (const auto mark = analysis::decode_mark(data)) {
            marks_.take(*mark);
            if (!mark->process.empty()) { marked_.emplace(mark->machine, mark->process); }
        }
    }
    if (kind == RecordKind::Job) { note_machine(data); }
    if (kind == RecordKind::Steps) {
        if (const auto message = decode_lcm<step_batch_t>(data)) { note_steps(*message); }
    }
    if (kind == RecordKind::Channels && id.number) {
        const auto message = decode_lcm<channel_event_t>(data);
        if (message) { channels_[whose(id)].take(message->sequence, message->utime, message->lost); }
    }
    if (!id.number) { return; }
    const auto [known, is_new] = processes_.try_emplace(whose(id));
    if (is_new) { known->second = publisher_of(kind, data); }
    if (kind == RecordKind::Run) { ++axis(known->second.machine, known->second.axis).record.runs; }
}

/// The machine's file is in the message with which a job begins. Most jobs have the file of the job before.
void MissingWatch::note_machine(const std::vector<std::uint8_t>& data) {
    const auto job = decode_lcm<job_t>(data);
    if (!job || job->config.empty()) { return; }
    if (std::exchange(newest_config_[job->machine], job->config) == job->config) { return; }
    const auto machine = parse_machine(job->config);
    if (!machine) { return; }
    axes_wanted_[job->machine] = motor_names(*machine);
    labels_.add(Kinematics(*machine));
}

std::vector<std::string> MissingWatch::absent_axes() const {
    std::vector<std::string> absent;
    for (const auto& [machine, names] : axes_wanted_) {
        for (const std::string& name : names) {
            const auto is_it = [&](const auto& known) {
                return known.second.machine == machine && known.second.axis == name;
            };
            if (std::ranges::none_of(processes_, is_it)) { absent.push_back(name); }
        }
    }
    for (const auto& [machine, name] : marked_) {
        const auto wanted = axes_wanted_.find(machine);
        if (wanted == axes_wanted_.end() || std::ranges::find(wanted->second, name) != wanted->second.end()) {
            continue;
        }
        absent.push_back(name);
    }
    return absent;
}

void MissingWatch::note_missing_runs(const Whose& whose, AxisRecord& record) const {
    for (const Numbers& gap : seen_.at(whose).gaps()) {
        if (begins_late_ && gap.from == 0) { continue; }
        record.missing_run_messages += gap.end - gap.from;
        if (record.missing_runs.size() < kListed) { record.missing_runs.push_back({record.axis, whose.second, gap}); }
    }
}

void MissingWatch::note_missing_changes(const Whose& whose, AxisRecord& record) const {
    const ChannelGaps& channels = channels_.at(whose);
    record.changes_lost_by_device += channels.lost_by_device();
    for (MissingChanges& gap : channels.gaps()) {
        if (begins_late_ && !gap.from_us) { continue; }
        record.missing_channel_messages += gap.messages;
        gap.axis = record.axis;
        if (record.missing_changes.size() < kListed) { record.missing_changes.push_back(std::move(gap)); }
    }
}

std::vector<AxisRecord> MissingWatch::finish() {
    for (const auto& [whose, process] : processes_) {
        if (process.axis.empty()) { continue; }
        AxisRecord& record = axis(process.machine, process.axis).record;
        switch (kind_of(whose.first)) {
            case RecordKind::Run: note_missing_runs(whose, record); break;
            case RecordKind::Position: record.missing_positions += seen_.at(whose).missing_within(); break;
            case RecordKind::Health: record.missing_figures += seen_.at(whose).missing_within(); break;
            case RecordKind::Channels: note_missing_changes(whose, record); break;
            default: break;
        }
    }
    std::vector<AxisRecord> out;
    for (const auto& [name, axis] : axes_) {
        axis->stream.finish();
        axis->record.steps = axis->stream.counts().steps;
        axis->record.step_messages = axis->stream.counts().batches;
        out.push_back(std::move(axis->record));
    }
    return out;
}

std::int64_t MissingWatch::missing_of_jobs(RecordKind kind) const {
    std::int64_t missing = 0;
    for (const auto& [whose, numbers] : seen_) {
        missing += kind_of(whose.first) == kind ? numbers.missing_within() : 0;
    }
    return missing;
}

analysis::RecordEnd MissingWatch::end() {
    for (const auto& [whose, process] : processes_) {
        marks_.saw(kind_of(whose.first), process.machine, process.axis, process.incarnation, seen_.at(whose).end() - 1);
    }
    analysis::RecordEnd end = marks_.finish();
    end.labels = labels_;
    return end;
}

}  // namespace lockstep::merge
