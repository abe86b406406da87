// The register map's window over memory: this process's own, shared memory by name, or
// anything that can be mapped (a file, a UIO device). Source of the map: registers.json.
//
// Ordering: every register is read with acquire and written with release order. So a reader of a new head, sequence or
// run number also sees everything the other side wrote before it, which is all that rings and consistent reads need.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "sim_fpga/registers.hpp"

namespace lockstep {

/// A handle: all copies access the same registers. The last copy unmaps, and removes the name if it was created here.
/// If the memory is removed while it is mapped, all registers read 0 from then on in this process (page_guard.hpp).
class RegisterWindow {
public:
    /// Zeroed memory of this process.
    static RegisterWindow in_process();
    /// Creates zeroed shared memory /dev/shm/NAME, replacing that of a dead process. Errors name the cause: a
    /// name with '/', one that a living process holds, or the system's error.
    static std::expected<RegisterWindow, std::string> create_shared(const std::string& name);
    /// Attaches to memory of create_shared, of this or another process.
    static std::expected<RegisterWindow, std::string> open_shared(const std::string& name);
    /// Does the same in a file, which remains when this process ends. Returns an error also if a living process has
    /// it.
    static std::expected<RegisterWindow, std::string> create_file(const std::filesystem::path& path);
    /// Attaches to a file or device that can be mapped read-write from its start. Also fails if a file is too short.
    static std::expected<RegisterWindow, std::string> open_file(const std::filesystem::path& path);

    /// Whether the memory is that of a device that can be mapped, such as /dev/uio0. All other memory is written by a
    /// process of this host.
    bool is_hardware() const { return is_hardware_; }

    /// offset: in bytes, a multiple of 8, below registers::kWindowBytes.
    std::uint64_t load(std::size_t offset) const { return word(offset).load(std::memory_order_acquire); }
    void store(std::size_t offset, std::uint64_t value) { word(offset).store(value, std::memory_order_release); }

private:
    explicit RegisterWindow(std::shared_ptr<std::uint64_t[]> words, bool is_hardware = false)
        : words_(std::move(words)), is_hardware_(is_hardware) {}
    std::atomic_ref<std::uint64_t> word(std::size_t offset) const {
        return std::atomic_ref(words_[static_cast<std::ptrdiff_t>(offset / sizeof(std::uint64_t))]);
    }
    static std::expected<RegisterWindow, std::string> map(int file, const std::string& what, std::string unlink_name);

    static_assert(std::atomic_ref<std::uint64_t>::is_always_lock_free, "words are shared between processes");
    std::shared_ptr<std::uint64_t[]> words_;
    bool is_hardware_;
};

}  // namespace lockstep
