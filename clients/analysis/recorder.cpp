#include "clients/analysis/recorder.hpp"

#include <algorithm>
#include <utility>

#include "clients/analysis/log_step.hpp"
#include "clients/analysis/plane_path.hpp"
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
    merge_.settle();
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
    JobLog* record = job(message);
    if (record == nullptr) { return; }
    if (message.event == "begun") {
        begin_job(message, *record, offset);
    } else if (message.event == "epoch") {
        ++record->epochs;
    } else if (message.event == "ended") {
        record->ended_us = message.utime;
        record->outcome = message.outcome;
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
        const std::size_t lane = merge_.add_lane();
        log->tell(merge_, lane);
        moves_.name_lane(lane, name);
        if (options_.csv_dir) { note_error(log->write_csv(*options_.csv_dir)); }
    }
    return log.get();
}

/// Null: it is one more than are kept.
JobLog* Recorder::job(const job_t& message) {
    const auto number = static_cast<std::uint64_t>(message.job);
    const auto known = std::ranges::find_if(analysis_.jobs.rbegin(), analysis_.jobs.rend(), [&](const JobLog& job) {
        return job.coordinator == message.coordinator && job.job == number;
    });
    if (known != analysis_.jobs.rend()) { return &*known; }
    if (analysis_.jobs.size() == Analysis::kJobsKept) {
        analysis_.jobs_not_kept += message.event == "begun" ? 1 : 0;
        return nullptr;
    }
    analysis_.jobs.push_back({.coordinator = message.coordinator, .job = number, .kind = message.kind});
    return &analysis_.jobs.back();
}

void Recorder::begin_job(const job_t& message, JobLog& record, std::uint64_t offset) {
    if (record.begun_us) { return; }  // it came twice
    record.begun_us = message.utime;
    const auto program = read_documents(message, offset);
    if (!analysis_.config) { return; }
    AskedPath asked;
    if (program) {
        record.name = program->name;
        auto planned = AskedPath::of(*analysis_.config, *program);
        if (planned) { record.planned = planned->planned(); }
        planned ? void(asked = std::move(*planned)) : void(record.unplannable = planned.error());
    }
    const bool on_a_line = message.kind != "own-move";  // axes on their own are asked for no line
    if (program && on_a_line && message.program != latest_program_) {
        keep_asked_way(*program);
        latest_program_ = message.program;
    }
    const Tick from{static_cast<std::int64_t>(Int128{message.utime} * 1000 / analysis_.config->tick_ns)};
    moves_.begin(static_cast<std::size_t>(&record - analysis_.jobs.data()), from, *analysis_.config,
                 JobMoves(std::move(asked), on_a_line));
}

void Recorder::keep_asked_way(const Program& program) {
    auto way = asked_in_plane(program);
    asked_points_ += way.size();
    if (way.size() > 1 && asked_points_ <= Analysis::kAskedPointsKept) {
        analysis_.asked_ways_mm.push_back(std::move(way));
    }
}

/// The program; none where there is none, or it cannot be read.
std::optional<Program> Recorder::read_documents(const job_t& message, std::uint64_t offset) {
    auto config = parse_machine(message.config);
    if (config) {
        analysis_.config = std::move(*config);
    } else {
        on_damage(offset, to_text("the configuration recorded with the job", config.error()));
    }
    if (message.program.empty()) { return std::nullopt; }
    auto program = program_from_text(message.program);
    if (program) { return std::move(*program); }
    on_damage(offset, "the program recorded with the job: " + program.error());
    return std::nullopt;
}

void Recorder::note_moves(JobLog& job, const JobMoves& moves) {
    job.unasked_steps = moves.unasked_steps();
    for (std::size_t i = 0; i < moves.asked().size(); ++i) { note_move(job, moves.move(i)); }
}

void Recorder::note_move(JobLog& job, MoveLog move) {
    ++job.move_count;
    job.moves_not_whole += move.is_whole() ? 0 : 1;
    job.late.add(move.late);
    for (const AxisMove& axis : move.axes) {
        job.asked_steps += axis.asked_steps;
        job.made_steps += axis.made_steps;
    }
    if (move.largest_distance_mm) {
        job.largest_distance_mm = std::max(job.largest_distance_mm.value_or(0), *move.largest_distance_mm);
        analysis_.largest_distance_mm = std::max(analysis_.largest_distance_mm.value_or(0), *move.largest_distance_mm);
    }
    if (moves_kept_ == Analysis::kMovesKept) { return; }
    ++moves_kept_;
    job.moves.push_back(std::move(move));
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
    merge_.finish();
    analysis_.step_skew = skew_.finish();
    moves_.finish();
    analysis_.stepped_ways = moves_.plane().ways();
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
