#include "clients/verification/jobs/epoch_progress.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/outputs/output_levels.hpp"
#include "core/protocol/names.hpp"

namespace lockstep::verification {

void EpochProgress::begin(CheckedJob& job, EpochStart start, const RecordedJob& record) {
    const auto epoch = static_cast<Epoch>(record.epoch);
    if (!job.is_in_pause) {
        events_.check_rest(start.place.block, start.place.block);
        events_.begin_epoch(epoch, record.coordinator);
    }
    const MotorPositions at = start.at;
    job.begun_at = at;
    job.plays = record.start_count;
    const MachineConfig& machine = job.replay->machine();
    ProgramDevices devices = events_.devices().state();
    if (job.is_in_pause || record.kind == name_of(JobKind::Jog)) { devices.pulses = {}; }
    const Overrides overrides{record.feed_percent, record.rapid_percent};
    epoch_.emplace(machine, EpochReplay(machine, epoch, std::move(start), overrides, {record.start_tick}, devices), at);
    outputs_.begin(machine, events_.devices().are_known());
    epochs_.begin(epoch, job.label);
}

void EpochProgress::lose() {
    if (epoch_) { epochs_.lose(epoch_->epoch()); }
    epoch_.reset();
}

void EpochProgress::take_equal(const AxisRun& of, MotorIndex motor, const std::function<std::string()>& commanded) {
    ++findings_.runs;
    outputs_.take(of, epoch_->replay().frame(of.run.frame), motor, commanded);
}

void EpochProgress::close(CheckedJob& job, bool goes_on, bool lacks_events) {
    if (!epoch_) { return; }
    courses_.plan(*epoch_);
    job.ran = epoch_->ran();
    const std::size_t axes = motor_count(epoch_->machine());
    std::optional<Shortfall> found = epoch_->shortfall();
    for (std::size_t i = 0; goes_on && i < axes && found && suspect(*found, job.label); ++i) {
        found = epoch_->shortfall();
    }
    found ? job.break_off(*found, findings_) : take_end(job, lacks_events);
    epoch_.reset();
}

/// If an axis has nothing more in the log, its runs may be missing. The epoch is then taken for complete, if others ran
/// further; the axis's next run shows whether runs are missing.
bool EpochProgress::suspect(const Shortfall& shortfall, const std::string& job) {
    const std::string& axis = motor_name(epoch_->machine(), shortfall.motor);
    if (shortfall.kind != Shortfall::Kind::Silent) { return false; }
    const FrameNumber most = epoch_->ran();
    if (!epoch_->assume_complete(shortfall.motor)) { return false; }
    questions_.ask_silence(axis, epoch_->epoch(),
                           {.text = fmt::format("{} {}, though {} went on to frame {}", findings_.label_of(axis),
                                                shortfall.text, job, most),
                            .axis = axis,
                            .tick_expected = {},
                            .tick_seen = {},
                            .commanded = job});
    return true;
}

/// Takes the state of the job after an epoch that all axes ran to its end.
void EpochProgress::take_end(CheckedJob& job, bool lacks_events) {
    const EpochEnd end = epoch_->end();
    const bool is_whole = end.kind == EpochEnd::Kind::Complete;
    const std::uint32_t rests_before = is_whole ? epoch_->replay().source()->end().block : end.place.block;
    job.replay->ended(end, epoch_->replay().source());
    if (job.is_in_pause) { return; }
    events_.check_motion(epoch_->replay().take_events(end.ran), lacks_events);
    events_.check_rest(lacks_events ? 0 : rests_before, job.replay->moves_from());
    if (end.ran > 0) { note_pulses(); }
}

/// How many are left decides what the next epoch begins with.
void EpochProgress::note_pulses() {
    KnownDevices& devices = events_.devices();
    for (const OutputConfig& output : epoch_->machine().outputs) {
        if (!output.makes_pulses() || !is_active(output, devices.state())) { continue; }
        const auto& left = outputs_.left(output.motor);
        left ? devices.note_pulses(*left) : devices.lose();
    }
}

std::vector<Course> EpochProgress::planned(const std::string& motor, Tick tick) {
    if (epoch_) { courses_.plan(*epoch_); }
    return courses_.of(motor, tick);
}

}  // namespace lockstep::verification
