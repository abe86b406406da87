#include "clients/analysis/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "clients/analysis/plane_path.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_file.hpp"
#include "services/record/reading/job_of.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/record/reading/run.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::analysis {
namespace {

/// An axis reports its position in every slot. If it is silent for this long, it has ended or the log lacks its
/// messages.
constexpr std::int64_t kSilence_us = 500'000;

/// The plays of all motors at the begin of a job; none if no motor has backlash, or if the record is damaged.
AxisCounts plays_in(const RecordedJob& begun, const MachineConfig& machine) {
    AxisCounts plays;
    const std::size_t axes = machine.axes.size();
    if (begun.start_count.size() != axes + motor_count(machine)) { return plays; }
    for (std::size_t m = axes; m < begun.start_count.size(); ++m) { plays.append(begun.start_count[m]); }
    return plays;
}

/// The places of a touch. Returns nullopt if there was no touch, or if its record is damaged.
std::optional<Event> touch_of(const RecordedJob& message, const Analysis& analysis) {
    const bool is_touched = message.outcome == "touched";
    if (!is_touched || !analysis.config || !is_countable(message.start_tick)) { return std::nullopt; }
    std::string what = message.input().empty() ? "the probe touched at" : "input " + message.input() + " touched at";
    const std::vector<AxisConfig>& axes = analysis.config->axes;
    for (std::size_t i = 0; i < axes.size() && i < message.start_count.size(); ++i) {
        what += fmt::format(" {} {:.4f}", axes[i].name, static_cast<double>(message.start_count[i]) / kNmInMm);
    }
    return Event{.at = Tick{message.start_tick}, .what = std::move(what), .axis = {}, .remedy = {}};
}

/// Returns the number of the log of the job that waits for a job that may be in its pause.
std::optional<std::size_t> paused_by(const JobLog& begun, const std::vector<JobLog>& jobs) {
    for (std::size_t i = jobs.size(); i-- > 0;) {
        const JobLog& job = jobs[i];
        const bool waits = job.coordinator == begun.coordinator && job.begun_us && !job.ended_us && &job != &begun;
        if (waits && job.kind != "jog" && job.kind != "return") { return i; }
    }
    return std::nullopt;
}

/// Returns null if there is none, or if it cannot be read.
std::shared_ptr<const RecordedProgram> read_program(const RecordedJob& message, LogPlace place,
                                                    std::vector<Damage>& damages) {
    if (!message.has_program() || !message.lacks.empty()) { return nullptr; }
    auto program = message.read_program();
    if (program) { return *std::move(program); }
    note_damage(damages, place, "the program recorded with the job: " + program.error());
    return nullptr;
}

void keep_asked_way(const RecordedProgram& program, std::vector<std::vector<drawing::Point>>& kept) {
    constexpr std::size_t kFewest = 1000;  // a path limited to fewer points may be drawn too coarsely
    std::size_t points = 0;
    for (const auto& way : kept) { points += way.size(); }
    const std::size_t most = Analysis::kAskedPointsKept - points;
    if (most < kFewest) { return; }
    auto way = asked_in_plane(program, most);
    if (way.size() >= 2) { kept.push_back(std::move(way)); }
}

bool is_during(std::int64_t us, const JobLog& job) {
    return job.begun_us && *job.begun_us <= us && (!job.ended_us || us <= *job.ended_us);
}

}  // namespace

void Recorder::on_axis(const std::string& name) {
    lanes_.push_back({.axis = name});
    moves_.name_lane(merge_.add_lane(), name);
}

void Recorder::on_measured(std::size_t lane, const SharedSteps& steps) {
    const Tick newest = steps->edges.back().tick;
    auto& seen = lanes_[lane].seen_us;
    seen = std::max(seen.value_or(0), analysis_.microseconds_at(newest));
    newest_ = std::max(newest_, newest);
    merge_.take(lane, steps);
    settle();
}

