#include "clients/lockstep/live/boards_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>

#include "clients/lockstep/live/board_look.hpp"
#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "services/axis/device_driver.hpp"
#include "services/board/line_failure.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

constexpr const char* kByName = "serial/by-id";

/// The motor of the machine that uses this device of the board; nullptr if none does.
const MotorConfig* user_of(const std::vector<MotorConfig>& motors, const std::string& board, std::size_t number) {
    const auto found = std::ranges::find_if(motors, [&](const MotorConfig& motor) {
        return motor.device.is_of_board(board) && motor.device.number == number;
    });
    return found == motors.end() ? nullptr : &*found;
}

void describe(const DeviceAbilities& abilities, std::int64_t tick_ns, proto::BoardMotorReport& report) {
    report.set_steps_per_s(1e9 / static_cast<double>(abilities.least_step.value * tick_ns));
    report.set_pieces(abilities.segment_entries);
    report.set_steps(abilities.capture_entries);
    report.set_inputs(abilities.inputs);
    report.set_digital_outputs(abilities.digital_outputs);
    report.set_analog_outputs(abilities.analog_outputs);
}

void describe(const RegisterWindow& window, const MachineSetup& machine, const MotorConfig* user,
              proto::BoardMotorReport& report) {
    const auto driver = DeviceDriver::attach(window, machine.tick_ns);
    if (!driver) { return report.set_lack(driver.error()); }
    describe(driver->abilities(), machine.tick_ns, report);
    if (user == nullptr) { return; }
    if (const auto lack = lack_of(driver->abilities(), machine, *user)) { report.set_lack(*lack); }
}

std::string motor_line(const proto::BoardMotorReport& motor) {
    const std::string user = motor.has_motor() ? motor.motor() : "unused";
    std::string line = fmt::format("  {} {:<8} ", motor.number(), user);
    if (motor.has_lack()) { return line + "BAD  " + motor.lack(); }
    return line +
           fmt::format("ok   {:.0f} steps/s; holds {} pieces and {} steps; {} inputs, {} digital and {} analog outputs",
                       motor.steps_per_s(), motor.pieces(), motor.steps(), motor.inputs(), motor.digital_outputs(),
                       motor.analog_outputs());
}

std::string figures_line(const proto::LinkFiguresReport& figures) {
    const double rate = static_cast<double>(figures.answers()) / figures.seconds();
    return fmt::format("  {:.0f} answers a second; each takes {:.2f} ms, at least {:.2f}, at most {:.2f}", rate,
                       figures.mean_ms(), figures.least_ms(), figures.most_ms());
}

}  // namespace

std::expected<std::vector<BoardLinkConfig>, Failure> boards_of(const MachineSetup& machine, const std::string& name) {
    std::vector<BoardLinkConfig> boards = machine.board_links;
    std::erase_if(boards, [&](const BoardLinkConfig& board) { return !name.empty() && board.name != name; });
    if (!boards.empty()) { return boards; }
    if (machine.board_links.empty()) {
        return std::unexpected(
            bad_input("machine '" + machine.name +
                      "' has no board with a link; docs/pico.md and docs/fpga.md tell how to add one"));
    }
    std::vector<std::string> names;
    for (const BoardLinkConfig& board : machine.board_links) { names.push_back(board.name); }
    return std::unexpected(bad_input(fmt::format("machine '{}' has no board '{}' with a link; it has {}", machine.name,
                                                 name, fmt::join(names, ", "))));
}

proto::BoardReport board_report(const MachineSetup& machine, const BoardLinkConfig& board) {
    proto::BoardReport report;
    report.set_name(board.name);
    report.set_link(board.link.text());
    for (const MotorConfig& motor : motors_of(machine)) {
        if (motor.device.is_of_board(board.name)) { report.add_used_by(motor.name); }
    }
    return report;
}

namespace {

void add_motors(const MachineSetup& machine, const std::vector<RegisterWindow>& shown, proto::BoardReport& report) {
    const std::vector<MotorConfig> motors = motors_of(machine);
    std::size_t needed = shown.size();
    for (const MotorConfig& motor : motors) {
        if (motor.device.is_of_board(report.name())) {
            needed = std::max<std::size_t>(needed, motor.device.number + 1);
        }
    }
    for (std::size_t n = 0; n < needed; ++n) {
        const MotorConfig* const user = user_of(motors, report.name(), n);
        if (user == nullptr && n >= shown.size()) { continue; }
        proto::BoardMotorReport& motor = *report.add_motors();
        motor.set_number(static_cast<std::uint32_t>(n));
        if (user != nullptr) { motor.set_motor(user->name); }
        if (n < shown.size()) {
            describe(shown[n], machine, user, motor);
        } else {
            motor.set_lack(fmt::format("the board has {} motors; use one of them in \"device\"", shown.size()));
        }
    }
}

/// `use`: adds to the report what a board that answers shows.
template <typename Use>
proto::BoardReport report_of_answer(const MachineSetup& machine, const BoardLinkConfig& board, Use use) {
    proto::BoardReport report = board_report(machine, board);
    BoardLook look(machine, board);
    report.set_is_held(look.is_held());
    if (const auto lack = look.await(BoardLook::kPatience)) {
        report.set_lack(*lack);
    } else {
        use(look, report);
    }
    return report;
}

}  // namespace

