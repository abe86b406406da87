#include "clients/merge/missing.hpp"

#include "clients/analysis/log_step.hpp"
#include "services/wire/lcm_decode.hpp"

namespace lockstep::merge {

using analysis::Break;
using analysis::Numbers;
using analysis::StepBatch;

/// Hears an axis's steps in order, and where they break off.
class MissingWatch::Axis final : public analysis::StepListener {
public:
    Axis(const std::string& machine, const std::string& name) : record{.machine = machine, .axis = name} {}
    Axis(const Axis&) = delete;
    Axis& operator=(const Axis&) = delete;

    void on_break(const Break& what) override {
        if (what.missing_batches == 0) { return; }
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
        position_ = batch.position_before_steps;
        for (const StepEdge& step : batch.steps) { *position_ += step.direction; }
    }

    AxisRecord record;
    analysis::StepStream stream{{this}};

private:
    std::optional<std::int64_t> position_;
    bool awaits_end_ = false;
};

MissingWatch::MissingWatch() = default;
MissingWatch::~MissingWatch() = default;

bool MissingWatch::is_new(const MessageId& id) {
    return !id.number || seen_[{id.channel, id.number->incarnation}].add(id.number->sequence);
}

MissingWatch::Axis& MissingWatch::axis(const std::string& machine, const std::string& name) {
    auto& axis = axes_[{machine, name}];
    if (!axis) { axis = std::make_unique<Axis>(machine, name); }
    return *axis;
}

MissingWatch::Axis* MissingWatch::axis_of(RecordKind kind, const std::vector<std::uint8_t>& data) {
    const auto named = [this](const auto& message) {
        return message ? &axis(message->machine, message->axis) : nullptr;
    };
    switch (kind) {
        case RecordKind::Run: return named(decode_lcm<run_t>(data));
        case RecordKind::Position: return named(decode_lcm<axis_position_t>(data));
        case RecordKind::Health: return named(decode_lcm<axis_health_t>(data));
        default: return nullptr;
    }
}

void MissingWatch::take(const MessageId& id, const std::vector<std::uint8_t>& data) {
    const RecordKind kind = kind_of(id.channel);
    if (kind == RecordKind::Steps) {
        const auto message = decode_lcm<step_batch_t>(data);
        if (!message) { return; }
        if (auto batch = analysis::to_batch(*message)) {
            axis(message->machine, message->axis).stream.take(analysis::in_machine_time(std::move(*batch)));
        }
        return;
    }
    if (!id.number) { return; }
    const auto known = numbered_.try_emplace({id.channel, id.number->incarnation}, nullptr).first;
    if (known->second == nullptr) { known->second = axis_of(kind, data); }
    if (known->second != nullptr && kind == RecordKind::Run) { ++known->second->record.runs; }
}

void MissingWatch::note_missing_runs(const Whose& whose, AxisRecord& record) const {
    for (const Numbers& gap : seen_.at(whose).gaps()) {
        record.missing_run_messages += gap.end - gap.from;
        if (record.missing_runs.size() < kListed) { record.missing_runs.push_back({record.axis, whose.second, gap}); }
    }
}

std::vector<AxisRecord> MissingWatch::finish() {
    for (const auto& [whose, axis] : numbered_) {
        if (axis == nullptr) { continue; }
        switch (kind_of(whose.first)) {
            case RecordKind::Run: note_missing_runs(whose, axis->record); break;
            case RecordKind::Position: axis->record.missing_positions += seen_.at(whose).missing_within(); break;
            default: axis->record.missing_figures += seen_.at(whose).missing_within();
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

std::int64_t MissingWatch::missing_job_events() const {
    std::int64_t missing = 0;
    for (const auto& [whose, numbers] : seen_) {
        missing += kind_of(whose.first) == RecordKind::Job ? numbers.missing_within() : 0;
    }
    return missing;
}

}  // namespace lockstep::merge
