#include "clients/grbl/protocol/errors.hpp"

#include <utility>

namespace lockstep::grbl {

Error error_of(std::string_view message) {
    constexpr std::pair<std::string_view, Error> kMarks[] = {
        {"outside its travel", Error::TravelExceeded},
        {"where a word's letter is expected", Error::ExpectedLetter},
        {"has no number", Error::BadNumber},
        {"is not a number", Error::BadNumber},
        {"has no feed", Error::NoFeed},
        {"has no axis", Error::NoAxisWords},
        {"goes nowhere", Error::BadTarget},
        {" repeats ", Error::RepeatedWord},
        {": a block has one ", Error::SameModalGroup},
        {"radius", Error::BadTarget},
    };
    for (const auto& [mark, error] : kMarks) {
        if (message.find(mark) != message.npos) { return error; }
    }
    return Error::Unsupported;
}

}  // namespace lockstep::grbl
