// grbl's numbers for what is wrong with a line, and for alarms. The numbers are part of its protocol.
#pragma once

#include <string>

#include "core/faults.hpp"

namespace lockstep::grbl {

enum class Error : int {
    ExpectedLetter = 1,
    BadNumber = 2,
    UnknownCommand = 3,
    NotIdle = 8,
    Locked = 9,
    LineTooLong = 11,
    TravelExceeded = 15,
    BadJog = 16,
    Unsupported = 20,
    NoFeed = 22,
    RepeatedWord = 25,
    NoAxisWords = 26,
};

/// A line that was refused: the number, and a sentence for a person.
struct Refused {
    Error error = Error::Unsupported;
    std::string text;
};

/// grbl knows few alarms: 1 a limit switch, 2 a target outside travel, 6 homing that was reset, 8 and 9 homing that
/// failed, 3 everything else that ends a motion.
constexpr int alarm_of(FaultCode fault) {
    switch (fault) {
        case FaultCode::LimitHit: return 1;
        case FaultCode::OutsideTravel:
        case FaultCode::FrameOutsideTravel: return 2;
        case FaultCode::HomeSwitchStuck:
        case FaultCode::HomeSwitchUnsteady: return 8;
        case FaultCode::HomeSwitchNotFound: return 9;
        default: return 3;
    }
}

}  // namespace lockstep::grbl
