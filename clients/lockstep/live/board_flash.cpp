#include "clients/lockstep/live/board_flash.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

#include "clients/supervisor/program_folder.hpp"
#include "services/files/descriptor.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

// A block of a UF2 file: https://github.com/microsoft/uf2
constexpr std::size_t kBlockBytes = 512;
constexpr std::size_t kFamilyAt = 28;
constexpr std::uint32_t kFirstMagic = 0x0A324655;
constexpr std::uint32_t kSecondMagic = 0x9E5D5157;
constexpr std::uint32_t kFamilyRp2040 = 0xE48BFF56;
constexpr std::uintmax_t kMostBytes = 8U << 20;  // twice a flash of 4 MB, because half of a block is data

static_assert(std::endian::native == std::endian::little);

std::uint32_t word_at(const std::string& bytes, std::size_t at) {
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data() + at, sizeof word);
    return word;
}

bool is_block(const std::string& bytes, std::size_t at) {
    return word_at(bytes, at) == kFirstMagic && word_at(bytes, at + 4) == kSecondMagic &&
           word_at(bytes, at + kFamilyAt) == kFamilyRp2040;
}

/// A mount's directory, in which \040 means a space.
std::string unescaped(const std::string& text) {
    std::string plain;
    for (std::size_t n = 0; n < text.size(); ++n) {
        const bool is_space = text.compare(n, 4, "\\040") == 0;
        plain += is_space ? ' ' : text[n];
        n += is_space ? 3 : 0;
    }
    return plain;
}

bool is_pico(const fs::path& drive) {
    std::ifstream info(drive / "INFO_UF2.TXT");
    const std::string text{std::istreambuf_iterator<char>(info), {}};
    return text.find("Board-ID: RPI-RP2") != std::string::npos;
}

}  // namespace

fs::path shipped_firmware() { return program_folder().parent_path() / "share/lockstep/firmware/lockstep-board.uf2"; }

std::expected<std::string, Failure> read_firmware(const fs::path& file) {
    const auto refuse = [&](const std::string& why) { return std::unexpected(bad_input(file.string() + ": " + why)); };
    std::ifstream stream(file, std::ios::binary);
    if (!stream) { return refuse(std::string(std::strerror(errno)) + "; make it: make -C sim_fpga/firmware"); }
    std::error_code error;
    const std::uintmax_t size = fs::file_size(file, error);
    if (error || size == 0 || size % kBlockBytes != 0 || size > kMostBytes) {
        return refuse("it is no UF2 file, which has 1 to 16384 blocks of 512 bytes");
    }
    std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    if (bytes.size() != size) { return refuse("it changed while it was read"); }
    for (std::size_t at = 0; at < bytes.size(); at += kBlockBytes) {
        if (!is_block(bytes, at)) {
            return refuse(fmt::format("block {} is none of a UF2 file for the RP2040", at / kBlockBytes));
        }
    }
    return bytes;
}

std::vector<fs::path> pico_drives(const std::string& mounts) {
    std::vector<fs::path> drives;
    std::istringstream lines(mounts);
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string device;
        std::string directory;
        words >> device >> directory;
        if (is_pico(unescaped(directory))) { drives.emplace_back(unescaped(directory)); }
    }
    return drives;
}

std::expected<fs::path, Failure> only_drive(const std::vector<fs::path>& drives) {
    if (drives.size() == 1) { return drives.front(); }
    if (drives.empty()) {
        return std::unexpected(failed(
            "no drive of a Pico is mounted; hold its BOOTSEL button while you plug it in, mount its drive RPI-RP2 "
            "if nothing else does, and try again; or name its directory with --drive"));
    }
    std::vector<std::string> names;
    for (const fs::path& drive : drives) { names.push_back(drive.string()); }
    return std::unexpected(bad_input(
        fmt::format("several Picos wait for a firmware; choose one with --drive: {}", fmt::join(names, ", "))));
}

/// The board restarts with the last block, and its drive goes. A write that fails because of that has succeeded.
std::expected<void, Failure> write_firmware(const std::string& firmware, const fs::path& drive) {
    if (!is_pico(drive)) {
        return std::unexpected(
            bad_input(drive.string() + ": it has no INFO_UF2.TXT of a Pico; name the drive RPI-RP2"));
    }
    const fs::path file = drive / "lockstep-board.uf2";
    const Descriptor out(::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644));
    std::size_t written = 0;
    while (out.is_open() && written < firmware.size()) {
        const ssize_t now = ::write(out.get(), firmware.data() + written, firmware.size() - written);
        if (now <= 0 && errno != EINTR) { break; }
        written += now > 0 ? static_cast<std::size_t>(now) : 0;
    }
    const bool is_kept = written == firmware.size() && ::fsync(out.get()) == 0;
    const std::string why = std::strerror(errno);
    if (is_kept || (written == firmware.size() && !is_pico(drive))) { return {}; }
    return std::unexpected(failed(file.string() + ": " + why));
}

}  // namespace lockstep
