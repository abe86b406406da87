// A process's link to its peers, opened again when it no longer delivers (core/protocol/reception_watch.hpp).
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "core/protocol/reception_watch.hpp"
#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/domain.hpp"
#include "services/wire/dds/reopenable.hpp"

namespace lockstep {

template <typename Link>
class WatchedLink {
public:
    WatchedLink(const MachineConfig& machine, std::unique_ptr<Link> first, typename Reopenable<Link>::Open open)
        : watch_(Ticks{lease_of(machine.network).count() / machine.tick_ns}, machine.tick_ns),
          link_(std::move(first), std::move(open), [](const std::string& why) { add_dds_message(why); }) {}

    /// Null while it is being opened again.
    Link* get() { return link_.get(); }

    /// Call it in every loop. look: returns the input of the watch for a link, each time that is due. Returns why the
    /// link is now opened again.
    template <typename Look>
    std::optional<ReopenReason> tend(Tick now, Look look) {
        Link* const link = get();
        if (link == nullptr || !watch_.is_due(now)) { return std::nullopt; }
        const auto reason = watch_.look(now, look(*link));
        if (reason) {
            ++reopened_;
            link_.reopen();
        }
        return reason;
    }

    /// How often since the process started.
    std::uint64_t reopened() const { return reopened_; }

private:
    ReceptionWatch watch_;
    std::uint64_t reopened_ = 0;
    Reopenable<Link> link_;
};

}  // namespace lockstep
