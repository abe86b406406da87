#include "core/device/device_name.hpp"

#include <algorithm>

namespace lockstep {
namespace {

constexpr std::string_view kSimulated = "sim";
constexpr std::string_view kShared = "shm:";
constexpr std::string_view kMapped = "uio:";

}  // namespace

std::string DeviceName::text() const {
    switch (kind) {
        case Kind::Simulated: break;
        case Kind::Shared: return std::string(kShared) + place;
        case Kind::Mapped: return std::string(kMapped) + place;
    }
    return std::string(kSimulated);
}

std::optional<DeviceName> read_device_name(std::string_view text) {
    if (text == kSimulated) { return DeviceName{}; }
    const std::string_view place = text.substr(std::min(text.size(), kShared.size()));
    const bool is_name = !place.empty() && !place.contains('/');
    const bool is_path = place.size() > 1 && place.front() == '/';
    if (text.starts_with(kShared) && is_name) { return DeviceName{DeviceName::Kind::Shared, std::string(place)}; }
    if (text.starts_with(kMapped) && is_path) { return DeviceName{DeviceName::Kind::Mapped, std::string(place)}; }
    return std::nullopt;
}

}  // namespace lockstep