proto::BoardReport check_board(const MachineSetup& machine, const BoardLinkConfig& board) {
    return report_of_answer(machine, board, [&](const BoardLook& look, proto::BoardReport& report) {
        add_motors(machine, look.motors(), report);
    });
}

proto::BoardReport measure_board(const MachineSetup& machine, const BoardLinkConfig& board,
                                 std::chrono::duration<double> time) {
    return report_of_answer(machine, board, [&](BoardLook& look, proto::BoardReport& report) {
        *report.mutable_figures() = look.measure(time);
    });
}

proto::BoardReport identify_board(const MachineSetup& machine, const BoardLinkConfig& board) {
    if (board.link.kind == LinkName::Kind::Spi) {
        proto::BoardReport report = board_report(machine, board);
        report.set_lack("an FPGA behind an SPI has no light to flash; follow its wires from " + board.link.place);
        return report;
    }
    return report_of_answer(machine, board, [](BoardLook& look, proto::BoardReport& /*report*/) { look.identify(); });
}

std::string why_not_opened(const BoardLinkConfig& board) {
    const LinkName& link = board.link;
    if (link.kind == LinkName::Kind::Tcp || ::access(link.place.c_str(), R_OK | W_OK) == 0) { return ""; }
    return line_not_opened(link.kind, link.place, errno).error();
}

namespace {

/// The file behind a name, of which a line may have several.
fs::path file_behind(const fs::path& name) {
    std::error_code none;
    const fs::path line = fs::canonical(name, none);
    return none ? name : line;
}

bool is_of_usb(const std::string& name) { return name.starts_with("ttyACM") || name.starts_with("ttyUSB"); }

/// The serial lines by their lasting names, and those of USB that have none, as in a container.
std::vector<fs::path> serial_lines(const fs::path& devices) {
    std::vector<fs::path> lines;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(devices / kByName, none)) { lines.push_back(entry); }
    const auto is_listed = [&](const fs::path& line) {
        return std::ranges::find(lines, line, file_behind) != lines.end();
    };
    for (const fs::directory_entry& entry : fs::directory_iterator(devices, none)) {
        const bool is_line = is_of_usb(entry.path().filename());
        if (is_line && !is_listed(file_behind(entry))) { lines.push_back(entry); }
    }
    std::ranges::sort(lines);
    return lines;
}

}  // namespace

std::vector<std::string> free_adapters(const MachineSetup& machine, const fs::path& devices) {
    std::vector<std::string> adapters;
    for (const fs::path& line : serial_lines(devices)) {
        const auto is_named = [&](const BoardLinkConfig& board) {
            const LinkName& link = board.link;
            return link.kind == LinkName::Kind::Serial && file_behind(link.place) == file_behind(line);
        };
        if (std::ranges::none_of(machine.board_links, is_named)) { adapters.push_back("serial:" + line.string()); }
    }
    return adapters;
}

bool is_well(const proto::BoardReport& report) {
    const auto suits = [](const proto::BoardMotorReport& motor) { return !motor.has_lack(); };
    const bool is_silent = report.has_figures() && report.figures().answers() == 0;
    return !report.has_lack() && !is_silent && std::ranges::all_of(report.motors(), suits);
}

std::vector<std::string> board_lines(const proto::BoardReport& report) {
    const std::string users =
        report.used_by().empty() ? "no motor" : fmt::format("{}", fmt::join(report.used_by(), ", "));
    std::vector<std::string> lines{fmt::format("{}  {}  for {}{}", report.name(), report.link(), users,
                                               report.is_held() ? ", held by lockstep-board" : "")};
    if (report.has_lack()) { lines.push_back("  BAD  " + report.lack()); }
    for (const proto::BoardMotorReport& motor : report.motors()) { lines.push_back(motor_line(motor)); }
    if (report.has_figures()) { lines.push_back(figures_line(report.figures())); }
    return lines;
}

}  // namespace lockstep
