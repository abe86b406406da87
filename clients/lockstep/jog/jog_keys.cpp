#include "clients/lockstep/jog/jog_keys.hpp"

#include <algorithm>
#include <array>

#include "clients/lockstep/jog/jog_words.hpp"

namespace lockstep {
namespace {

struct AxisKeys {
    std::string_view minus;  // the bytes that a terminal sends
    std::string_view plus;
    std::string_view name;
};

constexpr std::array kAxisKeys{AxisKeys{"\x1b[D", "\x1b[C", "left, right"},
                               AxisKeys{"\x1b[B", "\x1b[A", "down, up"},
                               AxisKeys{"\x1b[6~", "\x1b[5~", "page down, page up"},
                               AxisKeys{"j", "u", "j, u"},
                               AxisKeys{"k", "i", "k, i"},
                               AxisKeys{"l", "o", "l, o"}};
constexpr int kSlowest_percent = 1;
constexpr int kFastest_percent = 3200;

/// The length of the first key; 0 if more bytes must come. An escape sequence ends with a letter or ~.
std::size_t length_of_key(std::string_view bytes) {
    if (bytes.front() != '\x1b') { return 1; }
    if (bytes.size() == 1) { return 0; }
    if (bytes[1] != '[' && bytes[1] != 'O') { return 1; }
    for (std::size_t i = 2; i < bytes.size(); ++i) {
        if (bytes[i] >= '@' && bytes[i] <= '~') { return i + 1; }
    }
    constexpr std::size_t kLongest = 16;
    return bytes.size() < kLongest ? 0 : 1;
}

}  // namespace

std::string_view JogKeys::keys_of(AxisIndex axis) {
    return axis < kAxisKeys.size() ? kAxisKeys[axis].name : std::string_view{};
}

void JogKeys::take(std::string_view bytes, std::chrono::nanoseconds now) {
    unread_ += bytes;
    std::size_t read = 0;
    while (read < unread_.size()) {
        const std::size_t length = length_of_key(std::string_view(unread_).substr(read));
        if (length == 0) { break; }
        std::string key = unread_.substr(read, length);
        if (key.size() == 3 && key[1] == 'O') { key[1] = '['; }  // some terminals send O
        press(key, now);
        read += length;
    }
    unread_.erase(0, read);
}

void JogKeys::press(std::string_view key, std::chrono::nanoseconds now) {
    if (key == "q" || key == "\x03") { must_quit_ = true; }
    if (key == " ") {
        release_all();
        must_stop_ = true;
    }
    if (key == "+" || key == "-") { change_speed(key == "+"); }
    for (std::size_t i = 0; i < std::min(machine_.axes.size(), kAxisKeys.size()); ++i) {
        if (key != kAxisKeys[i].minus && key != kAxisKeys[i].plus) { continue; }
        const bool is_plus = key == kAxisKeys[i].plus;
        const AxisIndex axis{i};
        held_.erase({axis, !is_plus});
        held_[{axis, is_plus}] = now;
        next_step_ = {axis, is_plus};
    }
}

void JogKeys::change_speed(bool faster) {
    release_all();
    speed_percent_ = std::clamp(faster ? speed_percent_ * 2 : speed_percent_ / 2, kSlowest_percent, kFastest_percent);
}

double JogKeys::speed_mm_s(AxisIndex axis) const {
    const AxisConfig& config = machine_.axes[axis];
    return std::min(usual_jog_speed(config) * speed_percent_ / 100, config.max_velocity_mm_s);
}

std::vector<JogAxis> JogKeys::jogs(std::chrono::nanoseconds now) const {
    std::vector<JogAxis> jogs;
    for (const auto& [direction, pressed] : held_) {
        if (now - pressed > kHold) { continue; }
        jogs.push_back(jog_of(direction));
    }
    return jogs;
}

JogAxis JogKeys::jog_of(const Direction& direction) const {
    const double speed = speed_mm_s(direction.axis);
    return {.axis = direction.axis, .speed_mm_s = direction.is_plus ? speed : -speed, .distance_mm = step_mm_};
}

std::optional<JogAxis> JogKeys::take_step() {
    const auto step = std::exchange(next_step_, std::nullopt);
    return step ? std::optional(jog_of(*step)) : std::nullopt;
}

}  // namespace lockstep
