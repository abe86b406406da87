// The newest epochs: the job of each, and those whose plan is not known, so that their runs are left out.
#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <ranges>
#include <string>
#include <utility>

#include "core/protocol/messages.hpp"

namespace lockstep::verification {

class NewestEpochs {
public:
    /// `label`: of the job that begins it.
    void begin(Epoch epoch, const std::string& label) { add({epoch, label}, labels_); }
    /// The label of its job; empty if that is not known.
    std::string label_of(Epoch epoch) const {
        const auto newest = labels_ | std::views::reverse;
        const auto found = std::ranges::find(newest, epoch, &std::pair<Epoch, std::string>::first);
        return found == newest.end() ? "" : found->second;
    }
    void lose(Epoch epoch) { add(epoch, lost_); }
    bool is_lost(Epoch epoch) const { return std::ranges::find(lost_, epoch) != lost_.end(); }

private:
    static constexpr std::size_t kKept = 16;

    template <typename T>
    static void add(T one, std::deque<T>& newest) {
        newest.push_back(std::move(one));
        if (newest.size() > kKept) { newest.pop_front(); }
    }

    std::deque<std::pair<Epoch, std::string>> labels_;
    std::deque<Epoch> lost_;
};

}  // namespace lockstep::verification
