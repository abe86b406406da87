#include "clients/verification/log_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/faults.hpp"
#include "core/kinematics/kinematics.hpp"
#include "services/documents/machine_file.hpp"
#include "services/record/reading/log_step.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::verification {

/// `jobs`: null if there is no plan to compare the runs with.
LogCheck::Axis::Axis(const std::string& name, Findings& findings, JobCheck* jobs)
    : check(
          name, findings,
          [jobs](const Run& run, Tick tick) { return jobs != nullptr ? jobs->commanded(run, tick) : name_of(run); },
          [jobs, name](Tick tick) { return jobs != nullptr ? jobs->planned(name, tick) : std::vector<Course>{}; }),
      outputs(name, findings),
      runs(
          [this, name, &findings, jobs](Run run) {
              if (!findings.going()) { return; }
              const bool begins_late = !std::exchange(has_run, true) && run.sequence > 0;
              is_behind_gap = is_behind_gap || begins_late;
              if (jobs != nullptr && begins_late) { jobs->begins_late(); }
              if (jobs != nullptr) { jobs->take(name, run, std::exchange(is_behind_gap, false)); }
              check.take(std::move(run));
          },
          [this](std::int64_t from, std::int64_t end) {
              is_behind_gap = true;
              check.runs_missing(from, end);
          },
          [this](const Run& other) { check.runs_contradict(other); }) {}

LogCheck::Machine::Machine(Findings& findings)
    : touches(findings),
      jobs(findings, touches,
           [this](const std::string& axis, OutputCheck::Planned planned) {
               const auto found = axes.find(axis);
               if (found != axes.end()) { found->second->outputs.take(std::move(planned)); }
           }),
      records([this](const JobRecord& record,
                     bool is_behind_gap) { std::visit([&](const auto& of) { jobs.take(of, is_behind_gap); }, record); },
              [this](const JobRecord& other) { jobs.contradict(other); }) {}

void LogCheck::take(const analysis::StepMessage& message, analysis::LogPlace place) {
    Axis* to = axis(message.machine, message.axis, place);
    if (to == nullptr) { return; }
    const auto& batch = message.batch;
    if (!batch) { return on_damage(place, batch.error()); }
    Machine& of = machines_.find(message.machine)->second;
    end_.saw(RecordKind::Steps, message.machine, message.axis, batch->incarnation, batch->sequence);
    to->begin(message.utime, batch->sequence == 0);
    of.note_message(*to, batch->incarnation, message.utime);
    of.note_motion(*to);
    to->check.take(*batch);
}

void LogCheck::take(const analysis::RunMessage& message, analysis::LogPlace place) {
    Axis* to = axis(message.machine, message.axis, place);
    if (to == nullptr) { return; }
    const auto& run = message.run;
    if (!run) { return on_damage(place, run.error()); }
    end_.saw(RecordKind::Run, message.machine, message.axis, run->incarnation, run->sequence);
    Machine& of = machines_.find(message.machine)->second;
    of.note_motion(*to);
    if (to->began_before_log(message)) { to->check.began_before_log(*run); }
    to->runs.take(*run);
}

void LogCheck::on_health(const axis_health_t& message, analysis::LogPlace /*place*/) {
    if (!analysis::is_message_number(message.sequence)) { return; }
    end_.saw(RecordKind::Health, message.machine, message.axis, message.incarnation, message.sequence);
}

void LogCheck::on_channel(const channel_event_t& message, analysis::LogPlace place) {
    if (make_follower_) { return; }
    Axis* of = axis(message.machine, message.axis, place);
    if (of == nullptr) { return; }
    const auto event = event_of(message);
    const bool is_possible = event && analysis::is_countable(message.tick) &&
                             analysis::is_message_number(message.sequence) && message.lost >= 0;
    if (!is_possible) { return on_damage(place, "a change of an input or output with impossible numbers"); }
    end_.saw(RecordKind::Channels, message.machine, message.axis, message.incarnation, message.sequence);
    of->outputs.take({message.incarnation, message.sequence, message.lost, *event});
    if (event->kind != ChannelEvent::Kind::Input || message.clock_error < 0) { return; }
    machines_.find(message.machine)
        ->second.touches.take({.utime = message.utime,
                               .motor = message.axis,
                               .channel = event->channel,
                               .closed = event->closed,
                               .tick = event->tick + Ticks{message.ahead},
                               .clock_error = {message.clock_error}});
}

