#include "clients/analysis/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "clients/analysis/log_step.hpp"
#include "clients/analysis/plane_path.hpp"
#include "clients/analysis/run.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/names.hpp"
#include "services/documents/program_document.hpp"

namespace lockstep::analysis {

void Recorder::on_steps(const step_batch_t& message, LogPlace place) {
    AxisLog* log = axis(message.machine, message.axis, place);
    if (log == nullptr) { return; }
    auto batch = to_batch(message);
    if (!batch) { return on_damage(place, batch.error()); }
    log->take(in_machine_time(std::move(*batch)));
    merge_.settle();
}

void Recorder::on_position(const axis_position_t& message, LogPlace place) {
    AxisLog* log = axis(message.machine, message.axis, place);
    if (log == nullptr) { return; }
    if (!is_countable(message.tick) || !is_countable(message.position_steps)) {
        return on_damage(place, "a position with numbers that no machine counts to");
    }
    events_.take(message);
    log->take(
        PositionSample{Tick{message.tick}, message.position_steps, message.position_mm, message.velocity_mm_per_s});
}

void Recorder::on_health(const axis_health_t& message, LogPlace place) {
    AxisLog* log = axis(message.machine, message.axis, place);
    if (log == nullptr || message.setpoints <= 0) { return; }
    if (!is_countable(message.tick)) { return on_damage(place, "figures with numbers that no machine counts to"); }
    log->take_slack({Tick{message.tick}, message.setpoint_slack_min_ms});
}

void Recorder::on_run(const run_t& message, LogPlace place) {
    if (axis(message.machine, message.axis, place) == nullptr) { return; }
    ++analysis_.runs;
    auto run = to_run(message);
    if (!run) { return on_damage(place, run.error()); }
    events_.take(message.axis, *run);
    skew_.take(message.axis, std::move(*run));
}

void Recorder::on_job(const job_t& message, LogPlace place) {
    if (!is_ours(message.machine)) { return; }
    if (!is_countable(message.utime) || !is_countable(message.start_tick)) {
        return on_damage(place, "a job with times that no machine counts to");
    }
    JobLog* record = job(message);
    if (record == nullptr) { return; }
    if (message.event == "begun") {
        begin_job(message, *record, place);
    } else if (message.event == "epoch") {
        ++record->epochs;
        record->overridden = record->overridden || message.feed_percent != 100 || message.rapid_percent != 100;
    } else if (message.event == "override") {
        record->overridden = true;
        events_.note({.at = analysis_.tick_at(message.utime),
                      .what = fmt::format("overrides turned to feed {} %, rapid {} %, for all behind frame {}",
                                          message.feed_percent, message.rapid_percent, message.behind_frame),
                      .axis = {},
                      .remedy = {}});
    } else if (message.event == "ended") {
        record->ended_us = message.utime;
        record->outcome = message.outcome;
    } else {
        on_damage(place, "a job's event is neither begun, epoch, override nor ended");
    }
}

void Recorder::on_foreign(std::string_view channel) { ++analysis_.foreign[std::string(channel)]; }

void Recorder::on_damage(LogPlace place, std::string what) { note_damage(analysis_.damages, place, std::move(what)); }

/// Whether the message is of the machine analysed; the first message says which that is where nobody asked for one.
bool Recorder::is_ours(const std::string& machine) {
    if (!machine_) { machine_ = machine; }
    if (machine == *machine_) { return true; }
    on_foreign("machine " + machine);
    return false;
}

AxisLog* Recorder::axis(const std::string& machine, const std::string& name, LogPlace place) {
    if (!is_axis_name(name)) {
        on_damage(place, "an axis's name is none");
        return nullptr;
    }
    if (!is_ours(machine)) { return nullptr; }
    if (axes_.size() == kMaxAxes && !axes_.contains(name)) {
        on_damage(place, "more axes than a machine can have");
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
    if (message.event != "begun") {  // after a takeover another goes on with the job
        const auto open = std::ranges::find_if(analysis_.jobs.rbegin(), analysis_.jobs.rend(), [&](const JobLog& job) {
            return job.job == number && job.begun_us && !job.ended_us;
        });
        if (open != analysis_.jobs.rend()) { return &*open; }
    }
    if (analysis_.jobs.size() == Analysis::kJobsKept) {
        analysis_.jobs_not_kept += message.event == "begun" ? 1 : 0;
        return nullptr;
    }
    analysis_.jobs.push_back({.coordinator = message.coordinator, .job = number, .kind = message.kind});
    return &analysis_.jobs.back();
}

void Recorder::begin_job(const job_t& message, JobLog& record, LogPlace place) {
    if (record.begun_us) { return; }  // it came twice
    record.begun_us = message.utime;
    const auto program = read_documents(message, place);
    if (!analysis_.config) { return; }
    AskedPath asked;
    if (program) {
        record.name = program->name;
        auto planned = AskedPath::of(*analysis_.config, *program);
        if (planned) {
            record.planned = planned->planned();
            record.legs = planned->legs();
        }
        planned ? void(asked = std::move(*planned)) : void(record.unplannable = planned.error());
    }
    const bool on_a_line = message.kind != "own-move";  // axes on their own are asked for no line
    if (program && on_a_line && message.program != latest_program_) {
        keep_asked_way(*program);
        latest_program_ = message.program;
    }
    moves_.begin(static_cast<std::size_t>(&record - analysis_.jobs.data()), analysis_.tick_at(message.utime),
                 *analysis_.config, JobMoves(std::move(asked), on_a_line));
}

void Recorder::on_late(const std::string& axis, std::span<const LateStep> steps) {
    moves_.on_late(axis, steps);
    const auto log = axes_.find(axis);
    if (log == axes_.end()) { return; }
    for (const LateStep& step : steps) { log->second->take(step); }
}

bool Recorder::is_during(Tick tick, const JobLog& job) const {
    const std::int64_t us = analysis_.microseconds_at(tick);
    return job.begun_us && *job.begun_us <= us && (!job.ended_us || us <= *job.ended_us);
}

void Recorder::keep_asked_way(const Program& program) {
    auto way = asked_in_plane(program);
    asked_points_ += way.size();
    if (way.size() > 1 && asked_points_ <= Analysis::kAskedPointsKept) {
        analysis_.asked_ways_mm.push_back(std::move(way));
    }
}

/// The program; none where there is none, or it cannot be read.
std::optional<Program> Recorder::read_documents(const job_t& message, LogPlace place) {
    auto config = parse_machine(message.config);
    if (config) {
        analysis_.config = std::move(*config);
    } else {
        on_damage(place, to_text("the configuration recorded with the job", config.error()));
    }
    if (message.program.empty()) { return std::nullopt; }
    auto program = program_from_text(message.program);
    if (program) { return std::move(*program); }
    on_damage(place, "the program recorded with the job: " + program.error());
    return std::nullopt;
}

void Recorder::note_moves(JobLog& job, const JobMoves& moves) {
    for (Event& event : events_.events()) {
        if (is_during(event.at, job)) { event.line = moves.line_at(event.at); }
    }
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
    for (auto& [name, log] : axes_) { note_error(log->finish()); }
    analysis_.step_skew = skew_.finish();
    for (auto& [name, log] : axes_) { analysis_.axes.push_back(std::move(log)); }
    axes_.clear();
    merge_.finish();
    for (Event& event : events_.events()) {
        const auto job = std::ranges::find_if(analysis_.jobs, [&](const JobLog& j) { return is_during(event.at, j); });
        if (job != analysis_.jobs.end()) { event.job = job->job; }
    }
    moves_.finish();
    analysis_.happened = std::move(events_.events());
    analysis_.events_not_kept = events_.not_kept();
    std::ranges::stable_sort(analysis_.happened, {}, &Event::at);
    analysis_.stepped_ways = moves_.plane().ways();
    std::ranges::sort(analysis_.damages, {}, &Damage::first_byte);
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
