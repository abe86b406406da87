#include "services/axis/position_file.hpp"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/kinematics/motors.hpp"
#include "services/axis/position_document.hpp"
#include "services/files/directories.hpp"
#include "services/files/text_file.hpp"

namespace lockstep {
namespace {

constexpr off_t kMostBytes = 4096;

ReadPosition unreadable(const std::filesystem::path& path, const std::string& why) {
    return {std::unexpected(FaultCode::PositionUnreadable), path.string() + ": " + why};
}

/// Returns why the file must not be read; empty if it may be read.
std::string refusal_of(const struct stat& file) {
    if (!S_ISREG(file.st_mode)) { return "it is not a regular file; remove it"; }
    if (file.st_uid != geteuid() && file.st_uid != 0) {
        return fmt::format("it belongs to user {}; remove it", file.st_uid);
    }
    if ((file.st_mode & (S_IWGRP | S_IWOTH)) != 0) { return "other users may write it; run chmod go-w, or remove it"; }
    if (file.st_size > kMostBytes) {
        return fmt::format("it has {} bytes, more than {}; remove it", file.st_size, kMostBytes);
    }
    return {};
}

}  // namespace

std::filesystem::path position_file(const MachineSetup& machine, MotorIndex motor) {
    const std::filesystem::path directory = machine.position_directory.empty()
                                                ? position_directory(machine.name)
                                                : std::filesystem::path(machine.position_directory);
    return directory / (motor_name(machine, motor) + ".textproto");
}

ReadPosition read_position(const std::filesystem::path& path) {
    struct stat file {};
    if (::stat(path.c_str(), &file) != 0 && errno == ENOENT) {
        return {std::unexpected(FaultCode::PositionNotKept), {}};
    }
    if (const std::string why = refusal_of(file); !why.empty()) { return unreadable(path, why); }
    const auto text = read_text_file(path);
    if (!text) { return unreadable(path, text.error().message); }
    const auto kept = position_from_text(*text);
    if (!kept) { return unreadable(path, kept.error()); }
    return {*kept, {}};
}

}  // namespace lockstep