void LogCheck::on_program_part(const program_part_t& message, analysis::LogPlace /*place*/) {
    if (!analysis::is_message_number(message.sequence)) { return; }
    end_.saw(RecordKind::ProgramPart, message.machine, "", message.coordinator, message.sequence);
}

/// A process's mark about itself applies to the rest of the log.
void LogCheck::on_mark(const analysis::RecordedMark& message, analysis::LogPlace place) {
    end_.take(message);
    if (Machine* of = machine(message.machine, place); of != nullptr && !message.process.empty()) {
        if (of->marked_axes.size() < kMaxAxes) { of->marked_axes.insert(message.process); }
    }
    if (message.witness != message.process) { return; }
    if (message.process.empty()) {
        Machine* of = machine(message.machine, place);
        if (of != nullptr) { of->marked_jobs.try_emplace(message.incarnation, message.job_events); }
        return;
    }
    Axis* of = axis(message.machine, message.process, place);
    if (of == nullptr) { return; }
    of->begin(message.utime, message.positions == 0);
    of->last.announced_end = message.ended;
    of->runs.expect_from(message.incarnation, message.runs);
    of->check.expect_from(message.incarnation, message.steps);
    if (message.channel_events) { of->outputs.expect_from(message.incarnation, *message.channel_events); }
}

/// Decides why the log lacks a coordinator's first messages: it begins later, or they are missing.
void LogCheck::note_beginning(Machine& machine, std::int64_t coordinator, std::int64_t sequence, std::int64_t job) {
    if (std::exchange(machine.has_jobs, true) || sequence == 0) { return; }
    machine.jobs.begins_late();
    const auto marked = machine.marked_jobs.find(coordinator);
    if (marked == machine.marked_jobs.end() || sequence <= marked->second) { return; }
    findings_.add_missing(
        fmt::format("{} messages of jobs are missing from the log before job {}", sequence - marked->second, job));
}

/// Takes a record of a job, or of an event of its program.
void LogCheck::take_record(const auto& message, RecordKind kind, analysis::LogPlace place) {
    if (make_follower_) { return; }
    Machine* to = machine(message.machine, place);
    if (to == nullptr) { return; }
    if (analysis::is_countable(message.utime)) { to->last.received_us = message.utime; }
    end_.saw(kind, message.machine, "", message.coordinator, message.sequence);
    note_beginning(*to, message.coordinator, message.sequence, message.job);
    to->records.take(message);
}

void LogCheck::on_event(const program_event_t& message, analysis::LogPlace place) {
    if (!analysis::is_countable(message.tick) || !analysis::is_message_number(message.sequence)) {
        return on_damage(place, "an event with impossible numbers");
    }
    take_record(message, RecordKind::Event, place);
}

void LogCheck::on_position(const axis_position_t& message, analysis::LogPlace place) {
    if (analysis::is_countable(message.utime)) {
        Axis* of = axis(message.machine, message.axis, place);
        if (of != nullptr) { of->begin(message.utime, message.sequence == 0); }
    }
    if (analysis::is_message_number(message.sequence)) {
        end_.saw(RecordKind::Position, message.machine, message.axis, message.incarnation, message.sequence);
    }
    const auto of = machines_.find(message.machine);
    if (of == machines_.end()) { return; }
    const auto found = of->second.axes.find(message.axis);
    if (found == of->second.axes.end()) { return; }
    of->second.note_message(*found->second, message.incarnation, message.utime);
    of->second.records.pass(message.utime);
    check_place(message, of->second);
    if (const auto position = analysis::to_position(message); position && !make_follower_) {
        found->second->check.take(*position);
    }
    found->second->last.is_moving = message.velocity_steps_per_s != 0;
    if (message.fault == static_cast<std::int32_t>(FaultCode::DeviceLost)) { found->second->check.device_lost(); }
}

