#include "services/axis/axis_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "core/kinematics/kinematics.hpp"
#include "core/protocol/rival.hpp"
#include "core/protocol/second_process.hpp"
#include "services/axis/axis_network.hpp"
#include "services/axis/axis_node.hpp"
#include "services/axis/axis_notices.hpp"
#include "services/axis/board_port.hpp"
#include "services/axis/device_window.hpp"
#include "services/axis/position_file.hpp"
#include "services/axis/window_port.hpp"
#include "services/documents/edit/kept_settings.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/placement.hpp"
#include "services/flight/check_report.hpp"
#include "services/flight/flight_recorder.hpp"
#include "services/flight/stuck_process.hpp"
#include "services/network/host_name.hpp"
#include "services/record/axis_recorder.hpp"
#include "services/record/own_log.hpp"
#include "services/record/sinks.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/end_guard.hpp"
#include "services/runtime/log.hpp"
#include "services/runtime/loop_watchdog.hpp"
#include "services/runtime/periodic.hpp"
#include "services/runtime/real_time.hpp"
#include "services/runtime/service_manager.hpp"
#include "services/runtime/stop_signal.hpp"
#include "services/security/service_admission.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep {
namespace {

using std::chrono::nanoseconds;

OpenDevice opener_of(const DeviceName& device, const MotorConfig& motor, const MachineClock& clock,
                     const MachineSetup& machine) {
    if (device.kind == DeviceName::Kind::Simulated) {
        return [machine, motor](Tick now) { return simulated_port(machine, motor, now, machine.network.domain); };
    }
    if (device.kind == DeviceName::Kind::Linked) {
        MotorConfig linked = motor;
        linked.device = device;
        return [clock, machine, linked](Tick) { return BoardPort::open(machine, linked, clock); };
    }
    return [device, clock, machine, motor](Tick) -> std::expected<std::unique_ptr<DevicePort>, std::string> {
        auto window = open_window(device, machine);
        if (!window) { return std::unexpected(window.error()); }
        const bool has_own_clock = window->is_hardware();
        auto driver = attach_driver(std::move(*window), machine, motor);
        if (!driver) { return std::unexpected(driver.error()); }
        if (!has_own_clock) { return std::make_unique<WindowPort>(std::move(*driver)); }
        return std::make_unique<WindowPort>(std::move(*driver), [clock] { return clock.now(); });
    };
}

void report_disk_failure(const std::string& why) {
    log_warning("the position is not kept, so a new process of this axis must be homed: " + why +
                "; set position_directory to a directory that can be written");
}

KeptOrNot kept_position(const MachineSetup& machine, MotorIndex motor) {
    ReadPosition read = read_position(position_file(machine, motor));
    if (!read.trouble.empty()) { log_warning("the kept position is refused: " + read.trouble); }
    return std::move(read.kept);
}

/// The state of the process's loop.
class AxisService {
public:
    AxisService(const MachineSetup& machine, const AxisNode::Setup& setup, const DeviceName& device,
                const MachineClock& clock, AxisNetwork network, std::unique_ptr<RecordSink> sink)
        : machine_(machine),
          setup_(setup),
          device_(device.text()),
          clock_(clock),
          node_(setup, opener_of(device, motors_of(setup.machine)[setup.motor], clock, machine)),
          network_(std::move(network)),
          sink_(std::move(sink)),
          flight_log_(open_flight(machine, motor_name(setup.machine, setup.motor), setup.identity)),
          flight_(setup.motor, setup.machine, *flight_log_),
          recorder_(setup.machine, setup.motor, setup.identity, *sink_),
          keeper_(position_file(machine, setup.motor), report_disk_failure),
          meter_(setup.motor, setup.identity, setup.machine.tick_ns) {
        node_.measure(meter_);
        node_.note_in(flight_);
        node_.pass_channels([this](const ChannelEvent& event) { recorder_.channel(event); });
        recorder_.reserve(registers::kCaptureRingMostEntries, registers::kEventRingMostEntries);
    }

    AxisService(const AxisService&) = delete;  // the node points to members of this object
    AxisService& operator=(const AxisService&) = delete;

    /// `begun` is the loop's scheduled start on CLOCK_MONOTONIC. Returns false if this process must end; see
    /// end_reason().
    bool loop(nanoseconds begun, std::uint64_t skipped_loops) {
        const AxisReceived& in = receive();
        const Tick now = clock_.now();
        if (user_signal_.take()) { flight_log_->incident(node_.now(), IncidentReason::Asked); }
        const AxisOutputs& out =
            node_.step(now, {in.frames, in.states, in.machine, in.commands, in.requests, in.exchanges},
                       [this](StepEdge step) { recorder_.step(step); });
        looped_ = node_.now();
        if (out.state) { network_.publish(*out.state); }
        for (const MachineState& state : in.machine) { recorder_.note_coordinator(state); }
        recorder_.lost_channel_events(node_.device().lost_channel_events());
        recorder_.loop(out, node_.controller().zero_count(), node_.device().lost_captures());
        if (out.rests) { keeper_.keep(*out.rests); }
        for (const AxisNotice& notice : out.notices) { log_notice(notice); }
        report_device();
        tend_network(now);
        end_if_coordinator_clock_restarted();
        report_waiting(now);
        log_security(begun);
        meter_.loop_took({(monotonic_now() - begun).count() / setup_.machine.tick_ns});
        say_health(skipped_loops);
        return end_reason_.empty();
    }

