#include "core/device/device_name.hpp"

#include <algorithm>
#include <charconv>

namespace lockstep {
namespace {

constexpr std::string_view kSimulated = "sim";
constexpr std::string_view kShared = "shm:";
constexpr std::string_view kMapped = "uio:";
constexpr std::string_view kLinked = "board:";

/// NAME/N
std::optional<DeviceName> read_linked(std::string_view text) {
    const std::size_t slash = std::min(text.find('/'), text.size());
    const std::string_view number = text.substr(std::min(text.size(), slash + 1));
    DeviceName device{DeviceName::Kind::Linked, std::string(text.substr(0, slash))};
    const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), device.number);
    const bool is_number =
        error == std::errc() && end == number.data() + number.size() && (number == "0" || !number.starts_with('0'));
    if (device.place.empty() || !is_number || device.number >= kMostBoardMotors) { return std::nullopt; }
    return device;
}

}  // namespace

std::string DeviceName::text() const {
    switch (kind) {
        case Kind::Simulated: break;
        case Kind::Shared: return std::string(kShared) + place;
        case Kind::Mapped: return std::string(kMapped) + place;
        case Kind::Linked: return std::string(kLinked) + place + "/" + std::to_string(number);
    }
    return std::string(kSimulated);
}

std::optional<DeviceName> read_device_name(std::string_view text) {
    if (text == kSimulated) { return DeviceName{}; }
    if (text.starts_with(kLinked)) { return read_linked(text.substr(kLinked.size())); }
    const std::string_view place = text.substr(std::min(text.size(), kShared.size()));
    const bool is_name = !place.empty() && !place.contains('/');
    const bool is_path = place.size() > 1 && place.front() == '/';
    if (text.starts_with(kShared) && is_name) { return DeviceName{DeviceName::Kind::Shared, std::string(place)}; }
    if (text.starts_with(kMapped) && is_path) { return DeviceName{DeviceName::Kind::Mapped, std::string(place)}; }
    return std::nullopt;
}

}  // namespace lockstep