/// The position in mm must be that in steps.
void LogCheck::check_place(const axis_position_t& message, const Machine& of) {
    constexpr double kRounding_steps = 1e-3;
    if (make_follower_ || !of.config) { return; }
    const auto motor = motor_named(*of.config, message.axis);
    if (!motor) { return; }
    const double steps = message.position_mm * motor_steps_per_mm(*of.config, *motor);
    const auto counted = static_cast<double>(message.position_steps);
    if (std::abs(steps - counted) <= kRounding_steps + std::abs(counted) * 1e-9) { return; }
    findings_.differ({.text = fmt::format("{}: its position at tick {} is recorded as {} steps and as {} mm, which "
                                          "are {} steps",
                                          findings_.label_of(message.axis), message.tick, message.position_steps,
                                          message.position_mm, steps),
                      .axis = message.axis,
                      .tick_expected = {},
                      .tick_seen = Tick{message.tick},
                      .commanded = {}});
}

void LogCheck::on_job(const analysis::RecordedJob& message, analysis::LogPlace place) {
    if (!analysis::is_countable(message.start_tick) || !analysis::is_message_number(message.sequence) ||
        !std::ranges::all_of(message.start_count, analysis::is_countable)) {
        return on_damage(place, "a job with impossible numbers");
    }
    if (!Overrides::allows(message.feed_percent) || !Overrides::allows(message.rapid_percent)) {
        return on_damage(place, "a job with overrides that are out of range");
    }
    if (Machine* of = machine(message.machine, place); of != nullptr) {
        of->set_config(message.config, findings_);
        of->homings.take(message);
    }
    take_record(message, RecordKind::Job, place);
}

void LogCheck::on_damage(analysis::LogPlace place, std::string what) {
    if (++damages_ > kDamagesNoted) { return; }
    findings_.notes.push_back(fmt::format("damaged at byte {}: {}", place.offset, what));
}

void LogCheck::Machine::set_config(const std::string& text, Findings& findings) {
    if (config || text.empty()) { return; }
    auto parsed = parse_machine(text);
    if (!parsed) { return; }
    config = std::move(*parsed);
    for (auto& [name, axis] : axes) { axis->check.set_machine(*config); }
    findings.labels.add(Kinematics(*config));
}

/// The log must have messages of each axis of the machine's file, and of no other.
void LogCheck::Machine::check_axes(Findings& findings) const {
    if (!config) { return; }
    const auto names = motor_names(*config);
    for (const std::string& name : marked_axes) {
        if (axes.contains(name) || std::ranges::find(names, name) != names.end()) { continue; }
        findings.add_missing("axis " + name + ": marks count its messages, but the machine has no such axis");
    }
    for (const auto& [name, axis] : axes) {
        if (std::ranges::find(names, name) != names.end()) { continue; }
        findings.differ({.text = "the log has messages of axis " + name + ", which the machine does not have",
                         .axis = name,
                         .tick_expected = {},
                         .tick_seen = {},
                         .commanded = {}});
    }
    for (const std::string& name : names) {
        if (!axes.contains(name)) {
            findings.add_missing(findings.label_of(name) + ": no message of it is in the log");
        }
    }
}

LogCheck::Machine* LogCheck::machine(const std::string& name, analysis::LogPlace place) {
    const auto known = machines_.find(name);
    if (known != machines_.end()) { return &known->second; }
    if (machines_.size() == kMaxMachines) {
        on_damage(place, "too many machines for one log");
        return nullptr;
    }
    return &machines_.try_emplace(name, findings_).first->second;
}

LogCheck::Axis* LogCheck::axis(const std::string& machine_name, const std::string& name, analysis::LogPlace place) {
    Machine* of = machine(machine_name, place);
    if (of == nullptr) { return nullptr; }
    if (of->axes.size() == kMaxAxes && !of->axes.contains(name)) {
        on_damage(place, "more axes than a machine can have");
        return nullptr;
    }
    auto& found = of->axes[name];
    if (found) { return found.get(); }
    found = std::make_unique<Axis>(name, findings_, make_follower_ ? nullptr : &of->jobs);
    if (of->config) { found->check.set_machine(*of->config); }
    if (make_follower_) {
        found->follower = make_follower_(machine_name, name, findings_);
        found->check.set_follower(*found->follower);
    }
    return found.get();
}

void LogCheck::Axis::begin(std::int64_t utime, bool is_its_first) {
    if (first_us || !analysis::is_countable(utime)) { return; }
    first_us = utime;
    is_late = !is_its_first;
}

