// grbl's numbers for errors in lines and for alarms. The numbers are part of its protocol; code_table.hpp has their
// names and meanings.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "core/faults.hpp"

namespace lockstep::grbl {

enum class Error : int {
    ExpectedLetter = 1,
    BadNumber = 2,
    UnknownCommand = 3,
    NegativeValue = 4,
    NotIdle = 8,
    Locked = 9,
    LineTooLong = 11,
    TravelExceeded = 15,
    BadJog = 16,
    Unsupported = 20,
    SameModalGroup = 21,
    NoFeed = 22,
    TwoAxisCommands = 24,
    RepeatedWord = 25,
    NoAxisWords = 26,
    BadTarget = 33,
    // Lockstep's own:
    SettingFixed = 100,
    SettingOutOfRange = 101,
    NotKept = 102,
};
inline constexpr std::array kAllErrors{
    Error::ExpectedLetter, Error::BadNumber,    Error::UnknownCommand,    Error::NegativeValue, Error::NotIdle,
    Error::Locked,         Error::LineTooLong,  Error::TravelExceeded,    Error::BadJog,        Error::Unsupported,
    Error::SameModalGroup, Error::NoFeed,       Error::TwoAxisCommands,   Error::RepeatedWord,  Error::NoAxisWords,
    Error::BadTarget,      Error::SettingFixed, Error::SettingOutOfRange, Error::NotKept,
};

/// The refusal of a line: the error's number, and a sentence for a person.
struct Refused {
    Error error = Error::Unsupported;
    std::string text;
};

/// grbl's number for a message of the G-code parser; Unsupported if no other number fits.
Error error_of(std::string_view message);

/// grbl's alarms: 1 a limit switch, 2 a target outside travel, 3 a reset in motion and everything else that ends a
/// motion, 4 and 5 a probe that touches too early or not at all, 8 and 9 failed homing.
inline constexpr int kTravelAlarm = 2;
inline constexpr int kAbortAlarm = 3;
inline constexpr int kTouchedEarlyAlarm = 4;
inline constexpr int kNotTouchedAlarm = 5;

constexpr int alarm_of(FaultCode fault) {
    switch (fault) {
        case FaultCode::LimitHit: return 1;
        case FaultCode::OutsideTravel:
        case FaultCode::FrameOutsideTravel: return kTravelAlarm;
        case FaultCode::HomeSwitchStuck:
        case FaultCode::HomeSwitchUnsteady: return 8;
        case FaultCode::HomeSwitchNotFound: return 9;
        default: return kAbortAlarm;
    }
}

}  // namespace lockstep::grbl
