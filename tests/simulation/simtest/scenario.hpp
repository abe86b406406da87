// What one run does, all of it drawn from one seed: a machine, its network, programs, and what is commanded when.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "core/faults.hpp"
#include "core/machine.hpp"
#include "core/program.hpp"
#include "core/protocol/messages.hpp"
#include "services/virtual/virtual_network.hpp"

namespace lockstep::simtest {

/// What the network does to messages.
struct NetworkFaults {
    bool delay = false;
    bool reorder = false;
    bool duplicate = false;
    bool loss = false;
};

/// A command that must be refused, and why; the machine goes on as if it had not been given.
struct WrongCommand {
    CommandKind kind = CommandKind::Resume;
    std::optional<Program> program;  // Run: this one; none: one that was never sent
    FaultCode refusal = FaultCode::NothingToDo;
};

/// What happens while a job is in motion.
struct Interrupt {
    enum class Kind : std::uint8_t { HoldAndResume, HoldAndStop, Stop, WrongCommand };
    Kind kind = Kind::HoldAndResume;
    double after_s = 0;  // since the motion began or went on
    double rest_s = 0;   // how long it is held
    WrongCommand wrong;
};

/// A program, to be run from wherever the machine then stands, and what comes in between.
struct Task {
    Program program;  // start_mm is filled in when it is given
    std::vector<WrongCommand> before;
    std::vector<Interrupt> interrupts;
};

struct Scenario {
    std::uint64_t seed = 0;
    MachineConfig machine;
    NetworkBehaviour network;
    bool lossy = false;
    std::vector<WrongCommand> before_homing;
    std::vector<Task> tasks;
};

/// axes: how many; none: drawn too.
Scenario draw_scenario(std::uint64_t seed, const NetworkFaults& faults, std::optional<std::size_t> axes);

}  // namespace lockstep::simtest