/// A run is published at its end, with the time of its start. If the log has the axis's first messages, it has all
/// runs.
bool LogCheck::Axis::began_before_log(const analysis::RunMessage& message) const {
    return is_late && (!first_us || message.utime < *first_us + kStall_us);
}

void LogCheck::Machine::note_message(Axis& axis, std::int64_t incarnation, std::int64_t utime) {
    if (!analysis::is_countable(utime)) { return; }
    axis.last.incarnation = incarnation;
    axis.last.received_us = utime;
    last.received_us = utime;
}

/// Uses the time of reception: a run is published at its end, with an older time.
void LogCheck::Machine::note_motion(Axis& axis) {
    axis.last.moved_us = axis.last.received_us;
    last.moved_us = last.received_us;
}

bool LogCheck::Machine::are_at_rest() const {
    return last.are_at_rest() &&
           std::ranges::none_of(axes, [](const auto& axis) { return axis.second->last.is_moving; });
}

/// A process without messages has ended too.
bool LogCheck::Machine::has_ended(const std::string& axis) const {
    const auto known = axes.find(axis);
    return known == axes.end() || last.has_ended(known->second->last);
}

void LogCheck::Machine::finish(const std::string& name, const analysis::RecordEnd& end, bool is_damaged) {
    for (auto& [axis, of] : axes) { of->runs.finish(); }
    records.finish();
    const bool lacks_jobs = is_damaged || end.lacks(RecordKind::Job, name, "");
    jobs.finish(
        {.at_rest = are_at_rest(),
         .lacks_records = lacks_jobs,
         .lacks_any_run = is_damaged || std::ranges::any_of(end.missing,
                                                            [&](const analysis::MissingEnd& one) {
                                                                return one.kind == RecordKind::Run &&
                                                                       one.process.machine == name;
                                                            }),
         .has_ended = [this](const std::string& axis) { return has_ended(axis); },
         .lacks_runs = [&](const std::string& axis) { return is_damaged || end.lacks(RecordKind::Run, name, axis); }});
    for (auto& [axis, of] : axes) {
        of->check.finish([&](std::int64_t incarnation) { return last.has_ended(of->last, incarnation); },
                         {.begins_late = of->is_late,
                          .ends_early = of->last.is_cut(),
                          .lacks_steps = is_damaged || end.lacks(RecordKind::Steps, name, axis),
                          .lacks_runs = is_damaged || end.lacks(RecordKind::Run, name, axis),
                          .lacks_jobs = lacks_jobs || jobs.lacks_records()},
                         homings);
        of->outputs.finish(!is_damaged && !of->is_late && !of->last.is_cut() && !end.may_lack_changes(name, axis));
    }
    touches.finish([&](const std::string& motor) {
        const auto of = axes.find(motor);
        return is_damaged || of == axes.end() || of->second->outputs.lacks_changes() ||
               end.may_lack_changes(name, motor);
    });
}

Findings LogCheck::finish() {
    analysis::RecordEnd end = end_.finish();
    end.labels = findings_.labels;
    for (auto& [name, machine] : machines_) {
        machine.finish(name, end, damages_ > 0);
        machine.check_axes(findings_);
    }
    if (!make_follower_) { findings_.end = end; }
    for (std::string& line : analysis::open_sentences(findings_.end)) { findings_.notes.push_back(std::move(line)); }
    if (damages_ > kDamagesNoted) {
        findings_.notes.push_back(fmt::format("and {} more damaged places", damages_ - kDamagesNoted));
    }
    if (findings_.local_runs > 0) {
        findings_.notes.push_back(
            fmt::format("{} runs of axes on their own (homing, own moves) were compared only with their records",
                        findings_.local_runs));
    }
    if (findings_.clock_error > Ticks{} && findings_.verdict() == Verdict::Exact) {
        findings_.notes.push_back(
            fmt::format("the axes knew machine time within {} ticks: every step is at its exact tick by its device's "
                        "clock, and by machine time within {} ticks of the tick planned",
                        findings_.clock_error.value, findings_.latest.value));
    }
    return std::move(findings_);
}

}  // namespace lockstep::verification
