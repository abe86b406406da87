#include "clients/lockstep/live/board_boot.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <string>
#include <thread>

#include "clients/lockstep/live/board_flash.hpp"
#include "services/board/serial_line.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

/// The kernel's names of these lines begin so, after the texts of the firmware (sim_fpga/firmware/usb/descriptors.cpp).
constexpr const char* kNames = "usb-Lockstep_Motor_board_";
constexpr const char* kDriveOfBoard = "disk/by-label/RPI-RP2";

}  // namespace

std::vector<fs::path> lockstep_lines(const fs::path& devices) {
    std::vector<fs::path> lines;
    std::error_code none;
    for (const fs::directory_entry& entry : fs::directory_iterator(devices / "serial/by-id", none)) {
        if (entry.path().filename().string().starts_with(kNames)) { lines.push_back(entry.path()); }
    }
    std::ranges::sort(lines);
    return lines;
}

std::expected<fs::path, Failure> only_line(const std::vector<fs::path>& lines) {
    if (lines.size() == 1) { return lines.front(); }
    if (lines.empty()) { return only_drive({}); }
    std::vector<std::string> names;
    for (const fs::path& line : lines) { names.push_back(line.string()); }
    return std::unexpected(
        bad_input(fmt::format("several boards are there; choose one with --line: {}", fmt::join(names, ", "))));
}

std::expected<void, Failure> ask_for_boot_mode(const fs::path& line) {
    if (const auto opened = open_serial_line(line, B1200); !opened) { return std::unexpected(failed(opened.error())); }
    return {};
}

std::expected<fs::path, Failure> await_drive(const fs::path& line, const std::function<std::vector<fs::path>()>& drives,
                                             std::chrono::milliseconds patience, const fs::path& devices) {
    constexpr std::chrono::milliseconds kPeriod{100};
    for (auto left = patience; left.count() > 0; left -= kPeriod) {
        if (const auto found = drives(); !found.empty()) { return only_drive(found); }
        std::this_thread::sleep_for(kPeriod);
    }
    const fs::path drive = devices / kDriveOfBoard;
    if (std::error_code none; fs::exists(drive, none)) {
        return std::unexpected(failed(fmt::format(
            "the board waits for its firmware, but its drive is not mounted; mount {} DIRECTORY, then lockstep board "
            "flash --drive DIRECTORY",
            drive.string())));
    }
    return std::unexpected(
        failed(fmt::format("{}: the board shows no drive within {} s; it keeps running while a motor is enabled: "
                           "lockstep down, then try again; or hold its BOOTSEL button while you plug it in",
                           line.string(), std::chrono::duration_cast<std::chrono::seconds>(patience).count())));
}

}  // namespace lockstep