void Recorder::on_position(const axis_position_t& message) {
    events_.take(message);
    const auto lane = std::ranges::find(lanes_, message.axis, &Lane::axis);
    const auto number = static_cast<std::size_t>(lane - lanes_.begin());
    const bool lacks_messages = message.incarnation == lane->incarnation && message.sequence > lane->sequence + 1;
    const auto before = std::exchange(lane->seen_us, message.utime);
    if (lacks_messages && before && message.utime - *before > kSilence_us) { merge_.lost(number); }
    lane->incarnation = message.incarnation;
    lane->sequence = message.sequence;
    newest_ = std::max(newest_, Tick{message.tick});
    merge_.stands(number, Tick{message.tick}, message.position_steps);
}

void Recorder::on_run(std::size_t lane, const Run& run) {
    const std::string& motor = lanes_[lane].axis;
    events_.take(motor, run);
    const MotorConfig* config = axes_ ? analysis_.motor_config(motor) : nullptr;
    if (config != nullptr) {
        axes_->take(MotorIndex{static_cast<std::size_t>(config - analysis_.motors().data())}, run);
    }
}

void Recorder::on_job(const RecordedJob& message, LogPlace place) {
    JobLog* record = job(message);
    if (record == nullptr) { return; }
    if (message.event == "begun") {
        begin_job(message, *record, place);
    } else if (message.event == "epoch") {
        ++record->epochs;
        const bool is_overridden = message.feed_percent != 100 || message.rapid_percent != 100;
        record->overridden = record->overridden || is_overridden;
        const bool is_within_a_move = message.resume_high != 0 || message.resume_low != 0;
        if (is_overridden || is_within_a_move) { moves_.plan_again(number_of(*record)); }
    } else if (message.event == "override") {
        record->overridden = true;
        moves_.plan_again(number_of(*record));
        events_.note({.at = analysis_.tick_at(message.utime),
                      .what = fmt::format("overrides changed to feed {} %, rapid {} %, for all frames after frame {}",
                                          message.feed_percent, message.rapid_percent, message.behind_frame),
                      .axis = {},
                      .remedy = {}});
    } else if (message.event == "probe") {
        record->is_touched = message.outcome == "touched";
        if (auto touch = touch_of(message, analysis_)) { events_.note(*std::move(touch)); }
    } else if (message.event == "ended") {
        program_events_.end(message);
        record->ended_us = message.utime;
        record->outcome = message.outcome;
        if (record->is_in_pause_of) { moves_.go_on(*record->is_in_pause_of, analysis_.tick_at(message.utime)); }
    } else {
        on_damage(place, "a job's event is neither begun, epoch, override, probe nor ended");
    }
}

void Recorder::on_event(const program_event_t& message, const ProgramEvent& event) {
    program_events_.take(message, event);
}

void Recorder::on_channel(const channel_event_t& message) {
    channels_.take(message);
    powers_.take(message);
}

void Recorder::on_damage(LogPlace place, const std::string& what) { note_damage(analysis_.damages, place, what); }

/// Returns null if there are more jobs than are kept.
JobLog* Recorder::job(const job_t& message) {
    if (JobLog* known = job_of(analysis_.jobs, message)) { return known; }
    if (analysis_.jobs.size() == Analysis::kJobsKept) {
        analysis_.jobs_not_kept += message.event == "begun" ? 1 : 0;
        return nullptr;
    }
    analysis_.jobs.push_back(
        {.coordinator = message.coordinator, .job = static_cast<std::uint64_t>(message.job), .kind = message.kind});
    return &analysis_.jobs.back();
}

