// The content of one run, all drawn from one seed: a machine, its network, its programs, and its commands.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "core/coordinator/state/coordinator_io.hpp"
#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"
#include "services/virtual/late_link.hpp"
#include "services/virtual/virtual_clock.hpp"
#include "services/virtual/virtual_fault.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep::simtest {

/// The faults that a run may have, of messages, processes and links.
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
    bool mixed = false;  // each kind is in half of the runs only
    bool override = false;
    bool standby = false;  // a second coordinator, and faults in takeovers
    bool limit = false;    // switches, slides, and the content of a device
    bool device = false;   // devices die, stop for a while, are overwritten
    bool stream = false;   // no fault: programs are sent while they run
    bool curve = false;    // no fault: programs have arcs, path modes and events

    bool breaks_processes() const {
        return freeze || crash || partition || stall || clock || standby || limit || device;
    }
    static constexpr FaultKinds all();
};

struct NamedKind {
    const char* name;
    bool FaultKinds::*kind;
};
inline constexpr std::array kFaultKinds{
    NamedKind{"delay", &FaultKinds::delay},         NamedKind{"reorder", &FaultKinds::reorder},
    NamedKind{"duplicate", &FaultKinds::duplicate}, NamedKind{"loss", &FaultKinds::loss},
    NamedKind{"freeze", &FaultKinds::freeze},       NamedKind{"crash", &FaultKinds::crash},
    NamedKind{"partition", &FaultKinds::partition}, NamedKind{"corrupt", &FaultKinds::corrupt},
    NamedKind{"stall", &FaultKinds::stall},         NamedKind{"clock", &FaultKinds::clock},
    NamedKind{"mixed", &FaultKinds::mixed},         NamedKind{"override", &FaultKinds::override},
    NamedKind{"standby", &FaultKinds::standby},     NamedKind{"limit", &FaultKinds::limit},
    NamedKind{"device", &FaultKinds::device},       NamedKind{"stream", &FaultKinds::stream},
    NamedKind{"curve", &FaultKinds::curve}};
static_assert(sizeof(FaultKinds) == kFaultKinds.size() * sizeof(bool), "each kind has a name");

constexpr FaultKinds FaultKinds::all() {
    FaultKinds all;
    for (const NamedKind& named : kFaultKinds) { all.*named.kind = true; }
    return all;
}

/// The kind of machines that are drawn.
struct MachineKind {
    std::optional<std::size_t> axes;  // not given: 1 to 6
    bool long_searches = false;       // draw_machine.hpp
    bool late_devices = false;        // some devices answer late and have their own clocks
    bool motors = false;              // axes have several motors, or share them (draw_motors.hpp)
    bool deltas = false;              // draw_delta.hpp
    bool screws = false;              // motors correct errors of screws (draw_screws.hpp); not of deltas
    bool backlash = false;            // motors have a play (draw_backlash.hpp); not with screws or deltas
    bool touches = false;             // axes home by inputs (draw_touches.hpp); not of deltas
    bool encoders = false;            // lost steps are made up (draw_encoders.hpp); not with backlash
    bool jogs = false;                // axes are jogged between programs (draw_jogs.hpp)
    bool inputs = false;              // with an emergency stop and a door (draw_inputs.hpp)
    bool probes = false;              // programs probe (draw_probes.hpp)
    bool close_probes = false;        // at the device of the motor that moves (draw_close_probes.hpp)
    bool outputs = false;             // programs switch outputs (draw_outputs.hpp)
    bool boards = false;              // with a device without a motor
    bool bounces = false;             // contacts of inputs bounce (draw_bounces.hpp)
    bool small_rings = false;         // devices have small rings (draw_rings.hpp)

    /// How a command line asks for it.
    struct Flag {
        const char* name;
        bool MachineKind::*kind;
        const char* help;
    };
};

inline constexpr auto kMachineFlags = std::to_array<MachineKind::Flag>(
    {{"--long-searches", &MachineKind::long_searches,
      "include machines that search their switches for minutes: about twice the time"},
     {"--late-devices", &MachineKind::late_devices,
      "about half of the devices answer after up to 5 ms and have their own clocks, in machines with slots of 2 ms or "
      "more"},
     {"--motors", &MachineKind::motors,
      "machines with several motors on an axis, belts that move two axes, gears or skewed guides"},
     {"--deltas", &MachineKind::deltas, "machines whose first three axes are those of a delta"},
     {"--screws", &MachineKind::screws, "machines whose motors correct errors of their screws"},
     {"--backlash", &MachineKind::backlash, "machines whose motors have backlash, which they take up where they turn"},
     {"--encoders", &MachineKind::encoders,
      "machines whose motors make up lost steps at rest: slides are pushed, in jobs and between them"},
     {"--touches", &MachineKind::touches, "machines with axes that home by the touch of an input, at any device"},
     {"--inputs", &MachineKind::inputs, "machines with an emergency stop and a door at inputs of devices"},
     {"--probes", &MachineKind::probes,
      "machines with a probe at a device, which touches at any time of probing moves"},
     {"--close-probes", &MachineKind::close_probes,
      "with --probes: the probe is at the device of the motor that probes, whose pulses cease at the touch"},
     {"--outputs", &MachineKind::outputs,
      "machines with outputs that programs switch, one of them in proportion to the speed"},
     {"--boards", &MachineKind::boards,
      "machines with a board: a device without a motor, for some of the outputs and inputs"},
     {"--bounces", &MachineKind::bounces, "with --inputs or --probes: their contacts bounce"},
     {"--jogs", &MachineKind::jogs, "axes are also jogged, between programs"},
     {"--small-rings", &MachineKind::small_rings, "machines of devices with small rings, of different sizes"}});