    const std::string& end_reason() const { return end_reason_; }

    void finish() { recorder_.finish(); }

    /// The watchdog's thread calls this when the loop is stuck.
    [[noreturn]] void end_as_stuck() { end_stuck_process(*flight_log_, looped_, setup_.machine.tick_ns); }

private:
    const AxisReceived& receive() {
        const AxisReceived& in = network_.receive();
        const Slot slot = rules::slot_of(node_.now(), setup_.machine.slot_ticks());
        for (const AxisState& state : in.states) {
            if (state.axis == setup_.motor && state.identity != setup_.identity) { meet_rival(state, slot); }
        }
        const auto owns = [](const MachineState& m) { return m.phase != MachinePhase::Standby; };
        if (std::ranges::any_of(in.machine, owns)) { machine_received_ = clock_.now(); }
        return in;
    }

    /// Called when another process publishes as this axis: one of the two must end.
    void meet_rival(const AxisState& state, Slot slot) {
        const bool proved = second_.proves(state.identity, state.stamp, slot);
        if (!rival_.must_leave(state.identity, proved, own_now())) { return; }
        const std::string host = network_.host_of_rival();
        end_reason_ = fmt::format("{} is already run by another process{}; end one of them: lockstep down, on its host",
                                  own_label(), (host.empty() ? "" : " on host " + host));
    }

    /// CLOCK_MONOTONIC in ticks. It is independent of the machine's time source and of injected clock errors.
    Tick own_now() const { return {monotonic_now().count() / setup_.machine.tick_ns}; }

    void tend_network(Tick now) {
        const auto reason = network_.tend(now, node_.controller().at_rest());
        if (!reason) { return; }
        flight_log_->add({.tick = node_.now(),
                          .kind = FlightKind::Reopened,
                          .detail = static_cast<std::uint8_t>(*reason),
                          .count = static_cast<std::int64_t>(network_.reopened())});
        log_warning("opens its DDS participant again: " + std::string(text_of(*reason)));
    }

    void say_health(std::uint64_t skipped_loops) {
        auto health = meter_.report(node_.clock_error(), {.messages = network_.refused(),
                                                          .orders = node_.device().troubles(),
                                                          .captures = node_.device().lost_captures(),
                                                          .records = sink_->failures(),
                                                          .skipped_loops = skipped_loops});
        if (!health) { return; }
        health->published = recorder_.published();
        health->process = {.reopened = network_.reopened(), .lost_log_lines = lost_log_lines()};
        network_.publish(*health);
        recorder_.health(*health);
    }

    void report_device() {
        const bool has_device = node_.lacks().empty();
        if (has_device == has_device_) { return; }
        has_device_ = has_device;
        has_device ? log_info("device " + device_ + " is present") : report_missing_device();
    }

    void report_missing_device() const { log_warning("waits for its device " + device_ + ": " + node_.lacks()); }

