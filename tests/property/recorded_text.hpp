// Results as text, for recorded hashes: whole numbers as they are, and others to nine digits.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <ranges>
#include <string>
#include <string_view>
#include <type_traits>

#include "core/motion/profile.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class RecordedText {
public:
    template <typename... Parts>
    RecordedText& line(const Parts&... parts) {
        (add(parts), ...);
        text_ += '\n';
        return *this;
    }
    const std::string& text() const { return text_; }

private:
    template <typename Number>
    requires std::integral<Number> || std::is_enum_v<Number>
    void add(Number number) { text_ += std::to_string(static_cast<std::int64_t>(number)) + ' '; }
    void add(double number) {
        std::array<char, 32> digits{};
        text_ +=
            {digits.data(), static_cast<std::size_t>(std::snprintf(digits.data(), digits.size(), "%.9g ", number))};
    }
    template <typename Of>
    void add(Index<Of> index) {
        add(index.number());
    }
    template <typename AnIndex>
    void add(IndexSet<AnIndex> set) {
        add(set.bits());
    }
    void add(const char* text) { add(std::string_view(text)); }
    void add(std::string_view text) { (text_ += text) += ' '; }
    void add(const std::string& text) { add(std::string_view(text)); }
    void add(Tick tick) { add(tick.value); }
    void add(Ticks ticks) { add(ticks.value); }
    void add(Subticks subticks) { add(subticks.value); }
    void add(Velocity velocity) { add(velocity.raw); }
    void add(Position at) {
        add(at.count());
        add(at.phase());
    }
    void add(Displacement way) { add(Position{way.raw}); }
    void add(const Piece& piece) {
        add(piece.ticks);
        add(piece.velocity);
        add(piece.acceleration.raw);
    }
    void add(const AxisTrack& track) {
        add(track.from);
        add(track.body);
        add(track.tail);
    }
    void add(const Profile& profile) {
        for (const ProfilePhase& phase : profile.phases) {
            add(phase.from);
            add(phase.to);
            add(phase.entry);
            add(phase.duration);
        }
    }
    template <typename Value>
    void add(const std::optional<Value>& maybe) {
        if (!maybe) { return add("none"); }
        add(*maybe);
    }
    template <std::ranges::input_range List>
    requires(!std::convertible_to<List, std::string_view>) void add(const List& list) {
        for (const auto& one : list) { add(one); }
        text_ += '|';
    }

    std::string text_;
};

}  // namespace lockstep