/// A command that the machine must refuse, and the reason. The machine must continue as if it had not been given.
struct WrongCommand {
    CommandKind kind = CommandKind::Resume;
    std::optional<Program> program;  // for Run; none: a program that was never sent
    FaultCode refusal = FaultCode::NothingToDo;
};

using FaultKind = VirtualFault::Kind;

/// A fault of a process or a link, placed by the current action of the protocol.
struct PlannedFault {
    /// An edge of a frame of the job (in homing: of its beginning). Or an edge after the previous planned fault:
    /// that fault itself, a coordinator's claim, the first and the last axis that follows it, all axes at rest.
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
    /// The victim: the process that the fault names, the coordinator that owns the machine then, or the other one.
    enum class Victim : std::uint8_t { Process, Owner, Other };
    VirtualFault fault;  // `at` is set at the edge
    int epoch = 0;       // in the job, counted from 0
    FrameNumber frame = 1;
    Edge edge = Edge::Start;
    double slots = 0;  // after the edge
    Victim victim = Victim::Process;
    bool at_jog = false;  // an edge of a frame: but placed after the begin of a jog, which may have no frames

    bool is_of_frame() const { return static_cast<std::size_t>(edge) < kFrameEdges; }
};

/// A hand pushes a motor's slide by less than the machine bears.
struct Slip {
    std::size_t motor = 0;
    std::int64_t steps = 0;
};

/// An interruption of a job in motion.
struct Interrupt {
    enum class Kind : std::uint8_t {
        HoldAndResume,
        HoldAndStop,
        Stop,
        EmergencyStop,
        WrongCommand,
        Override,
        StopInput,  // a person presses the emergency stop at a device, tries a reset, and releases it
        Door,       // a door opens, and closes after the hold
        Touch,      // the probe touches, by one of its inputs or by two, until the job ends
        Slip        // a hand pushes a slide
    };
    Kind kind = Kind::HoldAndResume;
    double after_s = 0;  // after the motion began or continued
    double rest_s = 0;   // duration of the hold
    WrongCommand wrong;
    Overrides overrides;
    std::size_t touched = 0;             // Touch: the input that touches first, of those of the probe
    std::optional<double> next_after_s;  // Touch: another one touches so much later
    simtest::Slip slip;
};

/// A number of blocks of a program, sent `after_s` after the previous part was taken.
struct SentPart {
    std::size_t blocks = 0;
    double after_s = 0;
};

/// The keys that a client holds, and how it ends.
struct JogPress {
    enum class End : std::uint8_t {
        Release,
        Silence,  // the client ends: its renewals cease
        Next      // it presses the next keys while the axes move
    };
    std::vector<JogAxis> axes;
    double held_s = 0;
    End end = End::Release;
};

/// Keys that a client presses one after the other, on a machine at rest. The last press ends with Release or Silence.
struct JogSession {
    std::vector<JogPress> presses;
    std::vector<PlannedFault> faults;
};

/// A program that starts at the machine's current position, and the events during the job.
struct Task {
    Program program;  // start_mm is set when the program is sent
    std::vector<WrongCommand> before;
    std::vector<Interrupt> interrupts;
    std::vector<PlannedFault> faults;   // in the order in which they are placed
    std::vector<SentPart> parts = {};   // empty: the program is sent whole, before it runs
    std::vector<JogSession> jogs = {};  // before the program
    std::vector<Slip> slips = {};       // at rest, before the program
};

/// Stop or EmergencyStop, `after_s` after the homing began.
struct HomingStop {
    CommandKind kind = CommandKind::EmergencyStop;
    double after_s = 0;
};

struct Scenario {
    std::uint64_t seed = 0;
    MachineConfig machine;
    NetworkBehaviour network;
    Tick power_up{1'000'000};
    std::vector<AxisClocks> clocks;        // empty: one clock for all
    std::vector<LinkDelay> links;          // empty: every axis uses its device's registers
    std::vector<DeviceAbilities> devices;  // empty: simulated ones as usual
    std::size_t coordinators = 1;
    OnTakeover on_takeover = OnTakeover::Stop;
    std::vector<WrongCommand> before_homing;
    std::optional<HomingStop> homing_stop;
    bool asks_in_fault = false;  // requests a homing in Fault, which must be refused
    bool resets_early = false;   // resets while a fault may still last
    std::vector<PlannedFault> homing_faults;
    std::vector<Task> tasks;

    /// The time until this axis's device answers, at most; 0 without a link.
    Ticks lateness(std::size_t axis) const { return axis < links.size() ? links[axis].most : Ticks{}; }
    /// Messages may be lost or damaged.
    bool lossy() const { return network.lost > 0 || network.corrupted > 0; }
};

/// kind.axes: the number of axes; if it is absent, the number is drawn too.
Scenario draw_scenario(std::uint64_t seed, const FaultKinds& faults, const MachineKind& kind);

}  // namespace lockstep::simtest
