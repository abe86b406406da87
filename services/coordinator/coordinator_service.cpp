#include "services/coordinator/coordinator_service.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <memory>

#include "core/coordinator/coordinator.hpp"
#include "core/coordinator/path/coordination.hpp"
#include "core/flight/coordinator_flight.hpp"
#include "core/kinematics/kinematics.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"
#include "core/protocol/names.hpp"
#include "services/coordinator/coordinator_network.hpp"
#include "services/coordinator/file_rows.hpp"
#include "services/coordinator/program_inbox.hpp"
#include "services/coordinator/values_store.hpp"
#include "services/documents/edit/kept_settings.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/values/values_trouble.hpp"
#include "services/files/directories.hpp"
#include "services/flight/check_report.hpp"
#include "services/flight/flight_recorder.hpp"
#include "services/flight/stuck_process.hpp"
#include "services/record/job_recorder.hpp"
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

namespace lockstep {
namespace {

using std::chrono::nanoseconds;

void report_unwritten_values(const std::string& why) {
    log_error("the machine's offsets and tools are not kept: " + why +
              "; make room on the disk, or correct the directory's permissions");
}

class CoordinatorService {
public:
    CoordinatorService(const MachineSetup& machine, Identity identity, CoordinatorNetwork network, RevisedValues values,
                       std::unique_ptr<RecordSink> sink, std::optional<OnTakeover> standby, MakeRows make_rows)
        : machine_(machine),
          kinematics_(machine),
          clock_(machine.tick_ns, machine.timing.time_source),
          coordinator_(machine, identity, config_hash(machine), methods::begin_steps, standby, std::move(make_rows)),
          network_(std::move(network)),
          sink_(std::move(sink)),
          flight_log_(open_flight(machine, "", identity)),
          flight_(machine, *flight_log_),
          recorder_(machine, identity, *sink_),
          values_(values_file(machine.name), std::move(values), report_unwritten_values) {}

    /// Returns false if another coordinator owns this machine.
    bool loop() {
        const CoordinatorReceived& received = receive();
        const Tick now = clock_.now();
        looped_ = now;
        forget_outdated_programs();
        if (user_signal_.take()) { flight_log_->incident(now, IncidentReason::Asked); }
        const CoordinatorInputs in{now, received.states, received.others, received.commands, parts_};
        CoordinatorOutputs& out = coordinator_.step(in);
        record_taken(now, out.taken);
        flight_.take(in, out);
        if (out.state) {
            out.state->published = recorder_.published();
            out.state->lost_records = sink_->failures();
            out.state->process = {.reopened = network_.reopened(), .lost_log_lines = lost_log_lines()};
        }
        publish_values(out.jobs);
        network_.publish(out);
        recorder_.note(now);
        recorder_.record(now, out);
        for (const CoordinatorNotice& notice : out.notices) { log_notice(notice); }
        log_writer();
        tend_network(now);
        report_waiting(now);
        log_security(monotonic_now());
        return !out.must_quit;
    }

    void finish() { recorder_.finish(clock_.now()); }

    /// The watchdog's thread calls this when the loop is stuck.
    [[noreturn]] void end_as_stuck() { end_stuck_process(*flight_log_, looped_, machine_.tick_ns); }

private:
    const CoordinatorReceived& receive() {
        const CoordinatorReceived& received = network_.receive();
        read_chunks(received.chunks);
        for (const AxisState& state : received.states) {
            if (state.axis >= motor_count(machine_)) { continue; }
            received_.insert(state.motor());
            config_hashes_[state.axis] = state.config_hash;
        }
        for (const AxisHealth& health : received.healths) { recorder_.note_axis(health); }
        for (const MachineValues& values : received.values) {
            if (!coordinator_.owns_machine()) { values_.follow(values); }
        }
        return received;
    }

    /// Reads a few chunks in each loop. The others wait, and so their sender waits too.
    void read_chunks(const std::vector<ProgramChunk>& received) {
        waiting_.insert(waiting_.end(), received.begin(), received.end());
        if (waiting_.size() > kMostWaiting) { waiting_.resize(kMostWaiting); }
        parts_.clear();
        in_step_.clear();
        for (; !waiting_.empty() && parts_.size() < kPartsAtOnce; waiting_.pop_front()) {
            auto part = inbox_.read(waiting_.front());
            if (!part && coordinator_.owns_machine()) { network_.publish(part.error()); }
            if (!part) { continue; }
            parts_.push_back(*std::move(part));
            in_step_.push_back(std::move(waiting_.front()));
        }
    }

