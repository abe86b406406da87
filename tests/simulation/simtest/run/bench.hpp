// A machine in virtual time with everything that watches it, and the ways to command it and to wait.
#pragma once

#include <functional>
#include <string>

#include "tests/simulation/simtest/record/claims.hpp"
#include "tests/simulation/simtest/run/fault_placer.hpp"
#include "tests/simulation/simtest/run/play.hpp"
#include "tests/simulation/simtest/run/watch.hpp"

namespace lockstep::simtest {

class Bench {
public:
    Bench(const Scenario& scenario, Played& played);

    /// The run cannot go on: what is wrong has been noted.
    bool over() const { return over_; }
    /// Notes it; the run is over.
    void object(const std::string& rule, const std::string& text);

    /// The machine is in a Fault that what has gone wrong in the run explains.
    bool faulted() const { return watch_.phase() == MachinePhase::Fault; }
    /// Messages are altered, or a fault of a process or link has begun since: answers need not be those of a machine
    /// left alone.
    bool disturbed_since(Tick tick) const {
        return scenario_.network.corrupted > 0 || (watch_.disturbed() && *watch_.disturbed() >= tick);
    }

    /// Goes on until `done` holds, or the machine is in Fault, which may be objected to. After the deadline: an
    /// objection, too.
    bool await(const std::function<bool()>& done, double seconds, const std::string& what);
    void wait(double seconds);
    /// Waits for so many slots to pass.
    void wait_slots(double slots) { wait(slots * slot_s()); }

    /// Commands and waits for the answer, repeating itself where messages may be lost. Null: the run is over.
    const Reply* ask(CommandKind kind, std::uint64_t program = 0);
    /// The same, but a refusal because of uncertain clocks is obeyed first: it tells the client to wait and ask again.
    const Reply* ask_in_time(CommandKind kind, std::uint64_t program = 0);
    const Reply* turn(const Overrides& overrides);
    /// The faults that the next job meets.
    void plan(const std::vector<PlannedFault>& faults) { placer_.plan(faults); }
    /// No further fault begins. Goes on until none is left and every axis has rested for long enough to rest for good.
    void settle(double seconds);
    std::uint64_t send_program(Program program);

    bool asks_in_fault() const { return scenario_.asks_in_fault; }
    const Watch& watch() const { return watch_; }
    const MachineConfig& machine() const { return scenario_.machine; }
    /// The highest that its feeds are turned to, in any job: they hold on.
    double most_feed() const;
    Recording& recording() { return played_.recording; }
    VirtualMachine& vm() { return vm_; }
    bool lossy() const { return scenario_.lossy(); }
    double slot_s() const { return static_cast<double>(machine().timing.slot_us) * 1e-6; }
    std::vector<std::size_t> steps_made() const;

private:
    const Reply* await_reply(std::uint64_t sequence);
    void reset_early();
    static constexpr double kAnswerSlots = 12;  // two hops each way, and a loop of whoever is asked

    /// Whoever has taken over may have heard a command while it stood by, and answers it when it comes again. Nobody
    /// answers before one owns the machine.
    bool may_lose() const {
        const bool taken_over = scenario_.coordinators > 1 && watch_.disturbed();
        return lossy() || vm_.faults_pending() || taken_over || !vm_.owner();
    }

    const Scenario& scenario_;
    Played& played_;
    VirtualMachine vm_;
    Recorder recorder_;
    Watch watch_;
    FaultPlacer placer_;
    ClaimCheck claims_;
    CoverageWatch coverage_;
    double outage_s_;  // of all planned faults together, and as long again until everyone is heard
    std::uint64_t programs_ = 0;
    bool over_ = false;
};

}  // namespace lockstep::simtest
