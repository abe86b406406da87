// Collects the numbers of one kind of message for each process, to find missing ones.
#pragma once

#include <cstdint>
#include <map>

#include "clients/analysis/log/number_set.hpp"

namespace lockstep::analysis {

class MessageNumbers {
public:
    /// False: it is a repeat. `incarnation` is the process: each process counts from 0.
    bool add(std::int64_t incarnation, std::int64_t sequence) { return numbers_[incarnation].add(sequence); }

    /// Between the first and the last number of each process: a log may begin later than the process.
    std::int64_t missing_within() const {
        std::int64_t missing = 0;
        for (const auto& [incarnation, numbers] : numbers_) { missing += numbers.missing_within(); }
        return missing;
    }

private:
    std::map<std::int64_t, NumberSet> numbers_;
};

}  // namespace lockstep::analysis