    /// Only the writer may send programs and edits of the machine's values. Only a program's first part is checked,
    /// because its sender may send the rest after another writer has taken over the machine.
    CommandResult accept(const ProgramChunk& chunk, const ProgramDocument& part) {
        if (chunk.index == 0) {
            if (auto may = coordinator_.lease().check(chunk.writer, looped_); !may) { return may; }
        }
        const auto accepted = values_.accept(chunk, part,
                                             {coordinator_.owns_machine(), coordinator_.activity().has_job(),
                                              coordinator_.phase() == MachinePhase::Paused});
        return accepted ? CommandResult{} : refuse(FaultCode::BadProgram, text_of(accepted.error()));
    }

    void record_taken(Tick now, const std::vector<TakenPart>& taken) {
        for (const TakenPart& part : taken) {
            const auto chunk = std::ranges::find_if(in_step_, [&](const ProgramChunk& received) {
                return received.program == part.program && received.index == part.index &&
                       !(received.bytes.empty() && received.count == 0);
            });
            if (chunk != in_step_.end()) { recorder_.record(now, *chunk); }
        }
    }

    /// A job that was taken over needs its program until it ends, so nothing is forgotten during a job.
    void forget_outdated_programs() {
        if (!coordinator_.owns_machine() || coordinator_.activity().has_job()) { return; }
        for (const std::uint64_t program : values_.keeper().take_outdated()) {
            coordinator_.programs().forget(program);
        }
    }

    /// Called before the state that reports the job's end is published. A receiver of that state already has the values
    /// that the job left.
    void publish_values(const std::vector<JobEvent>& events) {
        for (const JobEvent& event : events) { values_.keeper().take(event); }
        if (!coordinator_.owns_machine()) { return; }
        const MachineValues* const values = values_.step(monotonic_now(), coordinator_.term());
        if (values != nullptr) { network_.publish(*values); }
    }

    /// A held job does not count as rest. Reopening the link makes the axes silent, which would end the job.
    bool at_rest() const {
        const MachinePhase phase = coordinator_.phase();
        return phase == MachinePhase::Waiting || phase == MachinePhase::Idle || phase == MachinePhase::Fault ||
               phase == MachinePhase::Standby;
    }

    void tend_network(Tick now) {
        const auto reason = network_.tend(now, {at_rest(), coordinator_.owns_machine()});
        if (!reason) { return; }
        flight_log_->add({.tick = now,
                          .kind = FlightKind::Reopened,
                          .detail = static_cast<std::uint8_t>(*reason),
                          .count = static_cast<std::int64_t>(network_.reopened())});
        log_warning("opens its DDS participant again: " + std::string(text_of(*reason)));
    }

    /// "axis X", "motor Y2"
    std::string label_of(std::uint64_t motor) const {
        return motor < kinematics_.motors().size() ? kinematics_.label(MotorIndex{motor})
                                                   : fmt::format("axis {}", motor);
    }

    std::string cause_of(const CoordinatorNotice& fault, const FaultText& text) const {
        const bool has_motor = is_of_an_axis(fault.fault) && fault.number < motor_count(machine_);
        const std::string inputs =
            has_motor ? causes_of(machine_, motor_name(machine_, MotorIndex{fault.number}), fault.fault) : "";
        return std::string(text.cause) + (inputs.empty() ? "" : ": " + inputs);
    }

    std::string touch_text(std::uint64_t input) const {
        const bool is_held = machine_.inputs[input].at_touch_in_motion == TouchInMotion::Hold;
        return lockstep::label_of(machine_.inputs[input]) +
               " touched while the machine moved without a probing move; it comes to rest" +
               (is_held ? "; find out what it touched, then: lockstep resume, or lockstep stop" : "");
    }

    std::string remedy_of(const CoordinatorNotice& fault, const FaultText& text) const {
        const bool is_of_board = is_of_an_axis(fault.fault) && fault.number >= moving_motor_count(machine_);
        return remedy_text(is_of_board ? for_board(text) : text);
    }

