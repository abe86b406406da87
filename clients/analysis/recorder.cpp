#include "clients/analysis/recorder.hpp"

#include <algorithm>
#include <utility>

#include "clients/analysis/log_step.hpp"
#include "clients/analysis/run.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/names.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep::analysis {

void Recorder::on_steps(const step_batch_t& message, std::uint64_t offset) {
    AxisLog* log = axis(message.machine, message.axis, offset);
    if (log == nullptr) { return; }
    auto batch = to_batch(message);
    if (!batch) { return on_damage(offset, batch.error()); }
    log->take(in_machine_time(std::move(*batch)));
}

void Recorder::on_position(const axis_position_t& message, std::uint64_t offset) {
    AxisLog* log = axis(message.machine, message.axis, offset);
    if (log == nullptr) { return; }
    if (!is_countable(message.tick) || !is_countable(message.position_steps)) {
        return on_damage(offset, "a position with numbers that no machine counts to");
    }
    log->take(
        PositionSample{Tick{message.tick}, message.position_steps, message.position_mm, message.velocity_mm_per_s});
}

void Recorder::on_run(const run_t& message, std::uint64_t offset) {
    if (axis(message.machine, message.axis, offset) == nullptr) { return; }
    ++analysis_.runs;
    auto run = to_run(message);
    run ? skew_.take(message.axis, std::move(*run)) : on_damage(offset, run.error());
}

void Recorder::on_job(const job_t& message, std::uint64_t offset) {
    if (!is_ours(message.machine)) { return; }
    if (!is_countable(message.utime) || !is_countable(message.start_tick)) {
        return on_damage(offset, "a job with times that no machine counts to");
    }
    JobLog& record = job(message);
    if (message.event == "begun") {
        record.begun_us = message.utime;
        read_documents(message, record, offset);
    } else if (message.event == "epoch") {
        if (!record.first_frame) { record.first_frame = Tick{message.start_tick}; }
    } else if (message.event == "ended") {
        record.ended_us = message.utime;
        record.outcome = message.outcome;
    } else {
        on_damage(offset, "a job's event is neither begun, epoch nor ended");
    }
}

void Recorder::on_foreign(std::string_view channel) { ++analysis_.foreign[std::string(channel)]; }

void Recorder::on_damage(std::uint64_t offset, std::string what) {
    ++analysis_.damage_count;
    if (analysis_.damages.size() < Analysis::kDamagesKept) { analysis_.damages.push_back({offset, std::move(what)}); }
}

/// Whether the message is of the machine analysed; the first message says which that is where nobody asked for one.
bool Recorder::is_ours(const std::string& machine) {
    if (!machine_) { machine_ = machine; }
    if (machine == *machine_) { return true; }
    on_foreign("machine " + machine);
    return false;
}

AxisLog* Recorder::axis(const std::string& machine, const std::string& name, std::uint64_t offset) {
    if (!is_axis_name(name)) {
        on_damage(offset, "an axis's name is none");
        return nullptr;
    }
    if (!is_ours(machine)) { return nullptr; }
    if (axes_.size() == kMaxAxes && !axes_.contains(name)) {
        on_damage(offset, "more axes than a machine can have");
        return nullptr;
    }
    auto& log = axes_[name];
    if (!log) {
        log = std::make_unique<AxisLog>(name);
        log->tell(skew_.steps_of(name));
        if (options_.csv_dir) { note_error(log->write_csv(*options_.csv_dir)); }
    }
    return log.get();
}

JobLog& Recorder::job(const job_t& message) {
    const auto number = static_cast<std::uint64_t>(message.job);
    const auto known = std::ranges::find_if(
        analysis_.jobs, [&](const JobLog& job) { return job.coordinator == message.coordinator && job.job == number; });
    if (known != analysis_.jobs.end()) { return *known; }
    analysis_.jobs.push_back({.coordinator = message.coordinator, .job = number, .kind = message.kind});
    return analysis_.jobs.back();
}

void Recorder::read_documents(const job_t& message, JobLog& record, std::uint64_t offset) {
    auto config = parse_machine(message.config);
    if (config) {
        analysis_.config = std::move(*config);
    } else {
        on_damage(offset, to_text("the configuration recorded with the job", config.error()));
    }
    if (message.program.empty()) { return; }
    auto program = program_from_text(message.program);
    if (program) {
        record.program = std::move(*program);
    } else {
        on_damage(offset, "the program recorded with the job: " + program.error());
    }
}

void Recorder::note_error(const std::expected<void, std::string>& result) {
    if (!result && !write_error_) { write_error_ = result.error(); }
}

Analysis Recorder::finish() {
    for (auto& [name, log] : axes_) {
        note_error(log->finish());
        analysis_.axes.push_back(std::move(log));
    }
    axes_.clear();
    analysis_.step_skew = skew_.finish();
    std::ranges::sort(analysis_.damages, {}, &Damage::offset);
    analysis_.machine = machine_.value_or("");
    if (analysis_.config) {
        const auto& order = analysis_.config->axes;
        std::ranges::stable_sort(analysis_.axes, {}, [&](const auto& log) {
            return std::ranges::find(order, log->name(), &AxisConfig::name) - order.begin();
        });
    }
    return std::move(analysis_);
}

}  // namespace lockstep::analysis
