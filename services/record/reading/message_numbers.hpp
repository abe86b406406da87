// Collects the numbers of one kind of message for each process, to find missing ones.
#pragma once

#include <cstdint>
#include <map>

#include "services/record/reading/number_set.hpp"

namespace lockstep::analysis {

class MessageNumbers {
public:
    /// Returns false for a repeated number. `incarnation` identifies the process; each process counts from 0.
    bool add(std::int64_t incarnation, std::int64_t sequence) { return numbers_[incarnation].add(sequence); }

    /// How many numbers are missing between the first and the last of each process. A log may begin later than the
    /// process.
    std::int64_t missing_within() const {
        std::int64_t missing = 0;
        for (const auto& [incarnation, numbers] : numbers_) { missing += numbers.missing_within(); }
        return missing;
    }

private:
    std::map<std::int64_t, NumberSet> numbers_;
};

}  // namespace lockstep::analysis
