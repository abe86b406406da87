// The numbers of one kind of message, process by process: which are missing.
#pragma once

#include <cstdint>
#include <map>

#include "clients/analysis/log/number_set.hpp"

namespace lockstep::analysis {

class MessageNumbers {
public:
    /// False: it had come already. `incarnation` is the process: numbers start anew with each.
    bool add(std::int64_t incarnation, std::int64_t sequence) { return numbers_[incarnation].add(sequence); }

    /// Between the first and the last that came of each process: a log may begin later than they do.
    std::int64_t missing_within() const {
        std::int64_t missing = 0;
        for (const auto& [incarnation, numbers] : numbers_) { missing += numbers.missing_within(); }
        return missing;
    }

private:
    std::map<std::int64_t, NumberSet> numbers_;
};

}  // namespace lockstep::analysis
