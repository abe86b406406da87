// lockstep board
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>

#include "clients/lockstep/live/board_boot.hpp"
#include "clients/lockstep/live/board_flash.hpp"
#include "clients/lockstep/live/boards_report.hpp"
#include "clients/lockstep/live_options.hpp"
#include "clients/lockstep/verb.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/text/output.hpp"

namespace lockstep {
namespace {

struct BoardOptions : LiveOptions {
    std::string board;  // empty: all
    double seconds = 3;
};

struct ReportOptions {
    bool with_adapters = false;
    const char* if_well = nullptr;  // a line behind a board that is well
};

/// `look`: makes the report of a board.
template <typename Look>
ExitCode report_boards(const BoardOptions& options, Look look, const ReportOptions& more = {}) {
    Output output(options.json);
    const auto machine = choose_machine(options.machine_file);
    if (!machine) { return output.fail(machine.error()); }
    const auto boards = boards_of(machine->config, options.board);
    if (!boards) { return output.fail(boards.error()); }
    proto::BoardsReport report;
    for (const BoardLinkConfig& board : *boards) {
        const proto::BoardReport& one = *report.add_boards() = look(machine->config, board);
        for (const std::string& line : board_lines(one)) { output.print(line); }
        if (more.if_well != nullptr && is_well(one)) { output.print(more.if_well); }
    }
    if (more.with_adapters) {
        for (const std::string& adapter : free_adapters(machine->config)) {
            report.add_free_adapters(adapter);
            output.print("no board of this machine: " + adapter);
        }
    }
    output.report(report);
    return std::ranges::all_of(report.boards(), is_well) ? kExitDone : kExitFailed;
}

ExitCode list(const BoardOptions& options) {
    const auto look = [](const MachineSetup& machine, const BoardLinkConfig& board) {
        proto::BoardReport report = board_report(machine, board);
        if (const std::string lack = why_not_opened(board); !lack.empty()) { report.set_lack(lack); }
        return report;
    };
    return report_boards(options, look, {.with_adapters = true});
}

ExitCode identify(const BoardOptions& options) {
    return report_boards(options, identify_board,
                         {.if_well = "  its light flashes four times a second, for ten seconds"});
}

ExitCode check(const BoardOptions& options) { return report_boards(options, check_board); }

ExitCode bench(const BoardOptions& options) {
    const std::chrono::duration<double> time{options.seconds};
    return report_boards(options, [time](const MachineSetup& machine, const BoardLinkConfig& board) {
        return measure_board(machine, board, time);
    });
}

struct FlashOptions {
    std::string file;
    std::string drive;
    std::string line;
    bool json = false;
};

std::string mounts() {
    std::ifstream file("/proc/self/mounts");
    return {std::istreambuf_iterator<char>(file), {}};
}

/// The drive to copy to: the one that is named or mounted, or that of a running board, which then restarts.
std::expected<std::filesystem::path, Failure> find_drive(const FlashOptions& options, Output& output) {
    constexpr std::chrono::seconds kPatience{20};
    if (!options.drive.empty()) { return options.drive; }
    const auto before = pico_drives(mounts());
    if (options.line.empty() && !before.empty()) { return only_drive(before); }
    const auto line = options.line.empty() ? only_line(lockstep_lines()) : std::filesystem::path(options.line);
    if (!line) { return line; }
    if (const auto asked = ask_for_boot_mode(*line); !asked) { return std::unexpected(asked.error()); }
    output.print(line->string() + ": the board restarts; waiting for its drive");
    const auto new_drives = [&] {
        auto drives = pico_drives(mounts());
        std::erase_if(drives, [&](const auto& drive) { return std::ranges::find(before, drive) != before.end(); });
        return drives;
    };
    return await_drive(*line, new_drives, kPatience);
}

ExitCode flash(const FlashOptions& options) {
    Output output(options.json);
    const std::filesystem::path file = options.file.empty() ? shipped_firmware() : std::filesystem::path(options.file);
    const auto firmware = read_firmware(file);
    if (!firmware) { return output.fail(firmware.error()); }
    const auto drive = find_drive(options, output);
    if (!drive) { return output.fail(drive.error()); }
    if (const auto done = write_firmware(*firmware, *drive); !done) { return output.fail(done.error()); }
    proto::FlashReport report;
    report.set_file(file.string());
    report.set_drive(drive->string());
    report.set_bytes(firmware->size());
    output.report(report);
    output.print(
        fmt::format("{} is on {}; the board starts it. Next: lockstep board check", file.string(), drive->string()));
    return kExitDone;
}

void add_flash(Verb boards) {
    const auto options = std::make_shared<FlashOptions>();
    const Verb verb =
        boards.add_verb("flash",
                        "copy the firmware to a Raspberry Pi Pico\n"
                        "A new Pico: hold its BOOTSEL button while you plug it in. It shows a drive, RPI-RP2.\n"
                        "A board that runs Lockstep's firmware is restarted, if its machine is down.");
    verb.add_option("file", options->file, "the firmware; default: the one that comes with Lockstep");
    verb.add_option("--drive", options->drive,
                    "the directory of the Pico's drive; default: the only one that is mounted");
    verb.add_option("--line", options->line,
                    "the serial line of the board that runs, such as /dev/ttyACM0; default: the only one");
    add_json(verb, options->json);
    verb.footer(footer("  lockstep board flash\n  lockstep board flash build-firmware/lockstep-board.uf2\n"));
    verb.action([options] { return flash(*options); });
}

using Action = ExitCode (*)(const BoardOptions&);

std::pair<Verb, std::shared_ptr<BoardOptions>> add_part(Verb boards, const std::string& name, const std::string& what,
                                                        Action action) {
    const auto options = std::make_shared<BoardOptions>();
    const Verb verb = boards.add_verb(name, what);
    add_live_options(verb, *options);
    verb.add_option("--board", options->board, "the board's name; default: all boards of the machine that have a link");
    verb.footer(footer("  lockstep board " + name + "\n  lockstep board " + name + " --board pico1\n"));
    verb.action([options, action] { return action(*options); });
    return {verb, options};
}

}  // namespace

void add_board(Verb command) {
    const Verb boards = command.add_verb("board",
                                         "look at boards behind links\n"
                                         "The machine may be up or down.");
    boards.footer(group_footer("  lockstep board check\n", "board check"));
    add_part(boards, "list", "list the machine's boards and the free serial lines, without a word to any of them",
             list);
    add_part(boards, "check", "check that each board answers, and that its devices suit the motors that use them",
             check);
    add_part(boards, "identify", "let the light of each board flash, to find it among others", identify);
    const auto [verb, options] = add_part(boards, "bench", "measure how long the answers of each board take", bench);
    verb.add_option("--seconds", options->seconds, "how long to measure").in_range(0.1, 3600.0).with_default();
    add_flash(boards);
}

}  // namespace lockstep
