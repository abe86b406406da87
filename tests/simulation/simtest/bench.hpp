// A machine in virtual time with everything that watches it, and the ways to command it and to wait.
#pragma once

#include <functional>
#include <string>

#include "tests/simulation/simtest/play.hpp"
#include "tests/simulation/simtest/watch.hpp"

namespace lockstep::simtest {

class Bench {
public:
    Bench(const Scenario& scenario, Played& played);

    /// The run cannot go on: what is wrong has been noted, or a lossy network has led to Fault.
    bool over() const { return over_; }
    /// Notes it; the run is over.
    void object(const std::string& rule, const std::string& text);

    /// Goes on until `done` holds. After the deadline: an objection.
    bool await(const std::function<bool()>& done, double seconds, const std::string& what);
    void wait(double seconds);
    /// Waits for so many slots to pass.
    void wait_slots(double slots) { wait(slots * slot_s()); }

    /// Commands and waits for the answer, repeating itself where the network loses messages. Null: the run is over.
    const Reply* ask(CommandKind kind, std::uint64_t program = 0);
    std::uint64_t send_program(Program program);

    const Watch& watch() const { return watch_; }
    const MachineConfig& machine() const { return scenario_.machine; }
    Recording& recording() { return played_.recording; }
    VirtualMachine& vm() { return vm_; }
    bool lossy() const { return scenario_.lossy; }
    double slot_s() const { return static_cast<double>(machine().timing.slot_us) * 1e-6; }
    std::vector<std::size_t> steps_made() const;

private:
    static constexpr double kAnswerSlots = 12;  // two hops each way, and a loop of whoever is asked

    const Scenario& scenario_;
    Played& played_;
    VirtualMachine vm_;
    Recorder recorder_;
    Watch watch_;
    std::uint64_t programs_ = 0;
    bool over_ = false;
};

}  // namespace lockstep::simtest
