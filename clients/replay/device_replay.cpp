#include "clients/replay/device_replay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"
#include "core/number_text.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/device.hpp"

namespace lockstep::replay {
namespace {

constexpr std::int64_t kTick_ns = 1000;  // any value, the same for device and driver: all times are in ticks
constexpr std::size_t kStepsAtOnce = registers::kCaptureRingMostEntries / 2;

/// An axis without a switch within reach.
MotorConfig endless_axis() {
    constexpr double kFar_mm = 1e15;
    MotorConfig axis;
    axis.steps_per_mm = 1;
    axis.position_min_mm = -kFar_mm;
    axis.position_max_mm = kFar_mm;
    axis.homing.switch_position_mm = -kFar_mm;
    return axis;
}

/// Drops pieces beyond a frame's capacity. The check at the end finds that the device then ends at another count.
void copy_pieces(const Run& run, auto& pieces) {
    for (const Piece& piece : run.pieces) { (void)pieces.push_back(piece); }
}

}  // namespace

struct DeviceReplay::Hardware {
    explicit Hardware(Tick now)
        : device(window, Plant(endless_axis(), kTick_ns), kTick_ns, now),
          driver(DeviceDriver::attach(window, kTick_ns).value()) {
        driver.set_up({}).value();
    }

    RegisterWindow window = RegisterWindow::in_process();
    SimulatedDevice device;
    DeviceDriver driver;
};

DeviceReplay::DeviceReplay(std::string axis, verification::Findings& findings, OnStep on_step)
    : axis_(std::move(axis)), findings_(findings), on_step_(std::move(on_step)) {}

DeviceReplay::~DeviceReplay() = default;

void DeviceReplay::on_run(const Run& run) {
    newest_.reset();
    if (held_ && !is_next(tail_.value_or(*held_), run)) { end_motion(); }
    if (!findings_.going() || !power_up(run)) { return; }
    newest_ = run;
    newest_step_.reset();
    count_ = run.from.count();
    if (held_ && run.tail) {
        tail_ = run;
        return;
    }
    if (held_) {
        load_frame(false);
        play(held_->start + held_->ticks() - Ticks{1});  // the next frame must be loaded before this one ends
        if (findings_.going()) { look_for_refusal(); }
    } else {
        begin_motion();
    }
    held_ = run;
}

/// Returns false if the run must be skipped: a device that was just powered up is at rest on a whole step.
bool DeviceReplay::power_up(const Run& run) {
    if (hardware_ && incarnation_ == run.incarnation) { return true; }
    if (run.tail || !starts_from_rest(run)) {
        if (skipped_++ == 0) { first_skipped_ = name_of(run); }
        return false;
    }
    note_skipped();
    hardware_ = std::make_unique<Hardware>(run.start - Ticks{1});
    incarnation_ = run.incarnation;
    count_at_power_up_ = run.device_start();
    motion_ = 0;
    return true;
}

/// One note for all runs up to the first motion from rest.
void DeviceReplay::note_skipped() {
    if (skipped_ == 0) { return; }
    const bool is_one = skipped_ == 1;
    const std::string others = is_one ? "" : fmt::format(" and {} after it", plural(skipped_ - 1, "run"));
    findings_.notes.push_back(fmt::format("{}: {}{} {} skipped, because the log lacks the motion to {} start",
                                          findings_.label_of(axis_), first_skipped_, others, is_one ? "is" : "are",
                                          is_one ? "its" : "their"));
    skipped_ = 0;
}

void DeviceReplay::begin_motion() {
    order(device::BeginRun{++motion_});
    frame_ = 0;
}

void DeviceReplay::on_step(StepEdge step, Tick commanded, bool is_recorded) {
    if (!newest_) { return; }
    count_ += step.direction;
    newest_step_ = step.tick;
    expected_.push_back({{step, commanded, newest_->clock_error, count_, newest_->incarnation}, is_recorded});
}

void DeviceReplay::on_run_over() {
    if (newest_) { ++findings_.runs; }
}

/// A new device continues with the next motion from rest.
void DeviceReplay::on_gap() {
    held_.reset();
    tail_.reset();
    newest_.reset();
    expected_.clear();
    hardware_.reset();
}

void DeviceReplay::on_end() {
    if (held_) { end_motion(); }
    note_skipped();
}

/// Writes the held frame with its tail through the driver and arms it.
void DeviceReplay::load_frame(bool is_last) {
    const std::int64_t to_device = held_->zero_count - count_at_power_up_;
    device::LoadFrame frame{++frame_, held_->start, is_last, {}};
    frame.track.from = held_->from + Displacement::steps(to_device);
    copy_pieces(*held_, frame.track.body);
    if (tail_) { copy_pieces(*tail_, frame.track.tail); }
    order(frame);
    order(device::Arm{frame_});
}

/// Advances the device and reads its steps often enough that its capture ring never fills up.
void DeviceReplay::play(Tick until) {
    const auto advance = [this](Tick to) {
        hardware_->device.advance(to);
        const auto drained = hardware_->driver.drain_capture([this](StepEdge made) { take(made); });
        if (!drained) { differ(drained.error(), {}, {}); }
    };
    while (findings_.going() && expected_.size() > kStepsAtOnce && expected_[kStepsAtOnce].step.edge.tick < until) {
        advance(expected_[kStepsAtOnce].step.edge.tick);
    }
    if (findings_.going()) { advance(until); }
}

void DeviceReplay::take(StepEdge made) {
    if (!findings_.going()) { return; }
    if (expected_.empty()) { return differ("the device makes a step that is not in the log", {}, made.tick); }
    const auto [step, is_recorded] = expected_.front();
    if (made != step.edge) {
        return differ(fmt::format("the device steps at tick {} {}, but the log has a step at tick {} {}",
                                  made.tick.value, made.direction > 0 ? "forward" : "backward", step.edge.tick.value,
                                  step.edge.direction > 0 ? "forward" : "backward"),
                      step.edge.tick, made.tick);
    }
    expected_.pop_front();
    if (is_recorded) { ++findings_.steps; }
    findings_.last_tick = std::max(findings_.last_tick.value_or(made.tick), made.tick);
    on_step_(step);
}

/// No frame follows the held one, only its tail if it has one.
void DeviceReplay::end_motion() {
    load_frame(!tail_);
    const Run& last = tail_ ? *tail_ : *held_;
    if (last.cut) {
        play(newest_step_.value_or(last.start));
        order(device::StopNow{});
        hardware_->device.advance(hardware_->device.now());
    } else {
        play(last.start + last.ticks());
    }
    if (findings_.going()) { look_at_end(); }
    held_.reset();
    tail_.reset();
}

/// Names the frame that the device refused, while it is the newest.
void DeviceReplay::look_for_refusal() {
    const auto status = hardware_->driver.read();
    if (!status) { return differ(status.error(), {}, {}); }
    if (!status->bad_segment) { return; }
    differ("the device refuses a frame that does not start at the end of the frame before it",
           (tail_ ? *tail_ : *held_).start, {});
}

void DeviceReplay::look_at_end() {
    look_for_refusal();
    const auto status = hardware_->driver.read();
    if (!status || !findings_.going()) { return; }
    const Run& last = tail_ ? *tail_ : *held_;
    if (!expected_.empty()) {
        return differ("the device does not make a step that is in the log", expected_.front().step.edge.tick, {});
    }
    const std::int64_t stands = status->position.count() + count_at_power_up_;
    if (!status->finished || stands != last.device_stop()) {
        differ(fmt::format("the device ends at count {}{}, but the log has {}", stands,
                           status->finished ? "" : ", in motion", last.device_stop()),
               {}, {});
    }
}

void DeviceReplay::order(const DeviceOrder& order) {
    if (!findings_.going()) { return; }
    if (const auto done = hardware_->driver.apply(order); !done) { differ(done.error(), {}, {}); }
}

void DeviceReplay::differ(const std::string& text, std::optional<Tick> expected, std::optional<Tick> seen) {
    const std::string run = tail_ ? name_of(*tail_) : held_ ? name_of(*held_) : "";
    findings_.differ({findings_.label_of(axis_) + ": " + text, axis_, expected, seen, run});
}

}  // namespace lockstep::replay