void Recorder::begin_job(const RecordedJob& message, JobLog& record, LogPlace place) {
    if (record.begun_us) { return; }  // a repeat
    record.begun_us = message.utime;
    if (message.may_be_in_pause()) { record.is_in_pause_of = paused_by(record, analysis_.jobs); }
    read_machine(message, place);
    const auto program = read_program(message, place, analysis_.damages);
    if (program && !record.is_in_pause_of) { program_events_.begin(message, *program); }
    if (!message.lacks.empty()) { record.unplannable = message.lacks; }
    if (!analysis_.config) { return; }
    AskedPath asked;
    if (program) { record.name = program->head().name; }
    const bool homes = record.kind == "home";  // the places of its moves are assumed ones
    if (program && !homes) {
        auto planned = AskedPath::of(*analysis_.config, program->head(), program, plays_in(message, *analysis_.config));
        if (planned) {
            record.planned = planned->planned();
            record.legs = planned->legs();
        }
        if (planned) { analysis_.tolerance_mm = std::max(analysis_.tolerance_mm, planned->tolerance_mm()); }
        planned ? void(asked = std::move(*planned)) : void(record.unplannable = planned.error());
    }
    if (program && !homes && record.is_on_a_line()) {
        if (powers_.begin(*analysis_.config, *analysis_.kinematics)) {
            moves_.set_on_place([this](Tick tick, drawing::Point place_mm) { powers_.at(tick, place_mm); });
        }
        powers_.ask(*program);
        const bool draws = options_.keeps_curves() && !message.has_program_of(latest_program_);
        if (draws) {
            keep_asked_way(*program, analysis_.asked_ways_mm);
            latest_program_ = message;
        }
    }
    moves_.begin(number_of(record), analysis_.tick_at(message.utime), *analysis_.config,
                 JobMoves(std::move(asked), record.is_on_a_line()), homes);
}

void Recorder::on_late(const std::string& axis, const SharedLate& steps) {
    if (!steps->groups.empty()) { waiting_late_.push_back({axis, steps}); }
    const auto lane = std::ranges::find(lanes_, axis, &Lane::axis);
    if (lane == lanes_.end()) { return; }
    for (const EquallyLate& group : steps->groups) { lane->late.add(group, options_.keeps_curves()); }
}

void Recorder::read_machine(const RecordedJob& message, LogPlace place) {
    if (analysis_.config && message.config == config_text_) { return; }
    auto config = parse_machine(message.config);
    if (!config) { return on_damage(place, to_text("the configuration recorded with the job", config.error())); }
    config_text_ = message.config;
    analysis_.config = std::move(*config);
    analysis_.kinematics = std::make_shared<const Kinematics>(*analysis_.config);
    analysis_.motor_skew = axes_with_skew(*analysis_.kinematics);
    axes_.reset();
    if (analysis_.has_motors_as_axes()) { return; }
    axes_.emplace(*analysis_.config, analysis_.kinematics, options_.keeps_curves());
}

/// Notes the motors with steps in the job that the log lacks.
void Recorder::note_unknown(JobLog& job, const std::vector<std::string>& motors, JobMoves& moves) const {
    const Tick begun = analysis_.tick_at(*job.begun_us + kSilence_us);
    for (MotorIndex motor{0}; motor < moves.asked().motors(); ++motor) {
        const auto found = std::ranges::find(lanes_, motors[motor], &Lane::axis);
        const auto lane = static_cast<std::size_t>(found - lanes_.begin());
        const bool begins_late = lane == lanes_.size() || merge_.known_from(lane) > begun;
        const Tick until = begins_late ? Tick{} : merge_.known_until(lane);
        moves.know_until(motor, until);
        const bool ends_early = job.ended_us && until < analysis_.tick_at(*job.ended_us - kSilence_us);
        if (moves.lacks_steps_of(motor) && (begins_late || ends_early)) { job.axes_not_known.push_back(motors[motor]); }
    }
}

void Recorder::note_moves(JobLog& job, const JobMoves& moves) {
    for (Event& event : events_.events()) {
        const auto line = is_during(analysis_.microseconds_at(event.at), job) ? moves.line_at(event.at) : std::nullopt;
        if (line.value_or(0) > 0) { event.line = line; }  // 0: the job's moves are of no line
    }
    job.unasked_steps = moves.unasked_steps();
    job.late.add(moves.late());
    job.moves_without_distance = moves.moves_without_distance();
    for (std::size_t i = 0; i < moves.asked().size(); ++i) { note_move(job, moves.move(i)); }
}

