#include "core/gcode/codes.hpp"

#include <algorithm>

namespace lockstep::gcode {
namespace {

constexpr std::array kCodes{
    Code{'G', 0, Group::Motion, ""},
    Code{'G', 10, Group::Motion, ""},
    Code{'G', 20, Group::Motion, "IJKRP"},
    Code{'G', 30, Group::Motion, "IJKRP"},
    Code{'G', 40, Group::NonModal, "P"},
    Code{'G', 50, Group::Motion, "IJPQ"},
    Code{'G', 51, Group::Motion, "IJ"},
    Code{'G', 52, Group::Motion, "PL"},
    Code{'G', 53, Group::Motion, ""},
    Code{'G', 80, Group::Diameter, ""},
    Code{'G', 100, Group::NonModal, "LPRIJQ"},
    Code{'G', 170, Group::Plane, ""},
    Code{'G', 180, Group::Plane, ""},
    Code{'G', 190, Group::Plane, ""},
    Code{'G', 200, Group::Units, ""},
    Code{'G', 210, Group::Units, ""},
    Code{'G', 280, Group::NonModal, ""},
    Code{'G', 281, Group::NonModal, ""},
    Code{'G', 300, Group::NonModal, ""},
    Code{'G', 301, Group::NonModal, ""},
    Code{'G', 382, Group::Motion, "P"},
    Code{'G', 383, Group::Motion, "P"},
    Code{'G', 384, Group::Motion, "P"},
    Code{'G', 385, Group::Motion, "P"},
    Code{'G', 400, Group::Compensation, ""},
    Code{'G', 410, Group::Compensation, "D"},
    Code{'G', 411, Group::Compensation, "DL"},
    Code{'G', 420, Group::Compensation, "D"},
    Code{'G', 421, Group::Compensation, "DL"},
    Code{'G', 430, Group::ToolLength, "H"},
    Code{'G', 431, Group::ToolLength, ""},
    Code{'G', 432, Group::ToolLength, "H"},
    Code{'G', 490, Group::ToolLength, ""},
    Code{'G', 520, Group::NonModal, ""},
    Code{'G', 530, Group::NonModal, ""},
    Code{'G', 540, Group::System, ""},
    Code{'G', 550, Group::System, ""},
    Code{'G', 560, Group::System, ""},
    Code{'G', 570, Group::System, ""},
    Code{'G', 580, Group::System, ""},
    Code{'G', 590, Group::System, ""},
    Code{'G', 591, Group::System, ""},
    Code{'G', 592, Group::System, ""},
    Code{'G', 593, Group::System, ""},
    Code{'G', 610, Group::PathMode, ""},
    Code{'G', 611, Group::PathMode, ""},
    Code{'G', 640, Group::PathMode, "PQ"},
    Code{'G', 730, Group::Motion, "RLQ"},
    Code{'G', 800, Group::Motion, ""},
    Code{'G', 810, Group::Motion, "RL"},
    Code{'G', 820, Group::Motion, "RLP"},
    Code{'G', 830, Group::Motion, "RLQ"},
    Code{'G', 850, Group::Motion, "RL"},
    Code{'G', 860, Group::Motion, "RLP"},
    Code{'G', 890, Group::Motion, "RLP"},
    Code{'G', 900, Group::Distance, ""},
    Code{'G', 901, Group::CentreDistance, ""},
    Code{'G', 910, Group::Distance, ""},
    Code{'G', 911, Group::CentreDistance, ""},
    Code{'G', 920, Group::NonModal, ""},
    Code{'G', 921, Group::NonModal, ""},
    Code{'G', 922, Group::NonModal, ""},
    Code{'G', 923, Group::NonModal, ""},
    Code{'G', 930, Group::FeedMode, ""},
    Code{'G', 940, Group::FeedMode, ""},
    Code{'G', 970, Group::SpindleMode, ""},
    Code{'G', 980, Group::Retract, ""},
    Code{'G', 990, Group::Retract, ""},
    Code{'M', 0, Group::Stop, ""},
    Code{'M', 10, Group::Stop, ""},
    Code{'M', 20, Group::Stop, ""},
    Code{'M', 300, Group::Stop, ""},
    Code{'M', 600, Group::Stop, ""},
    Code{'M', 30, Group::Spindle, ""},
    Code{'M', 40, Group::Spindle, ""},
    Code{'M', 50, Group::Spindle, ""},
    Code{'M', 60, Group::Tool, ""},
    Code{'M', 610, Group::Tool, "Q"},
    Code{'M', 70, Group::Coolant, ""},
    Code{'M', 80, Group::Coolant, ""},
    Code{'M', 90, Group::Coolant, ""},
    Code{'M', 480, Group::Override, ""},
    Code{'M', 490, Group::Override, ""},
    Code{'M', 500, Group::Override, "P"},
    Code{'M', 510, Group::Override, "P"},
    Code{'M', 520, Group::Override, "P"},
    Code{'M', 530, Group::Override, "P"},
    Code{'M', 620, Group::Output, "P"},
    Code{'M', 630, Group::Output, "P"},
    Code{'M', 640, Group::Output, "P"},
    Code{'M', 650, Group::Output, "P"},
    Code{'M', 660, Group::Output, "PELQ"},
    Code{'M', 670, Group::Output, "EQ"},
    Code{'M', 680, Group::Output, "EQ"},
    Code{'M', 690, Group::Output, "PQRL"},
    Code{'M', 700, Group::StateKeeping, ""},
    Code{'M', 710, Group::StateKeeping, ""},
    Code{'M', 720, Group::StateKeeping, ""},
    Code{'M', 730, Group::StateKeeping, ""},
};

constexpr std::string_view kEncoder = "needs a spindle encoder, which this machine does not have";
constexpr std::string_view kLathe = "is for lathes; write its moves one by one";

constexpr std::array kRefused{
    RefusedCode{'G', 70, 70, "is for lathes; write radii instead of diameters"},
    RefusedCode{'G', 171, 171, kLathe},
    RefusedCode{'G', 181, 181, kLathe},
    RefusedCode{'G', 191, 191, kLathe},
    RefusedCode{'G', 330, 331, kEncoder},
    RefusedCode{'G', 700, 722, kLathe},
    RefusedCode{'G', 740, 740, kEncoder},
    RefusedCode{'G', 760, 760, kEncoder},
    RefusedCode{'G', 840, 840, kEncoder},
    RefusedCode{'G', 870, 870, "stops the spindle at an angle, which needs a spindle encoder"},
    RefusedCode{'G', 880, 880, "waits for a person to move the tool out; write M0 and the moves"},
    RefusedCode{'G', 950, 960, kEncoder},
    RefusedCode{'M', 190, 190, kEncoder},
    RefusedCode{'M', 980, 990, "is a call in the syntax of other controllers; write o<name> call"},
    RefusedCode{'M', 1000, 1990, "is a command that a user defines; this machine does not run such commands"},
};

}  // namespace

const Code* find_code(char letter, int tenths) {
    static const auto kIndex = [] {
        std::array<std::array<std::int16_t, 1000>, 2> index{};
        for (auto& codes : index) { codes.fill(-1); }
        for (std::size_t i = 0; i < kCodes.size(); ++i) {
            index[kCodes[i].letter == 'M'][static_cast<std::size_t>(kCodes[i].tenths)] = static_cast<std::int16_t>(i);
        }
        return index;
    }();
    if (tenths < 0 || tenths >= 1000) { return nullptr; }
    const int found = kIndex[letter == 'M'][static_cast<std::size_t>(tenths)];
    return found < 0 ? nullptr : &kCodes[static_cast<std::size_t>(found)];
}

const RefusedCode* find_refused(char letter, int tenths) {
    const auto found = std::ranges::find_if(kRefused, [&](const RefusedCode& code) {
        return code.letter == letter && tenths >= code.first && tenths <= code.last;
    });
    return found == kRefused.end() ? nullptr : &*found;
}

}  // namespace lockstep::gcode