    /// Logs every few seconds that the coordinator, its clock or the device is missing, and new refused messages, lost
    /// records and device errors.
    void report_waiting(Tick now) {
        const Ticks period{5'000'000'000 / setup_.machine.tick_ns};
        if (now - reported_ < period) { return; }
        reported_ = now;
        if (now - machine_received_ > period) {
            log_info("waits for the coordinator of machine " + setup_.machine.name);
        }
        if (const std::uint64_t lost = sink_->failures(); lost != lost_records_) {
            lost_records_ = lost;
            log_warning(lost_records_text(machine_, lost));
        }
        const std::uint64_t refused = network_.refused();
        if (refused != refused_) {
            refused_ = refused;
            log_warning("{} messages refused so far: {}", refused, network_.refusals());
        }
        if (!has_device_) { report_missing_device(); }
        if (!node_.knows_time()) { log_info("waits for the coordinator's clock"); }
        if (node_.device().trouble() != trouble_) {
            trouble_ = node_.device().trouble();
            log_event(spdlog::level::err, FaultCode::DeviceFault, trouble_);
        }
    }

    void end_if_coordinator_clock_restarted() {
        if (!node_.must_restart()) { return; }
        end_reason_ = fmt::format(
            "the coordinator's clock went back by {} s; its host may have restarted. Restart {}, so that it uses "
            "the new time",
            node_.clock_error().value * setup_.machine.tick_ns / 1'000'000'000, own_label());
    }

    const std::string& own_name() const { return motor_name(setup_.machine, setup_.motor); }
    std::string own_label() const { return Kinematics(setup_.machine).label(setup_.motor); }

    MachineSetup machine_;
    AxisNode::Setup setup_;
    std::string device_;  // its name
    MachineClock clock_;
    AxisNode node_;
    AxisNetwork network_;
    std::unique_ptr<RecordSink> sink_;
    std::unique_ptr<FlightLog> flight_log_;
    CheckReport checks_{*flight_log_};
    AxisFlight flight_;
    UserSignal user_signal_;  // SIGUSR1: a person requests the notes of the last seconds
    AxisRecorder recorder_;
    PositionKeeper keeper_;
    HealthMeter meter_;
    std::atomic<Tick> looped_;  // when the loop last ran
    Tick reported_ = clock_.now();
    Tick machine_received_;
    std::uint64_t refused_ = 0;
    std::uint64_t lost_records_ = 0;
    std::string trouble_;
    bool has_device_ = true;                       // as last logged
    SecondProcess second_{setup_.machine.timing};  // another process that publishes as this axis
    Rival rival_{setup_.identity, setup_.machine.tick_ns, own_now()};
    std::string end_reason_;
};

int run(const AxisServiceOptions& options, const MachineSetup& machine, MotorIndex motor, const DeviceName& device) {
    StopSignal stop;
    const EndGuard guard(stop);
    for (const std::string& line : ask_for_real_time(machine.real_time)) { log_info(line); }
    const MachineClock clock(machine.tick_ns, machine.timing.time_source, options.clock_error);
    const AxisNode::Setup setup{motor, machine, static_cast<Identity>(monotonic_now().count()), config_hash(machine),
                                kept_position(machine, motor)};
    const auto admission = admit_service(machine, axis_member(machine, motor));
    if (!admission) { return end_with_failure(admission.error()); }
    auto network = AxisNetwork::open({machine, motor, setup.identity, clock, *admission});
    if (!network) { return end_with_failure(network.error()); }
    AxisService service(machine, setup, device, clock, std::move(*network),
                        open_record(machine, motor_name(machine, motor), options.record));
    const std::string label = Kinematics(machine).label(motor);
    log_info(fmt::format("{} of machine {} is up, device {}", label, machine.name, device.text()));

    ServiceManager manager;
    manager.ready(fmt::format("{} of machine {}", label, machine.name));
    PeriodicLoop periodic(loop_period(machine));
    std::optional<LoopWatchdog> watchdog([&] { service.end_as_stuck(); });
    periodic.run(stop, [&](nanoseconds begun) {
        watchdog->note_loop();
        manager.alive(begun);
        if (!service.loop(begun, periodic.skipped_periods())) { stop.request(); }
    });
    watchdog.reset();
    manager.stopping();
    service.finish();
    log_info("ends; {} loops skipped, the latest {} us late", periodic.skipped_periods(),
             periodic.worst_lateness().count() / 1000);
    return service.end_reason().empty() ? kServiceDone : end_with_failure(service.end_reason());
}

}  // namespace

int serve_axis(const AxisServiceOptions& options) {
    const auto loaded = load_machine(options.machine_file);
    if (!loaded) { return end_with_bad_input(to_text(options.machine_file.string(), loaded.error())); }
    const MachineSetup& machine = loaded->config;
    const auto motor = axis_to_run(machine, options.axis, host_name());
    if (!motor) { return end_with_bad_input(options.machine_file.string() + ": " + motor.error()); }
    const MotorConfig config = motors_of(machine)[*motor];
    const auto device = options.fpga.empty() ? std::optional(config.device) : read_device_name(options.fpga);
    if (!device) { return end_with_bad_input(fmt::format("--fpga {}: it must be {}", options.fpga, kDeviceNames)); }
    if (options.clock_error != ClockError{} && machine.timing.time_source != TimeSource::Network) {
        return end_with_bad_input(
            "--clock-error needs time_source: NETWORK; with the machine's time_source nothing would correct the clock");
    }
    if (options.clock_error != ClockError{} && device->kind != DeviceName::Kind::Simulated) {
        return end_with_bad_input("--clock-error needs --fpga sim, because the clock of lockstep-fpga has no error");
    }
    if (device->has_own_clock() && !estimates_clock(machine, *motor)) {
        return end_with_bad_input("--fpga " + options.fpga +
                                  ": such a device has a clock of its own, for which the frames must leave room; set "
                                  "it in the machine's file, as `device` of " +
                                  Kinematics(machine).label(*motor) + ", so that the coordinator knows");
    }
    if (auto log = open_log({"axis", config.name, options.log_file, true}); !log) {
        return end_with_bad_input(log.error());
    }
    if (!loaded->settings.empty()) { log_info(settings_notice(loaded->settings)); }
    return run(options, machine, *motor, *device);
}

}  // namespace lockstep
