// The parts of homing.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "core/enumeration.hpp"

namespace lockstep {

/// To the switch, away from it, to it again slowly, and to the park position. Release: away from a switch that is
/// closed before homing begins.
enum class HomingStage : std::uint8_t { Idle, Search, PullOff, Latch, Park, Release };

struct HomingStageRow {
    std::string_view name;     // as logs and reports name it
    std::string_view words;    // what the axis does; "{}": its switch
    bool asks_switch = false;  // the state of the switch decides when the stage ends
};

inline constexpr std::array kHomingStages{
    HomingStageRow{.name = "idle", .words = "ended"},
    HomingStageRow{.name = "search", .words = "searches {}", .asks_switch = true},
    HomingStageRow{.name = "pull-off", .words = "moves off {}"},
    HomingStageRow{.name = "latch", .words = "touches {} slowly", .asks_switch = true},
    HomingStageRow{.name = "park", .words = "parks"},
    HomingStageRow{.name = "release", .words = "leaves {}", .asks_switch = true},
};
static_assert(kHomingStages.size() == kCountOf<HomingStage>);

constexpr std::string_view name_of(HomingStage stage) {
    const auto i = static_cast<std::size_t>(stage);
    return i < kHomingStages.size() ? kHomingStages[i].name : "unknown";
}

/// "searches x_home"
inline std::string in_words(const HomingStageRow& stage, std::string_view its_switch) {
    std::string text(stage.words);
    const std::size_t at = text.find("{}");
    return at == std::string::npos ? text : text.replace(at, 2, its_switch);
}

}  // namespace lockstep
