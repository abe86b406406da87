// A place in shared memory for one record. One process writes it, any process may read it at any time, and no process
// waits. The record's number precedes the record and is 0 during a write. So a reader never accepts a half-written
// record, even if its writer was killed.
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <type_traits>

namespace lockstep {

static_assert(std::atomic_ref<std::uint64_t>::is_always_lock_free, "other processes read it");

inline std::atomic_ref<std::uint64_t> shared_word(std::uint64_t* at) { return std::atomic_ref<std::uint64_t>(*at); }

template <typename Record>
struct NumberedSlot {
    static_assert(std::is_trivially_copyable_v<Record>);
    static constexpr std::size_t kRecordWords = (sizeof(Record) + sizeof(std::uint64_t) - 1) / sizeof(std::uint64_t);
    static constexpr std::size_t kWords = 1 + kRecordWords;

    struct Numbered {
        std::uint64_t number = 0;
        Record record;
    };

    /// `slot` has kWords words. `number` is not 0.
    static void write(std::uint64_t* slot, std::uint64_t number, const Record& record) {
        std::array<std::uint64_t, kRecordWords> words{};
        std::memcpy(words.data(), &record, sizeof record);
        shared_word(slot).store(0, std::memory_order_relaxed);
        std::atomic_thread_fence(std::memory_order_release);
        for (std::size_t i = 0; i < words.size(); ++i) {
            shared_word(slot + 1 + i).store(words[i], std::memory_order_relaxed);
        }
        shared_word(slot).store(number, std::memory_order_release);
    }

    /// Returns nullopt if the slot was never written or is being written.
    static std::optional<Numbered> read(std::uint64_t* slot) {
        const std::uint64_t number = shared_word(slot).load(std::memory_order_acquire);
        std::array<std::uint64_t, kRecordWords> words;
        for (std::size_t i = 0; i < words.size(); ++i) {
            words[i] = shared_word(slot + 1 + i).load(std::memory_order_relaxed);
        }
        std::atomic_thread_fence(std::memory_order_acquire);
        if (number == 0 || shared_word(slot).load(std::memory_order_relaxed) != number) { return std::nullopt; }
        Numbered read{.number = number, .record = {}};
        std::memcpy(static_cast<void*>(&read.record), words.data(), sizeof read.record);
        return read;
    }
};

}  // namespace lockstep