    void log_notice(const CoordinatorNotice& notice) const {
        using Kind = CoordinatorNotice::Kind;
        switch (notice.kind) {
            case Kind::Phase: return log_info("machine is {}", name_of(static_cast<MachinePhase>(notice.number)));
            case Kind::AxisSeen: return log_info("receives " + label_of(notice.number));
            case Kind::AxisGone:
                return log_event(spdlog::level::warn, notice.fault, label_of(notice.number) + " fell silent");
            case Kind::Claimed: return log_info("owns the machine, term {}", notice.number);
            case Kind::StoodDown:
                return log_warning("gives up the machine: another coordinator owns it, term {}", notice.number);
            case Kind::JobCutShort:
                return log_warning(
                    "the previous coordinator's job ended early near line {0}: {1}; the axes rest; continue: lockstep "
                    "run "
                    "FILE --from-line {0}",
                    notice.number, text_of(notice.doubt));
            case Kind::JobContinued:
                return log_info("continues the previous coordinator's job near line {}", notice.number);
            case Kind::ProgramLate:
                return log_warning(
                    "the axes rest on the path after frame {}: no more of the program has arrived; the job continues "
                    "when more arrives",
                    notice.number);
            case Kind::ProgramCut:
                return log_event(spdlog::level::warn, notice.fault,
                                 "the job ended near line {0}, at the end of the blocks received; the axes rest; "
                                 "continue: lockstep run FILE --from-line {0}",
                                 notice.number);
            case Kind::UnattendedRunsOn:
                return log_warning(
                    "the client of job {} fell silent; the job runs on unattended (unattended_job: RUN_ON); hold it: "
                    "lockstep hold",
                    notice.number);
            case Kind::UnattendedHeld:
                return log_warning(
                    "the client of job {} fell silent; the job is held (unattended_job: BE_HELD); continue: lockstep "
                    "resume",
                    notice.number);
            case Kind::HeldByInput: {
                const InputConfig& input = machine_.inputs[notice.number];
                const FaultText& refusal = *find_fault(row_of(input.use).refusal);
                return log_warning("{} closed in motion: {}; the machine comes to rest; {}, then: lockstep resume",
                                   lockstep::label_of(input), refusal.cause, refusal.by_hand);
            }
            case Kind::TouchInMotion: return log_warning(touch_text(notice.number));
            case Kind::EpochBegun: return log_info("epoch {} begun", notice.number);
            case Kind::Interrupted:
                return log_event(
                    spdlog::level::warn, notice.fault,
                    "the axes came to rest together after frame {}, on the path; the job continues from there",
                    notice.number);
            case Kind::Fault: {
                const FaultText* text = find_fault(notice.fault);
                return log_event(
                    spdlog::level::err, notice.fault,
                    label_of(notice.number) + ": " +
                        (text == nullptr ? "" : cause_of(notice, *text) + "; " + remedy_of(notice, *text)));
            }
        }
    }

    void log_writer() {
        const auto& lease = coordinator_.lease().held();
        if (lease == logged_lease_) { return; }
        logged_lease_ = lease;
        log_info(lease ? fmt::format("the writer is {} on {}", lease->writer.name, lease->writer.host)
                       : "there is no writer");
    }

