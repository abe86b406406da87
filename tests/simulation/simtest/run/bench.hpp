// A machine in virtual time with all its observers, and functions to command it and to wait.
#pragma once

#include <functional>
#include <string>

#include "core/kinematics/kinematics.hpp"
#include "tests/simulation/simtest/record/claims.hpp"
#include "tests/simulation/simtest/record/motor_shares.hpp"
#include "tests/simulation/simtest/run/fault_placer.hpp"
#include "tests/simulation/simtest/run/play/play.hpp"
#include "tests/simulation/simtest/run/stream_sender.hpp"
#include "tests/simulation/simtest/run/watch.hpp"

namespace lockstep::simtest {

class Bench {
public:
    Bench(const Scenario& scenario, Played& played);

    /// True: the run cannot continue; a violation is recorded.
    bool over() const { return over_; }
    /// Records a violation; the run is over.
    void object(const std::string& rule, const std::string& text);

    /// The machine is in a Fault that the injected faults explain.
    bool faulted() const { return watch_.phase() == MachinePhase::Fault; }
    /// Messages are altered, or a fault of a process or link has begun since then: answers need not be those of
    /// an undisturbed machine.
    bool disturbed_since(Tick tick) const {
        return scenario_.network.corrupted > 0 || (watch_.disturbed() && *watch_.disturbed() >= tick);
    }

    /// Runs until `done` holds or the machine is in Fault, which can be a violation. A missed deadline is a
    /// violation too.
    bool await(const std::function<bool()>& done, double seconds, const std::string& what);
    void wait(double seconds);
    /// Waits for this number of slots.
    void wait_slots(double slots) { wait(slots * slot_s()); }

    /// Sends a command and waits for the answer; repeats it if messages may be lost. Null if the run is over.
    const Reply* ask(CommandKind kind, std::uint64_t program = 0);
    /// The same, but repeats a command that is refused because of uncertain clocks, as that refusal asks the client to.
    const Reply* ask_in_time(CommandKind kind, std::uint64_t program = 0);
    const Reply* set_overrides(const Overrides& overrides);
    /// The faults of the next job.
    void plan(const std::vector<PlannedFault>& faults) { placer_.plan(faults); }
    /// No further fault begins. Runs until no fault is left and every axis has rested long enough to stay at rest.
    void settle(double seconds);
    std::uint64_t send_program(Program program);
    /// Sends the program in parts from now on, until the next program is sent or until end_stream(). Returns when the
    /// first part is taken.
    std::uint64_t stream_program(Program program, const std::vector<SentPart>& parts);
    void end_stream() { stream_.reset(); }

    /// A person closes or opens an input of the machine, by its number in the machine's file.
    void set_input(std::size_t input, bool closed) { vm_.set_input(input, closed); }
    /// After this time, every process knows of a change of an input.
    double input_seconds(std::size_t input) const;
    void move_by_hand(std::size_t motor, std::int64_t steps);
    /// The steps by which a motor's slide was moved by hand.
    std::int64_t moved_by_hand(std::size_t motor) const { return by_hand_[motor]; }

    /// A hand pushes a slide by less than the machine bears.
    void slip(const Slip& slip);
    /// The steps by which a motor is ahead of its count, because of such pushes since its homing or its correction.
    std::int64_t slipped(std::size_t motor) const { return slipped_[motor]; }
    void forget_slips(std::size_t motor) { slipped_[motor] = 0; }

    bool asks_in_fault() const { return scenario_.asks_in_fault; }
    const Watch& watch() const { return watch_; }
    const MachineConfig& machine() const { return scenario_.machine; }
    const Kinematics& kinematics() const { return kinematics_; }
    const MotorShares& map() const { return map_; }
    const MotorSet& homed_by_touch() const { return claims_.by_touch(); }
    double homed_within(MotorIndex motor) const { return claims_.homed_within(motor); }
    /// Where the axes are, in steps of the axes.
    Counts axes_at(const Counts& motors) const;
    /// An upper bound of the time in which the protocol comes to rest and starts again, as often as it may have to.
    double protocol_seconds() const;
    /// The highest feed override of any job; overrides persist.
    double most_feed() const;
    Recording& recording() { return played_.recording; }
    VirtualMachine& vm() { return vm_; }
    bool lossy() const { return scenario_.lossy(); }
    bool has_standby() const { return scenario_.coordinators > 1; }
    double slot_s() const { return static_cast<double>(machine().timing.slot_us) * 1e-6; }
    std::vector<std::size_t> steps_made() const;

private:
    void advance();
    bool advance_until(const std::function<bool()>& done, Ticks limit);
    const Reply* await_reply(std::uint64_t sequence);
    void reset_early();
    static constexpr double kAnswerSlots = 12;  // two hops each way, and a loop of the process that answers

    /// A new owner may have received a command as the standby, and answers only when the command is repeated. No
    /// coordinator answers before it owns the machine.
    bool may_lose() const {
        const bool taken_over = scenario_.coordinators > 1 && watch_.disturbed();
        return lossy() || vm_.faults_pending() || taken_over || !vm_.owner();
    }

    const Scenario& scenario_;
    Kinematics kinematics_;
    MotorShares map_;
    Played& played_;
    VirtualMachine vm_;
    Recorder recorder_;
    Watch watch_;
    FaultPlacer placer_;
    ClaimCheck claims_;
    CoverageWatch coverage_;
    double outage_s_;  // of all planned faults, and the time after each until all peers are received
    std::uint64_t programs_ = 0;
    std::optional<StreamSender> stream_;
    std::vector<std::int64_t> by_hand_;  // steps, of each motor
    std::vector<std::int64_t> slipped_;
    bool over_ = false;
};

}  // namespace lockstep::simtest
