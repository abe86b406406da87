// Changes of a device's inputs, until the axis takes those up to its newest reading of the device.
#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "core/axis/device_time.hpp"
#include "core/hardware/device_setup.hpp"
#include "core/protocol/messages.hpp"
#include "services/axis/device_port.hpp"

namespace lockstep {

class InputEdges {
public:
    /// debounce: how much later than its pin each input changes.
    explicit InputEdges(const std::array<Ticks, kMostInputs>& debounce) : debounce_(debounce) {}

    /// In the order of their ticks.
    void add(const ChannelEvent& change) { changes_.push_back(change); }
    void clear() { changes_.clear(); }
    /// Takes those up to tick `until` of the device; later ones stay. Valid until the next call.
    std::span<const InputEdge> take(Tick until, const ClockView& machine_time) {
        edges_.clear();
        const auto later = std::ranges::find_if(changes_, [&](const auto& change) { return change.tick > until; });
        for (auto change = changes_.begin(); change != later; ++change) {
            const Tick tick = machine_time.at(change->tick - debounce_[change->channel]);
            edges_.push_back({tick, change->channel, change->closed});
        }
        changes_.erase(changes_.begin(), later);
        return edges_;
    }

private:
    std::array<Ticks, kMostInputs> debounce_;
    std::vector<ChannelEvent> changes_;  // that were not taken yet
    std::vector<InputEdge> edges_;       // that were taken last
};

}  // namespace lockstep