    /// Logs every few seconds: missing axes, configurations that differ, lost records and refused messages.
    void report_waiting(Tick now) {
        const Ticks period{5'000'000'000 / machine_.tick_ns};
        if (now - reported_ < period) { return; }
        reported_ = now;
        for (const MotorIndex i : motor_indices(motor_count(machine_))) {
            if (!received_.contains(i)) { log_info("waits for " + label_of(i) + " " + network_.place_of_states()); }
        }
        for (const MotorIndex motor : motor_indices(motor_count(machine_))) {
            const std::uint64_t hash = config_hashes_[motor];
            if (!received_.contains(motor) || hash == config_hash_) { continue; }
            log_warning(
                "{} runs configuration {:x}, this coordinator {:x}: the machine does not move; give all hosts the "
                "same machine file, then: lockstep down; lockstep up",
                label_of(motor), hash, config_hash_);
        }
        received_ = {};
        if (const std::uint64_t lost = sink_->failures(); lost != lost_records_) {
            lost_records_ = lost;
            log_warning(lost_records_text(machine_, lost));
        }
        const std::uint64_t refused = network_.refused();
        if (refused != refused_) {
            refused_ = refused;
            log_warning("{} messages refused so far: {}", refused, network_.refusals());
        }
    }

    static constexpr std::size_t kPartsAtOnce = 4;   // about 3000 blocks, which take 1 ms
    static constexpr std::size_t kMostWaiting = 64;  // as many as the topic keeps

    MachineSetup machine_;
    Kinematics kinematics_;
    MachineClock clock_;
    Coordinator coordinator_;
    CoordinatorNetwork network_;
    std::unique_ptr<RecordSink> sink_;
    std::unique_ptr<FlightLog> flight_log_;
    CheckReport checks_{*flight_log_};
    CoordinatorFlight flight_;
    UserSignal user_signal_;  // SIGUSR1: a person requests the notes of the last seconds
    JobRecorder recorder_;
    ValuesStore values_;
    ProgramInbox inbox_{[this](const ProgramChunk& chunk, const ProgramDocument& part) { return accept(chunk, part); }};
    std::deque<ProgramChunk> waiting_;
    std::vector<ProgramPart> parts_;     // for the next step
    std::vector<ProgramChunk> in_step_;  // the chunks of parts_
    std::atomic<Tick> looped_;           // when the loop last ran
    Tick reported_ = clock_.now();
    std::optional<HeldLease> logged_lease_;
    MotorSet received_;
    std::array<std::uint64_t, kMaxAxes> config_hashes_{};  // of the axes received so far
    std::uint64_t config_hash_ = config_hash(machine_);
    std::uint64_t refused_ = 0;
    std::uint64_t lost_records_ = 0;
};

/// Chooses where programs are stored. The LAI method plans a program as a whole, so it keeps it in memory.
MakeRows rows_of(const MachineSetup& machine, std::int64_t limit_mb) {
    constexpr std::uint64_t kBytesPerMB = 1'000'000;
    if (coordination_of(machine).plans_whole) {
        return [](std::size_t width) { return std::make_unique<MemoryRows>(width, kMaxProgramBlocks); };
    }
    const std::filesystem::path directory = values_file(machine.name).parent_path();
    const std::uint64_t limit_bytes = static_cast<std::uint64_t>(limit_mb) * kBytesPerMB;
    return [directory, limit_bytes](std::size_t width) {
        return std::make_unique<FileRows>(width, directory, limit_bytes);
    };
}

int run(const CoordinatorServiceOptions& options, const MachineSetup& machine, RevisedValues values) {
    StopSignal stop;
    const EndGuard guard(stop);
    for (const std::string& line : ask_for_real_time(machine.real_time)) { log_info(line); }
    const Member member = options.second ? standby_member() : coordinator_member();
    const auto admission = admit_service(machine, member);
    if (!admission) { return end_with_failure(admission.error()); }
    auto network =
        CoordinatorNetwork::open({machine, MachineClock(machine.tick_ns, machine.timing.time_source), *admission});
    if (!network) { return end_with_failure(network.error()); }
    const auto identity = static_cast<Identity>(MachineClock(machine.tick_ns, machine.timing.time_source).now().value);
    CoordinatorService service(machine, identity, std::move(*network), std::move(values),
                               open_record(machine, "", options.record),
                               options.standby ? std::optional(options.on_takeover) : std::nullopt,
                               rows_of(machine, options.program_limit_mb));
    log_info("coordinator of machine " + machine.name + " is up");

    ServiceManager manager;
    manager.ready("coordinator of machine " + machine.name);
    PeriodicLoop periodic(loop_period(machine));
    bool alone = true;
    std::optional<LoopWatchdog> watchdog([&] { service.end_as_stuck(); });
    periodic.run(stop, [&](nanoseconds begun) {
        watchdog->note_loop();
        manager.alive(begun);
        alone = alone && service.loop();
        if (!alone) { stop.request(); }
    });
    watchdog.reset();
    manager.stopping();
    service.finish();
    log_info("ends; {} loops skipped, the latest {} us late", periodic.skipped_periods(),
             periodic.worst_lateness().count() / 1000);
    if (alone) { return kServiceDone; }
    log_event(spdlog::level::err, FaultCode::SecondCoordinator,
              "another coordinator runs machine " + machine.name + "; stop one of them");
    return kServiceFailed;
}

}  // namespace

int serve_coordinator(const CoordinatorServiceOptions& options) {
    const auto loaded = load_machine(options.machine_file);
    if (!loaded) { return end_with_bad_input(to_text(options.machine_file.string(), loaded.error())); }
    const MachineSetup& machine = loaded->config;
    if (options.standby && machine.timing.time_source == TimeSource::Network) {
        return end_with_bad_input(
            "--standby: the machine's time_source is NETWORK, so its time is the coordinator's own clock, and "
            "the clock of another host cannot continue it; use SHARED (one host) or PTP");
    }
    if (options.on_takeover == OnTakeover::Continue && !coordination_of(machine).tells_places) {
        return end_with_bad_input(
            "--on-takeover continue: coordination LAI plans a block in parts, and another "
            "coordinator cannot distinguish them; use stop, or coordination: RANADE");
    }
    if (auto log = open_log({"coordinator", "", options.log_file, true}); !log) {
        return end_with_bad_input(log.error());
    }
    if (!loaded->settings.empty()) { log_info(settings_notice(loaded->settings)); }
    auto values = read_values(values_file(machine.name));
    if (!values) {
        log_error(
            values_file_trouble(machine.name).value_or("the file of offsets and tools changed while it was read"));
        return kServiceBadInput;
    }
    return run(options, machine, *std::move(values));
}

}  // namespace lockstep
