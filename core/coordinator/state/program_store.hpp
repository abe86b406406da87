// The programs that have arrived whole.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "core/program.hpp"

namespace lockstep {

/// Keeps only the newest few.
class ProgramStore {
public:
    void accept(std::uint64_t id, Program program) {
        if (!programs_.contains(id)) { order_.push_back(id); }
        programs_[id] = std::make_shared<const Program>(std::move(program));
        if (order_.size() > kProgramsKept) {
            programs_.erase(order_.front());
            order_.erase(order_.begin());
        }
    }
    /// Jobs of it go on.
    void forget(std::uint64_t id) {
        programs_.erase(id);
        std::erase(order_, id);
    }
    /// Null: it has not arrived, or was replaced by newer ones.
    std::shared_ptr<const Program> find(std::uint64_t id) const {
        const auto found = programs_.find(id);
        return found == programs_.end() ? nullptr : found->second;
    }

private:
    static constexpr std::size_t kProgramsKept = 4;

    std::map<std::uint64_t, std::shared_ptr<const Program>> programs_;
    std::vector<std::uint64_t> order_;  // the oldest first
};

}  // namespace lockstep
