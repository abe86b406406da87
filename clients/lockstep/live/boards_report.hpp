// What is known of a machine's boards behind links, and whether they suit its motors.
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <string>
#include <vector>

#include "clients/text/failure.hpp"
#include "idl/proto/report.pb.h"
#include "services/setup/machine_setup.hpp"

namespace lockstep {

/// The boards of the machine with this name; all if it is empty. Error: there is none.
std::expected<std::vector<BoardLinkConfig>, Failure> boards_of(const MachineSetup& machine, const std::string& name);

/// Its name, its link and the motors that use it.
proto::BoardReport board_report(const MachineSetup& machine, const BoardLinkConfig& board);

/// Waits until the board answers, for two seconds at most. Adds its devices, and those that a motor of the machine
/// needs and the board lacks.
proto::BoardReport check_board(const MachineSetup& machine, const BoardLinkConfig& board);
/// Waits likewise, and then watches the board's answers for so long.
proto::BoardReport measure_board(const MachineSetup& machine, const BoardLinkConfig& board,
                                 std::chrono::duration<double> time);
/// Waits likewise, and then lets the board's light blink.
proto::BoardReport identify_board(const MachineSetup& machine, const BoardLinkConfig& board);

/// Why this user cannot open the board's line; empty if it can, and for TCP.
std::string why_not_opened(const BoardLinkConfig& board);

/// The serial lines of this host that no board of the machine names: boards at USB, and adapters.
std::vector<std::string> free_adapters(const MachineSetup& machine, const std::filesystem::path& devices = "/dev");

/// Whether the board answers and suits all motors that use it, as far as the report says.
bool is_well(const proto::BoardReport& report);

/// The report as lines of text.
std::vector<std::string> board_lines(const proto::BoardReport& report);

}  // namespace lockstep