void Recorder::note_move(JobLog& job, MoveLog move) {
    ++job.move_count;
    job.dwells += is_dwell(move) ? 1 : 0;
    job.moves_not_whole += move.is_whole() ? 0 : 1;
    for (const MotorMove& motor : move.motors) {
        job.asked_steps += motor.asked_steps;
        job.made_steps += motor.made_steps;
    }
    if (move.largest_distance_mm) {
        job.largest_distance_mm = std::max(job.largest_distance_mm.value_or(0), *move.largest_distance_mm);
        analysis_.largest_distance_mm = std::max(analysis_.largest_distance_mm.value_or(0), *move.largest_distance_mm);
    }
    if (moves_kept_ == Analysis::kMovesKept) { return; }
    ++moves_kept_;
    job.moves.push_back(std::move(move));
}

/// Steps wait for a while for the record of their job, which another process publishes.
void Recorder::settle() {
    constexpr std::int64_t kPatience_us = 1'500'000;
    const Tick end = newest_ - Ticks{analysis_.tick_at(kPatience_us).value};
    merge_.settle(end, [this](MergedSteps steps) { moves_.take(steps); });
    settle_late(end);
}

void Recorder::settle_late(Tick end) {
    const auto is_over = [&](const EquallyLate& last) { return last.commanded(last.steps.size() - 1) < end; };
    for (; !waiting_late_.empty() && is_over(waiting_late_.front().steps->groups.back()); waiting_late_.pop_front()) {
        const WaitingLate& first = waiting_late_.front();
        for (const EquallyLate& group : first.steps->groups) { moves_.on_late(first.axis, group); }
    }
}

Analysis Recorder::finish(Sorter& sorter) {
    constexpr Tick kNever{std::numeric_limits<std::int64_t>::max()};
    merge_.finish([this](MergedSteps steps) { moves_.take(steps); });
    settle_late(kNever);
    for (Event& event : events_.events()) {
        const auto job = std::ranges::find_if(
            analysis_.jobs, [&](const JobLog& j) { return is_during(analysis_.microseconds_at(event.at), j); });
        if (job != analysis_.jobs.end()) { event.job = job->job; }
    }
    moves_.finish();
    analysis_.happened = std::move(events_.events());
    analysis_.events_not_kept = events_.not_kept();
    std::ranges::stable_sort(analysis_.happened, {}, &Event::at);
    analysis_.program_events = std::move(program_events_.events());
    std::ranges::stable_sort(analysis_.program_events, {}, &HappenedEvent::at);
    analysis_.program_events_not_kept = program_events_.not_kept();
    analysis_.power_maps = powers_.finish(analysis_.program_events);
    channels_.finish(newest_);
    analysis_.channel_changes = std::move(channels_.changes());
    analysis_.channel_courses = channels_.courses();
    analysis_.channel_changes_not_kept = channels_.not_kept();
    analysis_.steps_of_no_job = moves_.steps_of_no_job();
    analysis_.stepped_ways = moves_.plane().ways();
    if (axes_) { analysis_.axis_figures = axes_->finish(); }
    std::ranges::sort(analysis_.damages, {}, &Damage::first_byte);
    sorter.give(analysis_);
    if (analysis_.kinematics != nullptr) { analysis_.end.labels.add(*analysis_.kinematics); }
    for (auto& axis : analysis_.axes) {
        axis->take(std::move(std::ranges::find(lanes_, axis->name(), &Lane::axis)->late));
    }
    if (analysis_.config) {
        const auto order = analysis_.motors();
        std::ranges::stable_sort(analysis_.axes, {}, [&](const auto& log) {
            return std::ranges::find(order, log->name(), &MotorConfig::name) - order.begin();
        });
    }
    return std::move(analysis_);
}

}  // namespace lockstep::analysis
