// What one run does, all of it drawn from one seed: a machine, its network, programs, and what is commanded when.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/coordinator/state/coordinator_io.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"
#include "services/virtual/virtual_clock.hpp"
#include "services/virtual/virtual_fault.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep::simtest {

/// What may go wrong in a run: with messages, with processes, with links.
struct FaultKinds {
    bool delay = false;
    bool reorder = false;
    bool duplicate = false;
    bool loss = false;
    bool freeze = false;
    bool crash = false;
    bool partition = false;
    bool corrupt = false;
    bool stall = false;
    bool clock = false;
    bool mixed = false;  // each kind is there in half of the runs only
    bool override = false;
    bool standby = false;  // a second coordinator, and faults about takeovers
    bool limit = false;    // switches, slides, and what a device holds
    bool device = false;   // devices die, stop for a while, are overwritten

    bool breaks_processes() const {
        return freeze || crash || partition || stall || clock || standby || limit || device;
    }
    static constexpr FaultKinds all() {
        return {true, true, true, true, true, true, true, true, true, true, true, true, true, true, true};
    }
};

/// Which machines are drawn.
struct MachineKind {
    std::optional<std::size_t> axes;  // 1 to 6 if not given
    bool long_searches = false;       // draw_machine.hpp
};

/// A command that must be refused, and why; the machine goes on as if it had not been given.
struct WrongCommand {
    CommandKind kind = CommandKind::Resume;
    std::optional<Program> program;  // Run: this one; none: one that was never sent
    FaultCode refusal = FaultCode::NothingToDo;
};

/// A fault of a process or a link, placed by what the protocol is doing then.
struct PlannedFault {
    /// Of a frame of the job (in homing: of its beginning, whichever); or of what follows the planned fault before:
    /// itself, a coordinator's claim, the first and the last axis to follow it, all axes at rest.
    enum class Edge : std::uint8_t {
        FirstSend,
        Evidence,
        Check,
        LastCheck,
        Start,
        Before,
        Claim,
        FirstFollows,
        LastFollows,
        Rest
    };
    static constexpr std::size_t kFrameEdges = 5;
    /// Whom it meets: the process that the fault names, or the coordinator that owns the machine then, or the other.
    enum class Victim : std::uint8_t { Process, Owner, Other };
    VirtualFault fault;  // `at` is filled in when the edge comes
    int epoch = 0;       // of the job, counted from 0
    FrameNumber frame = 1;
    Edge edge = Edge::Start;
    double slots = 0;  // after the edge
    Victim victim = Victim::Process;

    bool is_of_frame() const { return static_cast<std::size_t>(edge) < kFrameEdges; }
};

/// What happens while a job is in motion.
struct Interrupt {
    enum class Kind : std::uint8_t { HoldAndResume, HoldAndStop, Stop, EmergencyStop, WrongCommand, Override };
    Kind kind = Kind::HoldAndResume;
    double after_s = 0;  // since the motion began or went on
    double rest_s = 0;   // how long it is held
    WrongCommand wrong;
    Overrides overrides;
};

/// A program, to be run from wherever the machine then stands, and what comes in between.
struct Task {
    Program program;  // start_mm is filled in when it is given
    std::vector<WrongCommand> before;
    std::vector<Interrupt> interrupts;
    std::vector<PlannedFault> faults;  // in the order in which they are placed
};

struct Scenario {
    std::uint64_t seed = 0;
    MachineConfig machine;
    NetworkBehaviour network;
    Tick power_up{1'000'000};
    std::vector<AxisClocks> clocks;  // none: one clock for all
    std::size_t coordinators = 1;
    OnTakeover on_takeover = OnTakeover::Stop;
    std::vector<WrongCommand> before_homing;
    std::optional<double> homing_emergency_s;  // an emergency stop, so long after the homing began
    bool asks_in_fault = false;                // for a homing, which must then be refused
    bool resets_early = false;                 // while a fault may still last
    std::vector<PlannedFault> homing_faults;
    std::vector<Task> tasks;

    /// Messages may be lost, one way or another.
    bool lossy() const { return network.lost > 0 || network.corrupted > 0; }
};

/// axes: how many; none: drawn too.
Scenario draw_scenario(std::uint64_t seed, const FaultKinds& faults, const MachineKind& kind);

}  // namespace lockstep::simtest
