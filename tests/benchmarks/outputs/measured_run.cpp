#include "tests/benchmarks/outputs/measured_run.hpp"

#include <time.h>

#include <stdexcept>

#include "clients/simulation/machine_recorder.hpp"
#include "services/wire/lcm/lcm_log.hpp"

namespace lockstep {
namespace {

using std::chrono::nanoseconds;

constexpr Ticks kLongest{3'600'000'000};

nanoseconds cpu_time() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

/// Counts what would be written into logs.
class CountingSink final : public RecordSink {
public:
    void write(const std::string& channel, std::int64_t /*utime*/, std::span<const std::uint8_t> data) override {
        bytes += static_cast<std::int64_t>(LogWriter::event_bytes(channel, data));
    }
    std::int64_t bytes = 0;
};

/// Notes which process ran, and counts.
class Meter final : public VirtualObserver {
public:
    enum class Ran : std::uint8_t { Nothing, Motor, Coordinator };

    explicit Meter(const FrameBytes& frame_bytes) : frame_bytes_(frame_bytes) {}

    void on_step(MotorIndex /*axis*/, StepEdge /*step*/) override { ++figures.steps; }
    void on_channel(MotorIndex /*axis*/, const ChannelEvent& event) override {
        figures.changes += event.kind == ChannelEvent::Kind::Input ? 0 : 1;
    }
    void on_axis(MotorIndex /*axis*/, Tick /*now*/, const AxisOutputs& /*out*/, AxisNode& /*node*/) override {
        ran = Ran::Motor;
    }
    void on_coordinator(std::size_t /*process*/, Tick /*now*/, const CoordinatorOutputs& out) override {
        ran = Ran::Coordinator;
        for (const Frame& frame : out.frames) { figures.frame_bytes += static_cast<std::int64_t>(frame_bytes_(frame)); }
    }
    void note(nanoseconds took) {
        if (ran == Ran::Motor) { figures.motors.push_back(took); }
        if (ran == Ran::Coordinator) { figures.coordinator.push_back(took); }
        ran = Ran::Nothing;
    }

    RunFigures figures;
    Ran ran = Ran::Nothing;

private:
    const FrameBytes& frame_bytes_;
};

class Run {
public:
    Run(const MachineConfig& machine, const FrameBytes& frame_bytes)
        : vm_({.machine = MachineSetup{machine}}), meter_(frame_bytes) {
        vm_.observe(meter_);
        reach(MachinePhase::Idle);
        (void)vm_.command(CommandKind::Home);
        reach(MachinePhase::Homing);
        reach(MachinePhase::Idle);
    }

    RunFigures job(const Program& program) {
        vm_.give_program(1, program);
        const std::uint64_t before = vm_.state()->job;
        (void)vm_.command(CommandKind::Run, {}, 1);
        meter_.figures = {};
        sink_.bytes = 0;
        const Tick begun = vm_.now();
        const auto has_ended = [&] { return vm_.state()->job > before && vm_.state()->phase == MachinePhase::Idle; };
        while (!has_ended() && vm_.now() < begun + kLongest) {
            const nanoseconds since = cpu_time();
            vm_.advance();
            meter_.note(cpu_time() - since);
        }
        if (!has_ended() || vm_.state()->job_fault != FaultCode::None) {
            throw std::runtime_error("the job does not end well");
        }
        recorder_.finish();
        meter_.figures.record_bytes = sink_.bytes;
        return std::move(meter_.figures);
    }

private:
    void reach(MachinePhase phase) {
        if (vm_.advance_until([&] { return vm_.state() && vm_.state()->phase == phase; }, kLongest)) { return; }
        throw std::runtime_error("the machine cannot be homed");
    }

    CountingSink sink_;
    VirtualMachine vm_;
    MachineRecorder recorder_{vm_, sink_};
    Meter meter_;
};

}  // namespace

RunFigures measured_run(const MachineConfig& machine, const Program& program, const FrameBytes& frame_bytes) {
    return Run(machine, frame_bytes).job(program);
}

}  // namespace lockstep
