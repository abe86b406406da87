#include <fmt/format.h>

#include <algorithm>

#include "core/coordinator/path/coordination.hpp"
#include "core/kinematics/motors.hpp"
#include "services/documents/machine_rules.hpp"
#include "services/documents/names.hpp"
#include "services/documents/problem_list.hpp"

namespace lockstep {
namespace {

/// Whether an axis, a motor, or a board before number `board` has the name.
bool is_taken(const MachineConfig& machine, std::size_t board, const std::string& name) {
    std::vector<std::string> names = motor_names(machine);
    names.resize(moving_motor_count(machine) + board);
    for (const AxisConfig& axis : machine.axes) { names.push_back(axis.name); }
    return std::ranges::any_of(names, [&](const std::string& other) { return same_name(other, name); });
}

bool is_used(const MachineConfig& machine, const std::string& board) {
    const auto is_at_it = [&](const auto& channel) { return channel.at_board && channel.motor == board; };
    return std::ranges::any_of(machine.outputs, is_at_it) || std::ranges::any_of(machine.inputs, is_at_it);
}

void check(const MachineConfig& machine, std::size_t number, ProblemList& problems) {
    const BoardConfig& board = machine.boards[number];
    const std::string at = fmt::format("board[{}].", number);
    problems.require(is_axis_name(board.name), at + "name",
                     fmt::format("the board's name is \"{}\"; it must be a letter, then letters, digits and _, at most "
                                 "{} characters",
                                 board.name, kMaxAxisName));
    problems.require(
        !is_taken(machine, number, board.name), at + "name",
        fmt::format("{} names an axis, a motor or another board already; give this board another name", board.name));
    problems.require(
        board.host.empty() || is_host_name(board.host), at + "host",
        fmt::format("{}host is \"{}\"; it must be the name of a host: letters, digits, - and .", at, board.host));
    problems.require(
        machine.timing.time_source != TimeSource::Ptp || !board.device.has_own_clock(), at + "device",
        fmt::format("device {} of board {} has a clock of its own, for whose error timing.time_source: PTP "
                    "leaves no room; set NETWORK",
                    board.device.text(), board.name));
    problems.require(is_used(machine, board.name), at + "name",
                     fmt::format("board {0} has no output and no input; write board: \"{0}\" in the blocks of those "
                                 "that it has, or remove the board",
                                 board.name));
}

}  // namespace

std::vector<Problem> board_problems(const MachineConfig& machine) {
    ProblemList problems;
    const std::size_t motors = motor_count(machine);
    problems.require(motors <= kMaxAxes, "board",
                     fmt::format("the machine has {} motors and boards together; it can have {}", motors, kMaxAxes));
    problems.require(machine.boards.empty() || coordination_of(machine).moves_boards, "coordination",
                     "coordination is LAI, which has no frames for boards; set RANADE");
    for (std::size_t k = 0; k < machine.boards.size(); ++k) { check(machine, k, problems); }
    return problems.take();
}

}  // namespace lockstep
